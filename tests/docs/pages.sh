# SPDX-License-Identifier: MIT
# The pages of the site that docs.site has built in a headless browser, at the width of a desktop and of a phone
# (pages.mjs).
set -eu
. tests/checks/common.sh
for tool in pandoc node chromium; do
    command -v $tool >/dev/null || { echo "skipped: $tool is not installed"; exit 0; }
done
site=$WORK/../site/site
[ -f "$site/index.html" ] || fail "no site"
node tests/docs/pages.mjs "$WORK" "$site" || fail "a page does not fit"

# A page that does not fit must be found.
mkdir -p "$WORK/planted"
cat >"$WORK/planted/index.html" <<'PAGE'
<!doctype html><meta name="viewport" content="width=device-width"><main><p style="width: 30rem">wide<img src="none.png"></main>
PAGE
! node tests/docs/pages.mjs "$WORK" "$WORK/planted" >"$WORK/log" 2>&1 || fail "a page that is too wide goes unseen"
for fault in 'reaches from' 'no image'; do
    grep -q "$fault" "$WORK/log" || fail "$(cat "$WORK/log")"
done
