const LTC_MAT_1 = [ 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 1, 1, 1 ];
const LTC_MAT_2 = [ ];
