# SPDX-License-Identifier: MIT
# The built-in SGD materials are what their generator writes.
set -eu
. tests/checks/common.sh

cd src/brdf/generate
awk -f sgd_table.awk merl_sgd.csv | cmp - ../sgd_table.c || fail "src/brdf/sgd_table.c is not what sgd_table.awk writes"
