# SPDX-License-Identifier: MIT
# sh tests/bench/peer.sh CHECKOUT LIBRARY [WORD [FLAGS]] - single calls of a liblampion.a beside those of DirectXMath, a
# checkout of which the caller has: a line a call and number of bands, in CSV. The peer is compiled for this machine, the
# library is what its build made of it. A WORD measures the calls whose names have it ("" all), FLAGS (lmp_cpu_flag,
# 4 for AVX2) by lesser instruction sets than the machine's best.
set -eu
[ $# -ge 2 ] || {
    echo "usage: sh tests/bench/peer.sh CHECKOUT LIBRARY [WORD [FLAGS]]" >&2
    exit 2
}
checkout=$1 library=$2 source=$(dirname "$0")/../..
shift 2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Defines away the annotations of Microsoft's compiler in DirectXMath's headers.
for word in _In_ _Out_ _Inout_ _In_opt_ _Out_opt_ _Success_\(x\) _Use_decl_annotations_ _Analysis_assume_\(x\) \
    _In_reads_\(x\) _In_reads_opt_\(x\) _In_reads_bytes_\(x\) _Out_writes_\(x\) _Out_writes_opt_\(x\) \
    _Out_writes_bytes_\(x\) _In_range_\(x,y\) _Inout_updates_\(x\) _Inout_updates_all_\(x\) _Inout_updates_bytes_\(x\) _Null_terminated_ \
    _Inout_updates_opt_\(x\) _Inout_updates_bytes_opt_\(x\) _Out_writes_all_\(x\) _Out_writes_bytes_opt_\(x\) _Ret_maybenull_; do
    echo "#define $word"
done >"$work/sal.h"
: "${CXX:=g++}"
for file in "$checkout/SHMath/DirectXSH.cpp" "$source/tests/bench/calls.cpp"; do
    $CXX -std=c++17 -O3 -march=native -w -I "$work" -I "$checkout/Inc" -I "$checkout/SHMath" -I "$source/include" \
        -c "$file" -o "$work/$(basename "$file").o"
done
$CXX "$work"/*.o "$library" -lm -o "$work/calls"
"$work/calls" "$@"
