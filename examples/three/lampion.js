// SPDX-License-Identifier: MIT
// Sphere lights of lampion.glsl in three.js' MeshStandardMaterial, and probes made by Lampion.
import { DataTexture, FloatType, LightProbe, RGBAFormat, Vector4 } from 'three';
const MOST = 64; // the most lights

// folder has lampion.glsl, ggx.glsl and ggx.f32, the table that ggx.glsl reads
export async function loadLampion(folder, bands = 10) {
    const [ggx, glsl, table] = await Promise.all(['ggx.glsl', 'lampion.glsl', 'ggx.f32'].map(
        async (name) => (await fetch(`${folder}/${name}`)).arrayBuffer()));
    const texels = new Float32Array(table);
    const texture = new DataTexture(texels, 32, texels.length / 128, RGBAFormat, FloatType);
    texture.needsUpdate = true;
    const vectors = Array.from({ length: 2 * MOST }, () => new Vector4());
    const uniforms = { lampionLights: { value: vectors }, lampionCount: { value: 0 }, lampionTexels: { value: texture } };
    const head = `
        uniform vec4 lampionLights[${2 * MOST}];
        uniform int lampionCount;
        uniform highp sampler2D lampionTexels;
        #define LMP_BANDS ${bands}
        #define LMP_WINDOW 1 // Hanning's, as lampion render has it
        #define LMP_LIGHT_COUNT lampionCount
        #define LMP_LIGHT_SPHERE(i) vec4((viewMatrix * vec4(lampionLights[2 * (i)].xyz, 1.0)).xyz, lampionLights[2 * (i)].w)
        #define LMP_LIGHT_RADIANCE(i) lampionLights[2 * (i) + 1].rgb
        #define LMP_GGX_TEXEL(i) texelFetch(lampionTexels, ivec2((i) % 32, (i) / 32), 0)
        ${new TextDecoder().decode(ggx)}${new TextDecoder().decode(glsl)}
        void main() {`;
    const body = `#include <lights_fragment_end>
        reflectedLight.directSpecular += lmp_shade_zonal(
            lmp_surface(geometryPosition, geometryNormal, geometryViewDir),
            lmp_metallic_roughness(diffuseColor.rgb, metalnessFactor, roughnessFactor));`;
    return {
        // position and radiance are arrays of three numbers, as in a lights.json; once a frame
        setLights(lights) {
            lights.slice(0, MOST).forEach(({ position, radius, radiance }, i) => {
                vectors[2 * i].set(...position, radius);
                vectors[2 * i + 1].set(...radiance, 0);
            });
            uniforms.lampionCount.value = Math.min(lights.length, MOST);
        },
        // call once for a MeshStandardMaterial
        patch(material) {
            material.onBeforeCompile = (shader) => {
                Object.assign(shader.uniforms, uniforms);
                shader.fragmentShader = shader.fragmentShader.replace('void main() {', () => head)
                    .replace('#include <lights_fragment_end>', body);
            };
            return material;
        },
    };
}

// Three planes of 9 coefficients, as lmp_light_project writes them. three.js' basis lacks the
// Condon-Shortley sign: odd m change theirs, at
// the odd indices of three bands. Both are of radiance: no factor.
export function probeOf(planes) {
    const probe = new LightProbe();
    for (let i = 0; i < 9; i++)
        probe.sh.coefficients[i].fromArray(planes.map((plane) => (i % 2 ? -plane[i] : plane[i])));
    return probe;
}
