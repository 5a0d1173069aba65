# SPDX-License-Identifier: MIT
# lampion.glsl, area.glsl, preintegrated_lookup.h, preintegrated_lobe.glsl and preintegrated_brdf.glsl are valid GLSL 4.50, GLSL for Vulkan and GLSL ES 3.10
# (glslang's judgement), in a compute shader that calls all of it and in the example's fragment shader.
set -eu
. tests/checks/common.sh
command -v glslangValidator >/dev/null || {
    echo "skipped: glslangValidator is not installed (package glslang-tools)"
    exit 0
}

# shader VERSION BANDS WINDOW: a compute shader; the window by its number, or as weights; materials of
# odd bands are glTF's
shader() {
    echo "#version $1"
    echo "precision highp float; precision highp int;"
    echo "#define LMP_BANDS $2"
    case $3 in
    [0-9]) echo "#define LMP_WINDOW $3" ;;
    *) echo "#define LMP_WINDOW_WEIGHTS $3" ;;
    esac
    cat <<'GLSL'
layout(local_size_x = 64) in;
layout(std140, binding = 0) uniform lights_block { vec4 user_lights[64]; };
layout(std430, binding = 0) buffer out_block { vec4 values[]; };
#define LMP_LIGHT_COUNT       32
#define LMP_LIGHT_SPHERE(at)   user_lights[2 * (at)]
#define LMP_LIGHT_RADIANCE(at) user_lights[2 * (at) + 1].rgb
layout(std430, binding = 6) readonly buffer area_block { vec4 user_areas[]; };
#define LMP_AREA_COUNT 2
#define LMP_AREA_TEXEL(at, texel) user_areas[11 * (at) + (texel)]
GLSL
    material="lmp_material(vec3(0.5), vec3(0.04), 20.0)"
    if [ $(($2 % 2)) = 1 ]; then
        echo "layout(std430, binding = 5) readonly buffer ggx_block { vec4 user_ggx_texels[]; };"
        echo "#define LMP_GGX_TEXEL(at) user_ggx_texels[at]"
        cat shaders/lampion/ggx.glsl
        material="lmp_metallic_roughness(vec3(0.5), 0.5, 0.4)"
    fi
    cat shaders/lampion/lampion.glsl
    if [ $(($2 % 2)) = 1 ]; then
        cat shaders/lampion/coat.glsl
        material="lmp_lobes_of(surface, lmp_coat(1.0, 0.4))"
    fi
    cat shaders/lampion/coefficients.glsl shaders/lampion/area.glsl shaders/lampion/preintegrated_lookup.h
    cat <<'GLSL'
layout(binding = 1) uniform highp sampler2D user_pairs;
layout(std430, binding = 2) readonly buffer lobe_block { vec4 user_shape; vec4 user_cells[64]; float user_remap[LMP_LOOKUP_REMAP_COUNT]; };
#define LMP_PREINTEGRATED_LOBE_PAIR(at) textureLod(user_pairs, at / 2048.0, 0.0).rg
#define LMP_PREINTEGRATED_LOBE_CELL(at) user_cells[at]
#define LMP_PREINTEGRATED_LOBE_REMAP(at) user_remap[at]
#define LMP_PREINTEGRATED_LOBE_SHAPE   user_shape
GLSL
    cat shaders/lampion/preintegrated_lobe.glsl
    cat <<'GLSL'
layout(binding = 3) uniform highp sampler2D user_texels;
layout(std430, binding = 4) readonly buffer brdf_block { float user_brdf_values[]; };
#define LMP_PREINTEGRATED_BRDF_TEXEL(at) textureLod(user_texels, at / 4096.0, 0.0).rgb
#define LMP_PREINTEGRATED_BRDF_VALUE(at) user_brdf_values[at]
GLSL
    cat shaders/lampion/preintegrated_brdf.glsl
    echo "#define MATERIAL $material"
    cat <<'GLSL'
void main() {
    lmp_surface surface;
    surface.position = vec3(gl_GlobalInvocationID);
    surface.normal = surface.view = vec3(0.0, 0.0, 1.0);
    float sh[LMP_SH_COUNT];
    lmp_sphere_project(user_lights[0], surface.position, sh);
    values[gl_GlobalInvocationID.x] =
        vec4(lmp_shade_zonal(surface, MATERIAL) + lmp_shade_coefficients(surface, MATERIAL) +
                 lmp_shade_preintegrated(surface, MATERIAL) +
                 lmp_shade_preintegrated_brdf(surface, 0),
             sh[0] + lmp_area_irradiance(0, surface.position, surface.normal));
}
GLSL
}

# window VERSION: prints the example's fragment shader, with what its program puts before it.
window() {
    echo "#version $1"
    echo "precision highp float; precision highp int;"
    sed -n 's/^ *"\(#define LMP_.*\|uniform vec4 lights.*\)\\n".*/\1/p; /^static const char head/s/.*/#define LMP_BANDS 8/p' examples/lanterns.c |
        awk '!seen[$0]++'
    cat shaders/lampion/lampion.glsl examples/lanterns.frag
}

# What must be valid is gathered here, because glslang reads the language's own functions once a run.
valid=$WORK/valid
mkdir "$valid"
for form in "1 0" "2 1" "6 2"; do
    # shellcheck disable=SC2086
    set -- $form
    shader "450 core" "$1" "$2" >"$valid/core_$1.comp"
    shader "310 es" "$1" "$2" >"$valid/es_$1.comp"
    (cd "$WORK" && glslangValidator -V "$valid/core_$1.comp") >"$WORK/log" 2>&1 || fail "Vulkan: $(cat "$WORK/log")"
done
shader "450 core" 20 1 >"$valid/core_20.comp"
shader "450 core" 9 1 >"$valid/core_9.comp"
shader "310 es" 5 1 >"$valid/es_5.comp"
shader "310 es" 3 "1.0, 0.75, 0.25" >"$valid/es_3.comp"
for version in "450 core" "300 es"; do
    {
        echo "#version $version"
        echo "precision highp float;"
        cat shaders/lampion/probe.glsl
        echo "uniform vec4 a[3], b[3], c; in vec3 n; out vec4 color;"
        echo "void main() { color = vec4(lmp_probe_irradiance(a, b, c, normalize(n)), 1.0); }"
    } >"$valid/probe_${version%% *}.frag"
done
for version in "450 core" "300 es" "310 es"; do
    window "$version" >"$valid/window_${version%% *}.frag"
done
window=$valid/window_310.frag
# The oldest desktop version, and the one before it by an extension, without which lines cannot be continued.
pack='#extension GL_ARB_shading_language_420pack : require'
sed '1s/.*/#version 420 core/' "$window" >"$valid/window_420.frag"
sed "1s/.*/#version 330 core\n$pack/" "$window" >"$valid/window_330.frag"
sed 1d "$window" | sed '1s/^/#version 330 core\n/' >"$WORK/old.frag"
! glslangValidator "$WORK/old.frag" >"$WORK/log" 2>&1 || fail "GLSL 3.30 needs no extension"
# Names of one letter are the includer's, so each letter in turn is used for what the macros read.
letters="a b c d e f g h i j k l m n o p q r s t u v w x y z A B C D E F G H I J K L M N O P Q R S T U V W X Y Z"
shader "310 es" 3 1 | sed 's/^#define LMP_LIGHT_COUNT .*/uniform int user_count;\n#define LMP_LIGHT_COUNT user_count/' >"$WORK/named.comp"
step=5
[ "${LAMPION_LONG-}" != 1 ] || step=1
for first in $(seq 1 $step 52); do
    # shellcheck disable=SC2086
    set -- $letters $letters
    shift $((first - 1))
    renamed=
    for name in lights areas count ggx_texels pairs cells remap shape texels brdf_values; do
        renamed="$renamed;s/\\buser_$name\\b/$1/g"
        shift
    done
    sed "${renamed#;}" "$WORK/named.comp" >"$valid/letters_$first.comp"
done
(cd "$valid" && glslangValidator *) >"$WORK/log" 2>&1 || fail "$(cat "$WORK/log")"

sed 's/lmp_shade_zonal(surface/lmp_shade_zonal(surfaces/' "$window" >"$WORK/wrong.frag"
! glslangValidator "$WORK/wrong.frag" >"$WORK/log" 2>&1 || fail "an unknown name goes unseen"
if shader "450 core" 33 0 >"$WORK/shader.comp" && (cd "$WORK" && glslangValidator shader.comp) >"$WORK/log"; then
    fail "33 bands are not refused"
fi
