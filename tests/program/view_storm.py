# SPDX-License-Identifier: MIT
"""view_storm.py NAME SECONDS SEED CORPUS: changes the scene NAME of a viewer that watches it, for so long: good scenes
whose materials come and go, malformed ones, none, a pipe, a folder, a file that grows; its buffer likewise. Between
changes keys are pressed, F5 above all. Ends with a good scene, and prints what it tried."""
import json, os, random, shutil, struct, subprocess, sys, time

name, seconds, seed, corpus = sys.argv[1], float(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
kind = os.path.splitext(name)[1][1:]
draw = random.Random(seed)
tried = {}

MATERIALS = [
    {},
    {"KHR_materials_sheen": {"sheenColorFactor": [0.8, 0.4, 0.2], "sheenRoughnessFactor": 0.5}},
    {"KHR_materials_clearcoat": {"clearcoatFactor": 0.9, "clearcoatRoughnessFactor": 0.1}},
    {"KHR_materials_sheen": {"sheenColorFactor": [0.2, 0.4, 0.9], "sheenRoughnessFactor": 0.2},
     "KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.4}},
    {"KHR_materials_unlit": {}},
]


def grid(side):
    points = [(x / side - 0.5, 0.2 * draw.random(), y / side - 0.5) for y in range(side + 1) for x in range(side + 1)]
    corner = lambda x, y: y * (side + 1) + x
    faces = [(corner(x, y), corner(x, y + 1), corner(x + 1, y)) for y in range(side) for x in range(side)]
    faces += [(corner(x + 1, y), corner(x, y + 1), corner(x + 1, y + 1)) for y in range(side) for x in range(side)]
    return points, faces


def gltf(external):
    points, faces = grid(draw.choice([1, 2, 7]))
    indices = b"".join(struct.pack("<3H", *face) for face in faces)
    data = b"".join(struct.pack("<3f", *point) for point in points) + indices
    extensions = draw.choice(MATERIALS)
    materials = [{"name": draw.choice("ab"), "extensions": extensions, "pbrMetallicRoughness": {
        "baseColorFactor": [0.8, 0.6, 0.4, 1], "metallicFactor": draw.choice([0, 1]), "roughnessFactor": draw.random()}}]
    used = sorted(extensions)
    root = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "materials": materials,
        "buffers": [{"byteLength": len(data)}],
        "bufferViews": [{"buffer": 0, "byteLength": 12 * len(points)},
                        {"buffer": 0, "byteOffset": 12 * len(points), "byteLength": len(indices)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3",
                       "min": [-1, -1, -1], "max": [1, 1, 1]},
                      {"bufferView": 1, "componentType": 5123, "count": 3 * len(faces), "type": "SCALAR"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "nodes": [{"mesh": 0}]}
    if draw.random() < 0.5:
        used.append("KHR_lights_punctual")
        root["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 40}]}}
        root["nodes"].append({"translation": [0, 1, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}})
        root["scenes"][0]["nodes"].append(1)
    root["extensionsUsed"] = used
    if not used:
        del root["extensionsUsed"]
    if external:
        root["buffers"][0]["uri"] = "scene.bin"
    return root, data


def good():
    """The bytes of a scene, and of its buffer or None."""
    if kind == "gltf":
        root, data = gltf(True)
        return json.dumps(root).encode(), data
    if kind == "glb":
        root, data = gltf(False)
        text = json.dumps(root).encode()
        text += b" " * (-len(text) % 4)
        data += b"\0" * (-len(data) % 4)
        return (struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)) + struct.pack("<I4s", len(text), b"JSON") +
                text + struct.pack("<I4s", len(data), b"BIN\0") + data), None
    points, faces = grid(draw.choice([1, 2, 7]))
    if kind == "obj":
        lines = ["v %g %g %g" % point for point in points] + ["usemtl " + draw.choice("ab")]
        lines += ["f %d %d %d" % tuple(i + 1 for i in face) for face in faces]
    else:
        lines = ["ply", "format ascii 1.0", "element vertex %d" % len(points)]
        lines += ["property float " + axis for axis in "xyz"] + ["element face %d" % len(faces)]
        lines += ["property list uchar int vertex_indices", "end_header"]
        lines += ["%g %g %g" % point for point in points] + ["3 %d %d %d" % face for face in faces]
    return ("\n".join(lines) + "\n").encode(), None


def malformed(data):
    seeds = os.path.join(corpus, "gltf" if kind == "glb" else kind)
    choice = draw.randrange(5)
    if choice == 0 and os.path.isdir(seeds):
        with open(os.path.join(seeds, draw.choice(sorted(os.listdir(seeds)))), "rb") as file:
            return file.read()
    if choice == 1:
        return data[:draw.randrange(len(data) + 1)]
    if choice == 2:
        return data + data[draw.randrange(len(data)):]
    broken = bytearray(data)
    for _ in range(draw.choice([1, 3, 20])):
        broken[draw.randrange(len(broken))] = draw.randrange(256)
    return bytes(broken)


def clear(path):
    if os.path.isdir(path) and not os.path.islink(path):
        shutil.rmtree(path)
    elif os.path.lexists(path):
        os.unlink(path)


def put(path, data, pieces=1):
    if os.path.isdir(path) or (os.path.exists(path) and not os.path.isfile(path)):
        clear(path)
    with open(path, "wb", buffering=0) as file:
        for i in range(pieces):
            file.write(data[len(data) * i // pieces:len(data) * (i + 1) // pieces])
            if pieces > 1:
                press("F5") if draw.random() < 0.3 else time.sleep(0.05)


def replace(path, data):
    clear(path + "~")
    put(path + "~", data)
    if os.path.isdir(path):
        clear(path)
    os.rename(path + "~", path)


def press(key):
    tried[key] = tried.get(key, 0) + 1
    subprocess.run(["xdotool", "key", key], check=False)


def good_scene():
    scene, buffer = good()
    if buffer is not None:
        put("scene.bin", buffer)
    draw.choice([put, replace])(name, scene)


def change(what):
    path = "scene.bin" if kind == "gltf" and draw.random() < 0.3 else name
    scene, buffer = good()
    data = buffer if path == "scene.bin" else scene
    if what == "good":
        good_scene()
    elif what == "malformed":
        draw.choice([put, replace])(path, malformed(data))
    elif what == "vanishing":
        clear(path)
    elif what == "pipe":
        clear(path)
        os.mkfifo(path)
    elif what == "folder":
        clear(path)
        os.mkdir(path)
    elif what == "growing":
        put(path, data, pieces=draw.randrange(2, 9))


end = time.monotonic() + seconds
while time.monotonic() < end:
    what = draw.choice(["good", "good", "malformed", "malformed", "vanishing", "pipe", "folder", "growing"])
    tried[what] = tried.get(what, 0) + 1
    change(what)
    if draw.random() < 0.8:
        press("F5")
    if draw.random() < 0.2:
        press(draw.choice(["m", "Up", "Down", "z", "v", "x", "t", "n", "f", "space", "Ctrl+z"]))
    if draw.random() < 0.01:
        press("shift+F5")
    time.sleep(draw.choice([0, 0.05, 0.3, 1.2 if draw.random() < 0.2 else 0.1]))
good_scene()
for what in sorted(tried):
    print("tried: %d times %s of %s" % (tried[what], what, kind))
