# SPDX-License-Identifier: MIT
# Every reader of foreign bytes is called by a fuzz target, and every target has seeds to begin with.
set -eu
. tests/checks/common.sh

# Finds the functions of headers that take bytes and their number, or an image as a file has it.
readers() {
    find include app -name '*.h' -exec sed 's,/\*.*\*/,,; /\/\*/,/\*\//d; /^#/d' {} + | tr '\n' ' ' | tr ';' '\n' |
        grep -E '(const (void|char|unsigned char|uint8_t) \*[a-z_]+, size_t [a-z_]+|const image_source \*[a-z]+)[,)]' |
        grep -oE '[a-z0-9_]*(_read|_decode|_keep|_parse|_validate|_open|_add|_find)(_[a-z0-9_]+)? *\(' | tr -d ' (' | sort -u
}

# What glTF and OBJ lead to; and Assimp's formats, what the program itself made, what hands a file on.
inner="texture_keep texture_keep_once gltf_open gltf_parse"
others="assimp_add bake_add_settings file_hash_add file_read file_read_descriptor file_read_json scene_read_lights"
# and those who read text up to its end, or lines
more="animation_open number_read csv_read_row file_cache_map gltf_add mtl_add obj_add scene_add_lights_file sgd_file_find texture_decode_all view_script_read"

readers >"$WORK/readers"
[ "$(wc -l <"$WORK/readers")" -gt 12 ] || fail "too few readers to be all: $(cat "$WORK/readers")"
for name in $more; do
    grep -rqw --include='*.h' "$name" app include || fail "$name is no function any more"
done
for name in $(cat "$WORK/readers") $more; do
    case " $inner $others " in *" $name "*) continue ;; esac
    grep -qw "$name" fuzz/*.c fuzz/*.h || fail "$name reads foreign bytes, and no fuzz target calls it"
done
for name in $inner; do
    grep -rlw --include='*.c' "$name" app/scene | grep -qE 'gltf|obj|mtl' || fail "neither glTF nor OBJ leads to $name"
done
for target in fuzz/*.c; do
    name=$(basename "$target" .c)
    [ -n "$(ls -A "fuzz/corpus/$name" 2>/dev/null)" ] || fail "$target has no seeds in fuzz/corpus/$name"
done
