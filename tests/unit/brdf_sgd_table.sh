# SPDX-License-Identifier: MIT
# The built-in SGD materials are what their generator writes.
set -eu
. tests/house/common.sh

csv=${LAMPION_DATA:-../shared}/data/merl_sgd/merl_sgd.csv
if [ -f "$csv" ]; then
    awk -f src/brdf/generate/sgd_table.awk "$csv" | cmp - src/brdf/sgd_table.c ||
        fail "src/brdf/sgd_table.c differs from what its generator writes"
else
    echo "skipped: $csv is not there"
fi
