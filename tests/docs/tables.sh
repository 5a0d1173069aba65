# SPDX-License-Identifier: MIT
# tables.sh PAGE: the measured tables of a page must agree with what docs/site/tables.sh measures.
set -eu
exec sh docs/site/tables.sh --check "$BUILD" "$1"
