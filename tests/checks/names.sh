# SPDX-License-Identifier: MIT
# Names tell what a thing is: lmp_ and LMP_ what the public headers have, lmpi_ and LMPI_ what is the library's own;
# _tmpl.h a body that is compiled once for each instruction set. Conditionals on instruction sets have their homes.
set -eu
. tests/checks/common.sh

# words FOLDER: prints the library's names in it; a name that a compiler is told to define (-DNAME) counts, too.
words() { grep -rhoE '(\b|-D)(lmpi?|LMPI?)_\w+' "$1" | sed 's/^-D//' | sort -u; }

# public ROOT: prints private names in public headers.
public() { words "$1/include" | grep -iE '^lmpi_' || true; }

# private ROOT: prints private names of the library that look public. The installed shaders share lmp_lookup_ with C.
private() {
    words "$1/include" >"$WORK/declared"
    words "$1/src" | grep -E '^(lmp|LMP)_' | grep -vE '^(lmp|LMP)_(lookup|LOOKUP)_' | grep -vxFf "$WORK/declared" || true
}

# bodies ROOT: prints headers that depend on the number of lanes, but are not named as bodies.
bodies() {
    (cd "$1" && grep -rlw LMPI_LANES src --include='*.h') | grep -vE '_tmpl\.h$|/lanes[a-z0-9_]*\.h$' || true
}

# conditionals ROOT: prints conditionals on instruction sets outside lanes.h, what it includes, and the builds.
conditionals() {
    (cd "$1" && grep -rnE '^ *# *(if|ifdef|ifndef|elif)\b.*(LMPI_(LANES|STREAMS|KERNELS_X86|KERNELS_VECTOR)\b|__(SSE|AVX|ARM|wasm|x86))' src) |
        grep -vE '/lanes[a-z0-9_]*\.h:|build_tmpl\.h:' || true
}

found=$(public .)
[ -z "$found" ] || fail "public headers have private names:" $found
found=$(private .)
[ -z "$found" ] || fail "no public header has what begins with lmp_ or LMP_ in src/:" $found
found=$(bodies .)
[ -z "$found" ] || fail "these depend on LMPI_LANES, and are not NAME_tmpl.h:" $found
found=$(conditionals .)
[ "$(echo "$found" | wc -l)" -lt 10 ] || fail "ten conditionals on instruction sets or more:
$found"

# Each kind of violation must be found.
mkdir -p "$WORK/include" "$WORK/src"
echo 'void lmp_shown(void); void lmpi_hidden(void);' >"$WORK/include/shown.h"
printf 'void lmp_shown(void);\nvoid lmp_own(void);\n#if LMPI_LANES == 4\n#endif\n' >"$WORK/src/own.h"
[ "$(public "$WORK")" = lmpi_hidden ] || fail "a private name in a public header goes unseen"
[ "$(private "$WORK")" = lmp_own ] || fail "a private name without its prefix goes unseen"
[ "$(bodies "$WORK")" = src/own.h ] || fail "a body without its name goes unseen"
[ "$(conditionals "$WORK")" = 'src/own.h:3:#if LMPI_LANES == 4' ] || fail "a conditional goes unseen"
