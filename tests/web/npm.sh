# SPDX-License-Identifier: MIT
# The npm package: the same bytes from the same commit, structs where C has them, every function in node (npm.mjs), wrong
# arguments (npm_faults.mjs, npm_fuzz.mjs), types that agree with the code, and three.js, Babylon.js and PlayCanvas in a
# headless browser against `lampion render` of the scenes that pages of three export. It needs Emscripten, npm, node and
# Chromium, and the engines, which the examples' package-lock.json name, from npm's registry or its cache.
set -eu
. tests/checks/common.sh
export ASAN_OPTIONS=detect_leaks=0 # GL drivers leak at exit
skip() {
    echo "skipped: $*"
    exit 0
}
for tool in emcc node npm chromium; do
    command -v $tool >/dev/null || skip "$tool is not installed"
done
. web/emscripten.sh

for out in once twice; do
    sh web/package/pack.sh "$BUILD/npm" "$WORK/$out" >"$WORK/log" 2>&1 || fail "$(tail -c 2000 "$WORK/log")"
done
package=$(echo "$WORK"/once/lampion-*.tgz)
cmp -s "$package" "$WORK/twice/$(basename "$package")" || fail "packed twice, the package differs"
tar -tzf "$package" >"$WORK/files"
for file in README.md LICENSE index.js index.d.ts api.d.ts three.js babylon.js playcanvas.js expanded.js lampion.wasm lampion-scalar.wasm shaders/lampion.glsl; do
    grep -qx "package/$file" "$WORK/files" || fail "the package lacks $file"
done

# Structs have the layout that C gives them.
api=$BUILD/npm/simd/web/package
node --input-type=module - "$api/api.js" >"$WORK/layout.c" <<'END'
const { structs, constants } = await import(process.argv[2]);
console.log('#include <lampion/lampion.h>');
for (const [name, { size, members }] of Object.entries(structs)) {
    console.log(`_Static_assert(sizeof(lmp_${name}) == ${size}, "${name}");`);
    for (const [member, , at] of members)
        console.log(`_Static_assert(offsetof(lmp_${name}, ${member}) == ${at}, "${name}.${member}");`);
}
for (const [name, value] of Object.entries(constants))
    if (Number.isInteger(value) && Math.abs(value) < 2 ** 32)
        console.log(`_Static_assert((long long)(LMP_${name}) == ${value}, "${name}");`);
END
[ "$(grep -c . "$WORK/layout.c")" -gt 400 ] || fail "too few structs and constants"
emcc -std=c11 -Iinclude -fsyntax-only "$WORK/layout.c" 2>"$WORK/log" || fail "$(head -c 2000 "$WORK/log")"

# As a user has it: a fresh folder, three and the package.
export XDG_CACHE_HOME="$WORK/cache"
# enter ENGINE: its example, installed.
enter() {
    mkdir -p "$WORK/examples/$1"
    cp "$SOURCE/examples/$1"/* "$WORK/examples/$1"
    cd "$WORK/examples/$1"
    npm ci --ignore-scripts --no-audit --no-fund --fetch-retries 0 --fetch-timeout 60000 >"$WORK/log" 2>&1 || {
        ! grep -Eq 'EINTEGRITY|EUSAGE|EJSONPARSE' "$WORK/log" || fail "$(cat "$WORK/log")"
        skip "npm cannot reach its registry"
    }
    npm install --no-save --offline --no-audit --no-fund "$package" >"$WORK/log" 2>&1 || fail "$(cat "$WORK/log")"
}
for engine in babylon playcanvas; do
    enter $engine
    cp "$SOURCE/tests/web/npm_engines.mjs" .
    node npm_engines.mjs $engine >"$WORK/log" 2>&1 || fail "$engine: $(tail -c 3000 "$WORK/log")"
done
enter three
page=$WORK/examples/three
for script in npm npm_faults npm_fuzz; do
    cp "$SOURCE/tests/web/$script.mjs" .
    node $script.mjs >"$WORK/log" 2>&1 || fail "$(tail -c 3000 "$WORK/log")"
done
cp "$SOURCE/examples/npm/relight.mjs" .
node relight.mjs >"$WORK/log" 2>&1 || fail "$(tail -c 3000 "$WORK/log")"
awk '/root mean square error/ { found = 1; if (!($(NF - 1) <= 3)) exit 1 } END { exit !found }' "$WORK/log" || fail "relight.mjs: $(cat "$WORK/log")"

# Types agree with what node has just run, and refuse what it refused.
if command -v tsc >/dev/null; then
    cp "$SOURCE/tests/web/npm.ts" .
    # of three's own types, what three.d.ts names
    cat >three.d.ts <<'END'
declare module 'three' {
    export class Object3D { add(...objects: Object3D[]): this }
    export class LightProbe extends Object3D {}
    export class Scene extends Object3D {}
    export class Material {}
    export class MeshStandardMaterial extends Material { roughness: number }
    export class Box3 {}
    export class Color {}
    export type ColorRepresentation = Color | string | number;
    export class Quaternion {}
}
END
    # and of the other engines'
    cat >engines.d.ts <<'END'
declare module '@babylonjs/core/scene.js' { export class Scene {} }
declare module '@babylonjs/core/Materials/material.js' { export class Material {} }
declare module '@babylonjs/core/Maths/math.color.js' { export class Color3 {} }
declare module '@babylonjs/core/Maths/math.vector.js' { export class Vector3 { constructor(x: number, y: number, z: number) } }
declare module '@babylonjs/core/Meshes/transformNode.js' { export class TransformNode { constructor(name: string, scene: object) } }
declare module 'playcanvas' {
    export class AppBase {}
    export class Color {}
    export class Entity { constructor(name: string) }
    export class Material {}
    export class Vec3 { constructor(x: number, y: number, z: number) }
}
END
    tsc --noEmit --strict --target es2022 --module nodenext --moduleResolution nodenext --lib es2022,dom three.d.ts engines.d.ts npm.ts >"$WORK/log" ||
        fail "$(head -c 2000 "$WORK/log")"
fi

# draw NAME PAGE OPTION…: writes NAME.exr by the page, and truth.exr of the scene that it exports by lampion render.
draw() {
    name=$1
    node "$SOURCE/tests/web/receive.mjs" . "$2" three.exr >"$WORK/log" 2>&1 || fail "$name: $(cat "$WORK/log")"
    shift 2
    mv three.exr "$name.exr"
    "$PROGRAM" render scene.gltf --lights lights.json --hide-lights --environment none --no-shadows --size 320x200 "$@" -o truth.exr
}
within() {
    "$PROGRAM" compare "$1.exr" truth.exr --fail-above relmse="$2" >"$WORK/log" 2>&1
}

draw alone '?export&alone' --bands 16
within alone 2e-5 || fail "30 lights: $(cat "$WORK/log")"
draw beside '?export' --bands 16 --keep-lights
within beside 0.01 || fail "beside three's own lights: $(cat "$WORK/log")"
! within alone 0.01 || fail "lights that are missing go unseen"
draw webgpu '?export&alone&webgpu' --bands 16
within webgpu 2e-5 || fail "30 lights by WebGPU: $(cat "$WORK/log")"
draw probe '?export&probe' --bands 3 --window none --material matte=lambert:1,1,1
within probe 1e-4 || fail "a probe: $(cat "$WORK/log")"
draw volume '?export&volume' --bands 3 --material matte=lambert:1,1,1
within volume 0.02 || fail "a volume of probes: $(cat "$WORK/log")"
draw webgpu '?export&volume&webgpu' --bands 3 --material matte=lambert:1,1,1
within webgpu 0.02 || fail "a volume of probes by WebGPU: $(cat "$WORK/log")"
! within probe 0.02 || fail "probes that are missing go unseen"

# The same scenes by other engines, whose meshes are three's; disposed of, the lights are gone.
cp truth.exr volume-truth.exr
draw alone '?export&alone' --bands 16
cp truth.exr alone-truth.exr
for engine in babylon playcanvas; do
    for scene in alone volume; do
        node "$SOURCE/tests/web/receive.mjs" .. "$engine/index.html?export&$scene" disposed.floats >"$WORK/log" 2>&1 || fail "$engine: $(cat "$WORK/log")"
        node "$SOURCE/tests/web/exr.mjs" ../image.floats 320 200 $engine-$scene.exr
        cp $scene-truth.exr truth.exr
        [ $scene = alone ] && bound=2e-5 || bound=0.02
        within $engine-$scene $bound || fail "$engine, $scene: $(cat "$WORK/log")"
        cat "$WORK/log"
        node -e 'process.exit(new Float32Array(fs.readFileSync("../disposed.floats").buffer).some((value, i) => i % 4 < 3 && value) ? 1 : 0)' ||
            fail "$engine, $scene: light is left"
    done
    ! within $engine-alone 0.02 || fail "$engine: probes and lights look alike"
done

# The README's block is the module of the page of docs/npm.md, which is run with the lines that export it.
code_blocks "$SOURCE/README.md" js >readme.js
[ -s readme.js ] || fail "README.md has no block in JavaScript"
code_blocks "$SOURCE/docs/npm.md" html | sed -n '/^import \* as/,/^<\/script>/{/^<\/script>/d;p}' | cmp -s - readme.js ||
    fail "README.md and docs/npm.md show different pages"
sed -n '/^```html$/,/^```$/{/^```/d;p}' "$SOURCE/docs/npm.md" | sed 's/innerWidth/320/g; s/innerHeight/200/g; /^<\/script>$/d' >first.html
cat >>first.html <<'END'
const { EXRExporter, NO_COMPRESSION } = await import('./node_modules/three/examples/jsm/exporters/EXRExporter.js');
const { GLTFExporter } = await import('./node_modules/three/examples/jsm/exporters/GLTFExporter.js');
const target = new THREE.WebGLRenderTarget(320, 200, { type: THREE.FloatType });
scene.add(camera);
lights.update();
renderer.setRenderTarget(target);
renderer.render(scene, camera);
const send = (name, body) => fetch(name, { method: 'PUT', body });
await send('scene.gltf', JSON.stringify(await new GLTFExporter().parseAsync(scene)));
await send('lights.json', JSON.stringify({ lights: [{ position: lamp.position.toArray(), radius: lamp.radius, radiance: lamp.color.toArray().map((value) => lamp.radiance * value) }] }));
await send('three.exr', await new EXRExporter().parse(renderer, target, { type: THREE.FloatType, compression: NO_COMPRESSION }));
</script>
END
draw first first.html --bands 10
within first 4e-4 || fail "the page of docs/npm.md is not within 2 %: $(cat "$WORK/log")"

# Materials of every kind by WebGPU.
cp "$SOURCE/tests/web/materials.html" "$page"
node "$SOURCE/tests/web/materials.mjs" "$page" >"$WORK/log" 2>&1 || fail "$(cat "$WORK/log")"

# section_blocks NAME: the blocks in JavaScript of a section of docs/npm.md.
section_blocks() {
    awk -v name="$1" '/^##/ { inside = $0 ~ name "$" } inside' "$SOURCE/docs/npm.md" >section.md
    code_blocks section.md js
}
{
    cat <<'END'
import { RectAreaLight, Vector3 } from 'three';
const light = new RectAreaLight(0xffffff, 5, 0.02, 0.01), printed = [];
light.position.set(0, 3, 0);
light.lookAt(0, 0, 0);
console.log = ({ r, g, b }) => printed.push(`{ r: ${r.toFixed(3)}, g: ${g.toFixed(3)}, b: ${b.toFixed(3)} }`);
END
    section_blocks 'The library'
    section_blocks 'From PointLight and RectAreaLight'
    cat <<'END'
const { r: below } = lmp.light_irradiance([panel], 1, [0, 0, 0], [0, 1, 0]), wanted = 5 * 0.02 * 0.01 / 9;
if (!(Math.abs(below - wanted) <= 1e-4 * wanted))
    throw new Error(`under the panel: ${below}, not ${wanted}`);
process.stdout.write(`${printed.join('\n')}\n`);
END
} >shown.mjs
section_blocks 'The library' | sed -n 's|^console.log.*// ||p' >printed
[ "$(grep -c . printed)" -ge 3 ] || fail "docs/npm.md prints too little"
node shown.mjs >"$WORK/log" 2>&1 || fail "docs/npm.md: $(cat "$WORK/log")"
cmp "$WORK/log" printed || fail "docs/npm.md says $(cat printed), and prints $(cat "$WORK/log")"

# A room of lanterns on probes, lit beside the page and within it.
node "$SOURCE/tests/web/lanterns.mjs" "$page" >"$WORK/log" 2>&1 || fail "$(cat "$WORK/log")"
