# SPDX-License-Identifier: MIT
# Who may include whom: reads every #include of src/, include/ and app/ against the order of layers,
# and shows that a violation would be found.
set -eu
. tests/checks/common.sh

standard='assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal
stdalign stdarg stdatomic stdbool stddef stdint stdlib stdnoreturn string tgmath'

# may_include MODULE: the modules below it, and itself.
may_include() {
    case $1 in
    base) echo base ;;
    kernels) echo base cpu kernels lookup ;;
    sh) echo base kernels sh ;;
    light) echo base kernels sh light ;;
    lobe | brdf) echo base kernels sh light "$1" ;;
    probe) echo base kernels sh light lobe probe ;;
    preintegrated) echo base kernels sh light lobe brdf preintegrated lookup ;;
    shade) echo base kernels sh light lobe brdf preintegrated shade ;;
    field) echo base kernels sh light lobe brdf preintegrated shade field ;;
    cpu) echo base cpu ;;
    lampion) echo base cpu sh light lobe probe brdf preintegrated shade field kernels ;;
    app/memory) echo app/memory ;;
    app/timing) echo app/timing ;;
    app/cli) echo app/timing app/cli base cpu ;;
    app/zonal) echo app/zonal base sh light ;;
    app/device) echo app/cli app/device ;;
    app/method) echo app/cli app/device app/method base shade field sh ;;
    app/bake) echo app/cli app/file app/bake LIBRARY ;;
    # it judges all of them: nothing but itself
    ruler) echo ruler ;;
    app/ruler) echo app/cli app/file app/ruler ;;
    app/scoreboard) echo app/timing app/cli app/file app/image app/figure app/scene app/reference app/ruler app/scoreboard base sh light lobe brdf preintegrated shade ;;
    app/csv) echo app/cli app/csv ;;
    app/file) echo app/cli app/file ;;
    app/sandbox) echo app/cli app/sandbox ;;
    app/image) echo app/cli app/file app/sandbox app/image shaders
        ;;
    app/compare) echo app/cli app/image app/compare ;;
    app/figure) echo app/cli app/image app/figure base ;;
    app/scene) echo app/cli app/file app/sandbox app/image app/scene LIBRARY ;;
    app/environment) echo app/cli app/image app/scene app/environment LIBRARY ;;
    app/trace) echo app/memory app/image app/scene app/trace ;;
    app/animation) echo app/cli app/file app/scene app/animation base ;;
    # it judges: no kernel, no shading, no table of the library (read_tables below)
    app/reference) echo app/cli app/file app/image app/scene app/environment app/trace app/reference base sh light lobe brdf ;;
    app/material) echo app/cli app/file app/sandbox app/bake app/material base sh brdf preintegrated ;;
    app/render/frame) echo app/memory app/cli app/image app/device app/environment app/method app/scene app/trace app/render/frame LIBRARY ;;
    app/render/shade) echo app/timing app/cli app/bake app/environment app/scene app/method app/trace app/render/frame app/render/shade LIBRARY ;;
    app/render/gl) echo app/timing app/zonal app/cli app/file app/image app/environment app/device app/method app/scene app/render/frame app/render/gl shaders lookup LIBRARY ;;
    app/render/cpu) echo app/memory app/timing app/cli app/image app/environment app/method app/scene app/trace app/render/frame app/render/shade app/render/cpu LIBRARY ;;
    app/render) echo app/timing app/cli app/device app/image app/scene app/trace app/render/frame app/render/gl app/render/cpu app/render LIBRARY ;;
    app/render/shadow) echo app/memory app/timing app/cli app/scene app/environment app/trace app/render/frame app/render/shadow LIBRARY ;;
    app/volume) echo app/cli app/sandbox app/file app/csv app/bake app/scene app/environment app/trace app/render app/render/frame app/render/gl app/render/shadow app/volume LIBRARY ;;
    app/override) echo app/cli app/method app/scene app/material app/render app/render/frame app/render/gl app/override LIBRARY ;;
    app/view) echo app/cli app/environment app/file app/image app/scene app/animation app/material app/render app/render/frame app/render/gl app/device app/method app/bake app/render/shade app/render/shadow app/override app/view LIBRARY ;;
    app/paper) echo app/timing app/zonal app/cli app/file app/method app/override app/compare app/figure app/render app/render/frame app/render/gl app/image app/reference app/scene app/paper app/material LIBRARY ;;
    app/bench) echo app/timing app/zonal app/cli app/device app/method app/scene app/material app/render app/render/frame app/render/gl app/bake app/render/shade app/override app/bench LIBRARY ;;
    app/command) echo app/bench app/environment app/zonal app/timing app/cli app/method app/bake app/render/shade app/render/shadow app/override app/animation app/paper app/compare app/csv app/file app/image app/figure app/scene app/trace app/reference app/ruler app/scoreboard app/render app/render/frame app/render/gl app/device app/material app/view app/volume \
        app/command shaders LIBRARY ;;
    esac | sed 's/LIBRARY/base cpu kernels sh light lobe probe brdf preintegrated shade field lampion/'
}

# modules: of each file of standard input a line, the file and its module.
modules() {
    sed -n 's,^\(src/\([^/]*\)/.*\),\1 \2,p; t
        s,^\(include/lampion/\(.*\)\.h\),\1 \2,p; t
        s,^\(\(app/render/[^/]*\)/.*\),\1 \2,p; t
        s,^\(\(app/[^/]*\)/.*\),\1 \2,p; t
        s,^ruler/.*,& ruler,p'
}

# violations ROOT: prints a line for each include that breaks the order.
violations() (
    cd "$1"
    ls -d src/*/*.[ch] include/lampion/*.h app/*/*.[ch] app/render/*/*.[ch] ruler/*.[ch] 2>/dev/null |
        modules | sort -u >"$WORK/modules"
    cut -d ' ' -f 2 "$WORK/modules" | sort -u | while read -r module; do
        echo "$module $(echo $(may_include "$module"))"
    done >"$WORK/allowed"
    awk -v standard="$(echo $standard)" '
        # reached_by INCLUDE: the module it reaches into, nothing for a system header
        function reached_by(include, name, part) {
            name = substr(include, 2, length(include) - 2)
            if (include ~ /^<lampion\//) return substr(name, 9, length(name) - 10)
            if (include ~ /^</) return ""
            split(name, part, "/")
            if (name == "shaders/preintegrated_lookup.h") return "lookup"
            if (name ~ /^app\/render\/[^\/]*\//) return "app/render/" part[3]
            if (name ~ /^app\/[^\/]*\//) return "app/" part[2]
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
    grep -rn 'lmp_brdf_table_[a-z_]* *(' "$1/app/reference" || true
}

found=$(violations .; read_tables .)
[ -z "$found" ] || fail "$found"

# plant FILE INCLUDE: the violation must be seen.
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
plant app/reference/planted.c '<lampion/shade.h>'
plant app/reference/planted.c '"src/kernels/kernels.h"'
mkdir -p "$WORK/app/reference"
echo 'lmp_brdf_table_view(table, 1, 0, rgb);' >"$WORK/app/reference/planted.c"
[ -n "$(read_tables "$WORK")" ] || fail "the reference may read the library's tables unseen"
rm "$WORK/app/reference/planted.c"
plant app/cli/planted.c '"app/command/command.h"'
plant src/novel/planted.c '<math.h>'
mkdir -p "$WORK/src/shade"
printf '#include "src/light/light.h"\n#include <math.h>\n' >"$WORK/src/shade/allowed.c"
[ -z "$(violations "$WORK")" ] || fail "an include that is allowed was refused"
