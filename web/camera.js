// SPDX-License-Identifier: MIT
// The position and direction of the page's camera, and the frame_block of shared.h that holds them.
const sub = (a, b) => a.map((x, i) => x - b[i]);
const add = (a, b, s = 1) => a.map((x, i) => x + s * b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

// Returns v rotated around a unit axis.
function turn(v, axis, angle) {
    const c = Math.cos(angle), s = Math.sin(angle);
    return add(add(v.map((x) => x * c), cross(axis, v), s), axis, dot(axis, v) * (1 - c));
}

export function makeCamera({ eye, target, up, fov }, minimum, maximum) {
    const inside = eye.every((x, i) => x > minimum[i] && x < maximum[i]);
    const extent = Math.max(...sub([...maximum], [...minimum])) || 1;
    // WebGL's depth is less exact than the program's, so the near plane is ten times as far.
    const near = 1e-3 * extent;

    // Returns forward, right and down, as long as what a pixel's ray adds at the image's edge.
    function axes(aspect) {
        const half = Math.tan(fov / 2), forward = unit(sub(target, eye)), right = unit(cross(forward, up));
        return { forward, right: right.map((x) => x * half * aspect), down: cross(forward, right).map((x) => x * half), half };
    }

    return {
        frame(width, height, lightCount, areaCount) {
            const { forward, right, down, half } = axes(width / height), wide = half * width / height;
            const rows = [right.map((x) => x / wide ** 2), down.map((x) => x / half ** 2), forward.map((x) => -x), forward];
            const constants = [0, 0, 2 * near, 0], block = new Float32Array(48);
            for (let row = 0; row < 4; row++)
                [...rows[row], constants[row] - dot(rows[row], eye)].forEach((x, column) => { block[4 * column + row] = x; });
            block.set([...eye, near, ...forward, 0, ...right, 0, ...down, 0], 16);
            block.set([width, height, lightCount, areaCount, 0, 0, 0, 1], 36);
            return block;
        },
        // Returns the unit ray through a point of the image, -1 … 1 to the right and down.
        ray(x, y, aspect) {
            const { forward, right, down } = axes(aspect);
            return { eye, along: unit(add(add(forward, right, x), down, y)), forward };
        },
        // Returns where a point is in an image.
        project(point, width, height) {
            const { forward, right, down } = axes(width / height), from = sub(point, eye), depth = dot(from, forward);
            const part = (axis) => (dot(from, axis) / dot(axis, axis) / depth + 1) / 2;
            return [part(right) * width, part(down) * height];
        },
        // Returns where the camera is, and what it looks at.
        view: () => [...eye, ...target],
        place(view) {
            [eye, target] = [view.slice(0, 3), view.slice(3, 6)];
        },
        // Rotates by fractions of the image's height: in place inside a building, else around the
        // target.
        look(x, y) {
            const right = unit(cross(sub(target, eye), up)), from = inside ? eye : target;
            let arm = sub(inside ? target : eye, from);
            const steep = Math.asin(dot(unit(arm), up)), side = inside ? 1 : -1;
            const pitch = Math.max(-1.4, Math.min(1.4, steep + side * y * fov)) - steep;
            arm = turn(turn(arm, right, pitch * side), up, inside ? x * fov : -x * 3);
            if (inside)
                target = add(from, arm);
            else
                eye = add(from, arm);
        },
        // Moves toward the target.
        move(part) {
            const step = sub(target, eye).map((x) => x * Math.min(part, 0.5));
            eye = add(eye, step);
            if (inside)
                target = add(target, step);
        },
    };
}

// Returns the first light that a ray meets, of lights as the shaders read them, or -1. A finger is
// broad: `reach` times a light's radius counts.
export function pick(lights, { eye, along }, reach) {
    let best = -1, least = Infinity;
    for (let i = 0; 12 * i < lights.length; i++) {
        const to = sub([...lights.subarray(12 * i, 12 * i + 3)], eye), t = dot(to, along);
        const miss = Math.hypot(...add(to, along, -t));
        if (t > 0 && t < least && miss < reach * lights[12 * i + 3])
            [best, least] = [i, t];
    }
    return best;
}

// Returns the motion of a light that is dragged from one ray to another, in the plane that faces
// the camera.
export function dragged(light, from, to) {
    const depth = dot(sub([...light], from.eye), from.forward);
    const at = (ray) => ray.along.map((x) => x * depth / dot(ray.along, ray.forward));
    return sub(at(to), at(from));
}
