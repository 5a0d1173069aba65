# SPDX-License-Identifier: MIT
# Who may include whom: reads every #include of src/, include/ and app/ against the order of layers,
# and shows that a violation would be found.
set -eu
. tests/checks/common.sh

standard='assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal
stdalign stdarg stdatomic stdbool stddef stdint stdlib stdnoreturn string tgmath'

readers=$(ls -d app/scene/*/ | sed 's,/$,,' | grep -vxE 'app/scene/(trace|load)')

# may_include MODULE: prints the modules below it, and itself.
may_include() {
    case $1 in
    base) echo base ;;
    kernels) echo base cpu kernels lookup ;;
    sh) echo base kernels sh ;;
    sphere) echo base kernels sh sphere ;;
    light) echo base kernels sh sphere light ;;
    lobe | brdf) echo base kernels sh sphere light "$1" ;;
    probe) echo base kernels sh sphere light lobe probe ;;
    preintegrated) echo base kernels sh sphere light lobe brdf preintegrated lookup ;;
    material) echo base brdf preintegrated material ;;
    shade) echo base kernels sh sphere light lobe brdf preintegrated material shade ;;
    field) echo base kernels sh sphere light lobe brdf preintegrated material shade field ;;
    transfer) echo base kernels sh sphere light lobe brdf preintegrated material shade field transfer ;;
    cpu) echo base cpu ;;
    lampion) echo base cpu sh sphere light lobe probe brdf preintegrated material shade field transfer kernels ;;
    # The reference judges the others, so it may include only itself.
    ruler) echo ruler ;;
    app/base) echo app/base base cpu ;;
    app/image) echo app/base app/image base shaders ;;
    app/scene) echo app/base app/image app/scene LIBRARY ;;
    app/scene/trace) echo app/base app/scene app/scene/trace ;;
    app/scene/load) echo app/base app/scene app/scene/load $readers LIBRARY ;;
    # built-in scenes, and a folder for each reader that takes many files
    app/scene/*) echo app/base app/image app/scene "$1" LIBRARY ;;
    app/render) echo app/base app/scene app/scene/trace app/render LIBRARY ;;
    app/render/gl) echo app/base app/image app/scene app/render app/render/gl shaders lookup LIBRARY ;;
    app/render/cpu | app/render/shadow) echo app/base app/image app/scene app/scene/trace app/render "$1" LIBRARY ;;
    app/render/renderer) echo app/base app/image app/scene app/render app/render/gl app/render/cpu app/render/shadow app/render/renderer LIBRARY ;;
    # This room judges: it uses no kernel, no shading and no table of the library (read_tables below).
    app/truth/reference) echo app/base app/image app/scene app/scene/trace app/truth/reference base sh sphere light lobe brdf ;;
    app/truth) echo app/base app/image app/scene app/truth app/truth/reference base sh sphere light lobe brdf preintegrated material shade ;;
    app/study) echo app/base app/image app/scene app/scene/trace app/render app/render/gl app/render/shadow app/render/renderer app/truth/reference app/study LIBRARY ;;
    app/view) echo app/base app/image app/scene app/scene/trace app/render app/render/gl app/render/renderer app/view LIBRARY ;;
    app/command) echo app/base app/image app/scene app/scene/trace app/render app/render/renderer app/truth \
        app/truth/reference app/study app/view app/command shaders LIBRARY ;;
    esac | sed 's/LIBRARY/base cpu kernels sh sphere light lobe probe brdf preintegrated material shade field transfer lampion/'
}

# modules: prints, for each file of standard input, the file and its module.
modules() {
    sed -n 's,^\(src/\([^/]*\)/.*\),\1 \2,p; t
        s,^\(include/lampion/\(.*\)\.h\),\1 \2,p; t
        s,^\(app/truth/reference.*\),\1 app/truth/reference,p; t
        s,^\(\(app/.*\)/[^/]*\)$,\1 \2,p; t
        s,^ruler/.*,& ruler,p'
}

# violations ROOT: prints a line for each include that breaks the order.
violations() (
    cd "$1"
    ls -d src/*/*.[ch] include/lampion/*.h app/*/*.[ch] app/*/*/*.[ch] ruler/*.[ch] 2>/dev/null |
        modules | sort -u >"$WORK/modules"
    cut -d ' ' -f 2 "$WORK/modules" | sort -u | while read -r module; do
        echo "$module $(echo $(may_include "$module"))"
    done >"$WORK/allowed"
    awk -v standard="$(echo $standard)" '
        # reached_by INCLUDE: the module it reaches into, or nothing for a system header.
        function reached_by(include, name, part) {
            name = substr(include, 2, length(include) - 2)
            if (include ~ /^<lampion\//) return substr(name, 9, length(name) - 10)
            if (include ~ /^</) return ""
            split(name, part, "/")
            if (name == "shaders/lampion/preintegrated_lookup.h") return "lookup"
            if (name ~ /^app\/truth\/reference/) return "app/truth/reference"
            if (sub(/^app\//, "app/", name) && sub(/\/[^\/]*$/, "", name)) return name
            if (name ~ /^src\/[^\/]*\//) return part[2]
            return name ~ /^(shaders|ruler)\// ? part[1] : "unrooted"
        }
        BEGIN {
            split(standard, names, " ")
            for (i in names) is_standard[names[i] ".h"]
        }
        FILENAME == ARGV[1] {
            known[$1] = NF > 1
            for (i = 2; i <= NF; i++) may[$1, $i]
            next
        }
        FILENAME == ARGV[2] {
            module_of[$1] = $2
            if (!known[$2]) print $1 ": unknown module " $2
            next
        }
        { module = module_of[FILENAME] }
        known[module] && /^ *# *include *[<"][^>"]*[>"]/ {
            match($0, /[<"][^>"]*[>"]/)
            include = substr($0, RSTART, RLENGTH)
            reached = reached_by(include)
            if (reached != "") {
                if (!((module, reached) in may)) print FILENAME ": " module " must not include " include
                next
            }
            name = substr(include, 2, length(include) - 2)
            if (FILENAME ~ /^(app|ruler)\// || name in is_standard) next
            if (module == "kernels" && name ~ /intrin\.h$|^cpuid\.h$|^arm_|^wasm_/) next
            print FILENAME ": the library must not need " include
        }' "$WORK/allowed" "$WORK/modules" $(cut -d ' ' -f 1 "$WORK/modules")
)

# read_tables ROOT: prints where the reference renderer asks the library to read a BRDF's table.
read_tables() {
    grep -rn 'lmp_brdf_table_[a-z_]* *(' "$1"/app/truth/reference* || true
}

found=$(violations .; read_tables .)
[ -z "$found" ] || fail "$found"

# plant FILE INCLUDE: plants a violation, which must be found.
plant() {
    mkdir -p "$WORK/$(dirname "$1")"
    printf '#include %s\n' "$2" >"$WORK/$1"
    [ -n "$(violations "$WORK")" ] || fail "$1 may include $2 unseen"
    rm "$WORK/$1"
}
plant src/sh/planted.c '"src/light/light.h"'
plant ruler/planted.c '"src/light/light.h"'
plant ruler/planted.c '<lampion/light.h>'
plant src/base/planted.c '<stdio.h>'
plant src/light/planted.h '"planted.h"'
plant include/lampion/sh.h '<lampion/light.h>'
plant app/scene/planted.c '"app/render/gl/gpu.h"'
plant app/truth/reference_planted.c '<lampion/shade.h>'
plant app/truth/reference_planted.c '"src/kernels/kernels.h"'
plant app/truth/reference_planted.c '"app/truth/ruler_table.h"'
mkdir -p "$WORK/app/truth"
echo 'lmp_brdf_table_interpolate(table, 1, 0, rgb);' >"$WORK/app/truth/reference_planted.c"
[ -n "$(read_tables "$WORK")" ] || fail "the reference may read the library's tables unseen"
rm "$WORK/app/truth/reference_planted.c"
plant app/base/planted.c '"app/command/command.h"'
plant app/scene/planted.c '"app/scene/load/import.h"'
plant src/novel/planted.c '<math.h>'
mkdir -p "$WORK/src/shade"
printf '#include "src/light/light.h"\n#include <math.h>\n' >"$WORK/src/shade/allowed.c"
[ -z "$(violations "$WORK")" ] || fail "an include that is allowed was refused"
