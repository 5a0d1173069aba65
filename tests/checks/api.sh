# SPDX-License-Identifier: MIT
# The rules of the public interface (CONTRIBUTING.md, "The interface"): names, order and number of arguments, what
# readers and writers take, enumerations. Each rule is shown to find a violation.
set -eu
. tests/checks/common.sh

verbs='add apply combine compute convert copy create destroy encode eval expand export find fit interpolate limit make
move multiply pack project read remove reset rotate shade sum unpack update want write'

# wrong FOLDER: prints a line for each violation in its headers.
wrong() {
    for header in "$1"/*.h; do
        declarations "$header" | awk -F '|' -v topic="$(basename "$header" .h)" -v verbs="$(echo $verbs)" '
            function bad(text) { print topic ".h: " name " " text }
            # at PATTERN: the place of the first argument that matches, or 0.
            function at(pattern, i) { for (i = 1; i <= count; i++) if (argument[i] ~ pattern) return i; return 0 }
            BEGIN { for (i = split(verbs, part, " "); i; i--) verb[part[i]] = 1 }
            { returned[$2] = $1; order[NR] = $0 }
            END {
                for (n = 1; n <= NR; n++) {
                    split(order[n], field, "|")
                    name = field[2]
                    count = split(field[3], argument, / *, */)
                    rest = substr(name, length("lmp_" topic) + 2)
                    if (topic != "base" && name !~ "^lmp_" topic "(_|$)") bad("is not of this topic")
                    twin = name
                    sub(/_n$/, "", twin)
                    acts = name == "lmp_" topic || name == "lmp_" topic "_n" || topic == "shade" || (twin != name && twin in returned)
                    for (i = split(rest, part, "_"); i; i--) acts += part[i] in verb
                    if (field[1] ~ /^(void|lmp_result) *$/ && !acts) bad("returns no value and has no verb")
                    if (count > 8) bad("takes more than eight arguments")
                    if (at("lmp_host \\*") > 1) bad("does not take the host first")
                    if (at("lmp_scratch \\*") > 1) bad("does not take the scratch first")
                    if (at("^int bands$") > 1 + (argument[1] ~ /lmp_(host|scratch) \*/)) bad("does not take the bands before what it reads")
                    if (at("^(int|unsigned|uint32_t) (.*_)?(count|capacity|size|planes)$")) bad("counts by what is not a size_t")
                    if (at("lmp_(vec3|float|sh|rgb)_array |lmp_surfaces \\*") && name !~ /_n$/) bad("works on arrays and does not end in _n")
                    if (at("(lmp_rgb \\*|float \\*rgb$)") && name !~ /_albedo$/) bad("writes colors elsewhere than to a lmp_rgb_array")
                    if (at("lmp_sh_layout") && at("float \\*[a-z]*$") && !at("const float \\*a$")) bad("writes coefficients elsewhere than to a lmp_sh_array")
                    if (name ~ /_read(_|$)/ && (count < 5 || argument[count - 1] !~ /lmp_parse_error \*error/)) bad("reads bytes and does not say what is wrong with them")
                    if (name ~ /_write$/ && (argument[2] !~ /^size_t size$/ || field[1] !~ /lmp_result/)) bad("writes to memory of unknown size")
                    if (name ~ /_create(_|$)/ && argument[1] !~ /lmp_host \*/) bad("allocates without a host")
                }
            }'
        # of an enumeration all values begin with its name without the last word, and none is a count
        code_of "$header" | grep -o 'typedef enum lmp_[a-z0-9_]* {[^}]*}' | awk -v header="$(basename "$header")" '
            {
                type = $3
                sub(/^[^{]*{/, "")
                sub(/}/, "")
                stem = toupper(type)
                if (type != "lmp_result") sub(/_[A-Z0-9]*$/, "", stem)
                if (type ~ /^lmp_[a-z0-9]*$/) stem = toupper(type)
                for (i = split($0, value, ","); i; i--) {
                    gsub(/ |=.*/, "", value[i])
                    if (value[i] == "" || value[i] == "LMP_OK" || value[i] ~ /^LMP_ERROR_/) continue
                    if (index(value[i], stem "_") != 1) print header ": " value[i] " does not begin as " type
                    if (value[i] == toupper(type) "_COUNT") print header ": " value[i] " counts"
                }
            }'
        # what counts an enumeration is a macro, TYPE_COUNT, one more than a value
        sed -n 's/^#define \(LMP_[A-Z0-9_]*\) *(\(LMP_[A-Z0-9_]*\) + 1).*/\1/p' "$header" | grep -v '_COUNT$' | sed "s,^,$(basename "$header"): ,; s,\$, is not TYPE_COUNT," || true
    done
}

found=$(wrong include/lampion)
[ -z "$found" ] || fail "$found"
[ "$(declarations include/lampion/*.h | wc -l)" -gt 120 ] || fail "the check finds too few functions"

cat >"$WORK/planted.h" <<'H'
typedef enum lmp_planted_kind { LMP_PLANTED_ONE = 0, LMP_OTHER, /* of
                                    two lines */ LMP_PLANTED_KIND_COUNT } lmp_planted_kind;
#define LMP_PLANTED_KINDS (LMP_PLANTED_ONE + 1)
LMP_API void lmp_strange_make(int bands);
LMP_API void lmp_planted_thing(float *sh);
LMP_API void lmp_planted_make(int a, int b, int c, int d, int e, int f, int g, int h, int i);
LMP_API void lmp_planted_add(float *sh, int bands, const lmp_host *host, int count);
LMP_API void lmp_planted_sum(lmp_vec3_array points, size_t count, float *rgb);
LMP_API void lmp_planted_eval_n(lmp_vec3_array points, size_t count, lmp_sh_layout layout, size_t stride, float *sh);
LMP_API lmp_result lmp_planted_read(const lmp_host *host, const void *data, size_t size, lmp_planted **planted);
LMP_API void lmp_planted_write(const lmp_planted *planted, void *bytes);
LMP_API lmp_result lmp_planted_create(int bands, lmp_planted **planted);
H
sed 's,^LMP_API \(.*\),/* \1 of\n * two lines */\n&,' "$WORK/planted.h" >"$WORK/planted.tmp" && mkdir -p "$WORK/planted" && mv "$WORK/planted.tmp" "$WORK/planted/planted.h"
wrong "$WORK/planted" >"$WORK/found"
for text in 'lmp_strange_make is not of' 'lmp_planted_thing returns no value' 'lmp_planted_make takes more' 'lmp_planted_add does not take the host' \
    'lmp_planted_add does not take the bands' 'lmp_planted_add counts' 'lmp_planted_sum works on arrays' 'lmp_planted_sum writes colors' \
    'lmp_planted_eval_n writes coefficients' 'lmp_planted_read reads bytes' 'lmp_planted_write writes to memory' 'lmp_planted_create allocates' \
    'LMP_OTHER does not begin' 'LMP_PLANTED_KIND_COUNT counts' 'LMP_PLANTED_KINDS is not'; do
    grep -q "$text" "$WORK/found" || fail "goes unseen: $text ($(cat "$WORK/found"))"
done
