# SPDX-License-Identifier: MIT
# blender --background --factory-startup --python cycles.py -- FOLDER SEEDS NAME MATERIALS CAMERA LIGHTS BOUNCES …: for
# each five words, what FOLDER/NAME.obj shows under the lights of FOLDER/LIGHTS.json by Blender's Cycles, after so many
# bounces, as NAME-1.exr to NAME-SEEDS.exr. MATERIALS are one or more NAME=lambert:COLOR, NAME=ggx:ROUGHNESS, which is
# white, or NAME=glow:RADIANCE, joined by +; CAMERA is orthographic:HEIGHT, which looks down the z axis, or
# perspective:X,Y,Z, which looks to the origin.
import json
import math
import sys

import bmesh
import bpy
from mathutils import Matrix, Vector

WIDTH, HEIGHT, SAMPLES = 48, 36, 256


def add(name, data):
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def add_mesh(vertices, faces, material):
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(vertices, [], faces)
    mesh.materials.append(material)
    return add("mesh", mesh)


def read_obj(path):
    """The vertices, and by their materials the faces."""
    vertices, faces, used = [], {}, None
    for line in open(path):
        kind, *words = line.split() or [""]
        if kind == "v":
            vertices.append(tuple(map(float, words)))
        elif kind == "usemtl":
            used = faces.setdefault(words[0], [])
        elif kind == "f":
            used.append([int(corner.split("/")[0]) - 1 for corner in words])
    return vertices, faces


# Triangles have the same surface as a sphere, and so cover the same in the mean.
def add_sphere(center, radius, material):
    shape = bmesh.new()
    bmesh.ops.create_icosphere(shape, subdivisions=6, radius=1)
    scale = radius * math.sqrt(4 * math.pi / sum(face.calc_area() for face in shape.faces))
    mesh = bpy.data.meshes.new("sphere")
    shape.to_mesh(mesh)
    mesh.materials.append(material)
    ball = add("sphere", mesh)
    ball.location, ball.scale, ball.visible_camera = center, [scale] * 3, False


def add_area(corners, radiance):
    add_mesh(corners, [list(range(len(corners)))], glow(radiance)).visible_camera = False


def corners_of(light):
    center = Vector(light["position"])
    if light["kind"] == "rectangle":
        u, v = Vector(light["half_width"]), Vector(light["half_height"])
        return [center - u - v, center + u - v, center + u + v, center - u + v]
    count = 400
    normal = Vector(light["direction"]).normalized()
    u = normal.orthogonal().normalized()
    v = normal.cross(u)
    radius = light["radius"] * math.sqrt(2 * math.pi / count / math.sin(2 * math.pi / count))  # the same area
    turns = [2 * math.pi * k / count for k in range(count)]
    return [center + radius * (math.cos(turn) * u + math.sin(turn) * v) for turn in turns]


def add_light(light):
    if light.get("kind", "sphere") != "sphere":
        add_area(corners_of(light), light["radiance"])
        return
    material = glow(light["radiance"])
    material.cycles.sample_as_light = False  # of many triangles Cycles chooses some too rarely, and loses up to a percent
    add_sphere(light["position"], light["radius"], material)


def emission(radiance):
    return shader("ShaderNodeEmission", Color=[*radiance, 1], Strength=1)


# A light glows on the side from which its corners are counter-clockwise, and hides nothing.
def glow(radiance):
    material = emission(radiance)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    front, both = nodes.new("ShaderNodeMath"), nodes.new("ShaderNodeAddShader")
    front.operation, front.inputs[0].default_value = "SUBTRACT", 1
    links.new(nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], front.inputs[1])
    links.new(front.outputs[0], nodes["Emission"].inputs["Strength"])
    links.new(nodes["Emission"].outputs[0], both.inputs[0])
    links.new(nodes.new("ShaderNodeBsdfTransparent").outputs[0], both.inputs[1])
    links.new(both.outputs[0], nodes["Material Output"].inputs[0])
    return material


def shader(kind, **inputs):
    material = bpy.data.materials.new(kind)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    node = nodes.new(kind)
    for key, value in inputs.items():
        node.inputs[key].default_value = value
    material.node_tree.links.new(node.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs[0])
    if kind == "ShaderNodeBsdfGlossy":
        node.distribution = "GGX"
    return material


def surface(text):
    kind, value = text.split(":")
    numbers = list(map(float, value.split(",")))
    if kind == "lambert":
        return shader("ShaderNodeBsdfDiffuse", Color=[*(numbers * 3)[:3], 1], Roughness=0)
    if kind == "glow":
        return emission(numbers)
    return shader("ShaderNodeBsdfGlossy", Color=[1, 1, 1, 1], Roughness=numbers[0])


def add_camera(text):
    kind, value = text.split(":")
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    camera = add("camera", data)
    if kind == "orthographic":
        data.type, data.ortho_scale, camera.location = "ORTHO", float(value), (0, 0, 9)
    else:
        data.angle_y = math.radians(45)
        eye = Vector(map(float, value.split(",")))
        right = Vector((0, 1, 0)).cross(eye).normalized()
        axes = [right, eye.cross(right).normalized(), eye.normalized(), eye]
        camera.matrix_world = Matrix([[axis[k] for axis in axes] for k in range(3)] + [[0, 0, 0, 1]])
    bpy.context.scene.camera = camera


def set_up(scene, bounces):
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = WIDTH, HEIGHT, 100
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    cycles = scene.cycles
    cycles.samples, cycles.max_bounces, cycles.diffuse_bounces = SAMPLES, bounces, bounces
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = cycles.light_sampling_threshold = 0
    cycles.pixel_filter_type, cycles.filter_width = "GAUSSIAN", 0.01  # the center of a pixel, as `reference` takes it


def render(folder, seeds, name, materials, camera, lights, bounces):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    vertices, faces = read_obj(f"{folder}/{name}.obj")
    for word in materials.split("+"):
        part, text = word.split("=")
        add_mesh(vertices, faces[part], surface(text))
    for light in json.load(open(f"{folder}/{lights}.json"))["lights"]:
        add_light(light)
    add_camera(camera)
    set_up(scene, int(bounces))
    for seed in range(1, seeds + 1):
        scene.cycles.seed, scene.render.filepath = seed, f"{folder}/{name}-{seed}.exr"
        bpy.ops.render.render(write_still=True)


folder, seeds, *cases = sys.argv[sys.argv.index("--") + 1:]
while cases:
    render(folder, int(seeds), *cases[:5])
    cases = cases[5:]
