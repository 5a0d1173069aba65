# SPDX-License-Identifier: MIT
# blender --background --factory-startup --python cycles.py -- FOLDER SEEDS NAME MATERIAL CAMERA …: for each three words,
# what FOLDER/NAME.obj shows under FOLDER/lights.json by Blender's Cycles, direct light alone, as NAME-1.exr to
# NAME-SEEDS.exr. MATERIAL is lambert:COLOR or ggx:ROUGHNESS, white; CAMERA is orthographic:HEIGHT, which looks down the
# z axis, or perspective:X,Y,Z, which looks to the origin.
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
    add("mesh", mesh)


def read_obj(path):
    words = [line.split() for line in open(path) if line.strip()]
    vertices = [tuple(map(float, w[1:4])) for w in words if w[0] == "v"]
    return vertices, [[int(corner.split("/")[0]) - 1 for corner in w[1:]] for w in words if w[0] == "f"]


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
    if kind == "lambert":
        return shader("ShaderNodeBsdfDiffuse", Color=[float(value)] * 3 + [1], Roughness=0)
    return shader("ShaderNodeBsdfGlossy", Color=[1, 1, 1, 1], Roughness=float(value))


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


def set_up(scene):
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = WIDTH, HEIGHT, 100
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    cycles = scene.cycles
    cycles.samples, cycles.max_bounces = SAMPLES, 0
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.blur_glossy = cycles.light_sampling_threshold = 0
    cycles.pixel_filter_type, cycles.filter_width = "GAUSSIAN", 0.01  # the center of a pixel, as `reference` takes it


def render(folder, seeds, name, material, camera):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    add_mesh(*read_obj(f"{folder}/{name}.obj"), surface(material))
    for light in json.load(open(f"{folder}/lights.json"))["lights"]:
        glow = shader("ShaderNodeEmission", Color=[*light["radiance"], 1], Strength=1)
        glow.cycles.sample_as_light = False  # of many triangles Cycles chooses some too rarely, and loses up to a percent
        add_sphere(light["position"], light["radius"], glow)
    add_camera(camera)
    set_up(scene)
    for seed in range(1, seeds + 1):
        scene.cycles.seed, scene.render.filepath = seed, f"{folder}/{name}-{seed}.exr"
        bpy.ops.render.render(write_still=True)


folder, seeds, *cases = sys.argv[sys.argv.index("--") + 1:]
while cases:
    render(folder, int(seeds), *cases[:3])
    cases = cases[3:]
