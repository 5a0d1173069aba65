# SPDX-License-Identifier: MIT
"""What NumPy's users expect of arrays: any strides, slices and types, broadcasting, out=, no
elements; and that float32 is not copied."""
import tracemalloc

import numpy as np

from lampion import field, light, lobe, probe, sh, shade, material, sphere
from oracle import Case, unit_vectors

points = np.random.default_rng(1).normal(size=(24, 3)).astype(np.float32)
ways = unit_vectors(2, 24).astype(np.float32)
color = [1, 2, 3]


def layouts(array):
    """The same values in other layouts and types."""
    padded = np.full(array.shape[:-1] + (7,), np.nan, np.float32)
    padded[..., 2:5] = array
    unaligned = np.empty(array.nbytes + 1, np.uint8)[1:].view(np.float32).reshape(array.shape)
    unaligned[...] = array
    record = np.zeros(len(array), [("tag", "i1"), ("at", "f4", 3)])
    record["at"] = array
    frozen = array.copy()
    frozen.flags.writeable = False
    return {"slice": padded[..., 2:5], "planes": np.asfortranarray(array),
            "every other": np.repeat(array, 2, 0)[::2], "backward": array[::-1].copy()[::-1],
            "components backward": array[:, ::-1].copy()[:, ::-1], "unaligned": unaligned,
            "record": record["at"], "read-only": frozen, "double": array.astype(float),
            "big-endian": array.astype(">f4"), "list": array.tolist(),
            "two axes": array.reshape(4, 6, 3).transpose(1, 0, 2).copy().transpose(1, 0, 2)}


class Inputs(Case):
    def test_layouts_of_points(self):
        lights = light.sphere([[0, 3, 0], [1, 2, 3]], 0.5, color)
        grid = field.Field(3, nodes=(4, 4, 4), origin=(-3, -3, -3), cell=(2, 2, 2))
        grid.update(lights)
        stuff = material.lobes(0.5, 0.5, 20)
        functions = {
            "project": lambda p, w: sphere.project(4, [0, 0, 9], 2, p),
            "gradient": lambda p, w: sphere.project_gradient(4, [0, 0, 9], 2, p)[1],
            "sum": lambda p, w: sphere.sum(4, [[0, 0, 9]], 2, color, p),
            "all": lambda p, w: sphere.project_all(4, [[0, 0, 9], [1, 2, 3]], 0.1, p),
            "lights": lambda p, w: light.project(4, lights, p),
            "irradiance": lambda p, w: light.irradiance(lights, p, w),
            "eval": lambda p, w: sh.eval(4, w),
            "response": lambda p, w: lobe.response(lobe.make_diffuse(4), w, lights, p),
            "probe": lambda p, w: probe.irradiance(np.ones((3, 9)), w),
            "shade": lambda p, w: shade.shade(stuff, p, w, w, lights),
            "field": lambda p, w: grid.eval(p),
            "field lobe": lambda p, w: grid.eval_lobe(np.ones(3), w, p),
            "field shade": lambda p, w: grid.shade(stuff, p, w, w)}
        for name, function in functions.items():
            expected = function(points, ways)
            for (layout, p), w in zip(layouts(points).items(), layouts(ways).values()):
                with self.subTest(function=name, layout=layout):
                    found = function(p, w)
                    self.same(found.reshape(expected.shape), expected)

    def test_layouts_of_coefficients(self):
        c = np.random.default_rng(3).normal(size=(24, 9)).astype(np.float32)
        m = sh.make_rotation(3, [0.1, 0.2, 0.3, 0.9])
        for layout in (np.asfortranarray(c), np.repeat(c, 3, 1)[:, ::3], c[::-1].copy()[::-1],
                       c.astype(">f4"), c.astype(float), c.tolist()):
            self.same(sh.rotate(m, layout), sh.rotate(m, c))
            self.same(sh.dot(layout, c), sh.dot(c, c))
            self.same(sh.rotate_z(0.3, layout), sh.rotate_z(0.3, c))
            self.same(sh.reconstruct(layout, ways), sh.reconstruct(c, ways))

    def test_broadcasting(self):
        radii = np.float32([0.1, 0.2, 0.3, 0.4])
        found = sphere.project(3, [0, 0, 9], radii[:, None], points)
        self.assertEqual(found.shape, (4, 24, 9))
        for i, radius in enumerate(radii):
            self.same(found[i], sphere.project(3, [0, 0, 9], radius, points))
        self.assertEqual(sphere.project(3, [0, 0, 9], 1, [0, 0, 0]).shape, (9,))
        self.assertEqual(sh.dot(np.ones((5, 1, 4)), np.ones((3, 4))).shape, (5, 3))
        self.assertEqual(sh.expand_zonal(np.ones((2, 1, 3)), ways).shape, (2, 24, 9))
        self.refused("broadcast", sphere.project, 3, points[:5], 1, points)
        self.refused("broadcast", sh.expand_zonal, np.ones((2, 3)), ways)

    def test_no_elements(self):
        none = np.empty((0, 3), np.float32)
        self.assertEqual(sphere.project(3, [0, 0, 9], 1, none).shape, (0, 9))
        self.assertEqual(sphere.project_zonal(3, np.empty(0), 1).shape, (0, 3))
        self.assertEqual(sh.eval(3, none).shape, (0, 9))
        self.assertEqual(sh.eval_double(3, none).shape, (0, 9))
        self.assertEqual(sh.dot(np.empty((0, 9)), np.ones(9)).shape, (0,))
        self.assertEqual(light.irradiance([], none, none).shape, (0, 3))
        self.same(light.project(2, [], [0, 0, 0]), np.zeros((3, 4), np.float32))
        self.assertEqual(sphere.project_all(2, none, np.empty(0), points).shape, (24, 0, 4))
        self.assertEqual(sh.eval(3, np.empty((2, 0, 3))).shape, (2, 0, 9))
        self.assertEqual(sh.pack_half([]).shape, (0,))

    def test_of_nan_comes_nan(self):
        found = sphere.project(3, [0, 0, 9], 1, [[np.nan, 0, 0], [0, 0, 0]])
        self.assertTrue(np.isnan(found[0]).any())
        self.assertTrue(np.isfinite(found[1]).all())


class Outputs(Case):
    def test_layouts_of_results(self):
        expected = sphere.project(3, [0, 0, 9], 1, points)
        wide = np.full((24, 20), -7, np.float32)
        planar = np.full((9, 30), -7, np.float32)
        for out in (np.empty((24, 9), np.float32), np.empty((9, 24), np.float32).T,
                    wide[:, 4:13], planar.T[:24], wide[::-1, 4:13], wide[:, 4:13][:, ::-1],
                    np.empty((24, 18), np.float32)[:, ::2]):
            self.assertIs(sphere.project(3, [0, 0, 9], 1, points, out=out), out)
            self.same(np.array(out), expected)
        self.assertTrue((wide[:, :4] == -7).all() and (wide[:, 13:] == -7).all())
        self.assertTrue((planar[:, 24:] == -7).all())

    def test_layouts_of_colors(self):
        lights = light.sphere([0, 3, 0], 0.5, color)
        factors = lobe.make_diffuse(3)
        expected = lobe.response(factors, ways, lights, points)
        image = np.full((24, 4), -7, np.float32)
        for out in (image[:, :3], image[::-1, :3], image[:, 2::-1],
                    np.empty((3, 24), np.float32).T):
            self.same(np.array(lobe.response(factors, ways, lights, points, out=out)), expected)
        self.assertTrue((image[:, 3] == -7).all())

    def test_planes_of_three_channels(self):
        lights = light.sphere([0, 3, 0], 0.5, color)
        expected = light.project(3, lights, points)
        out = np.empty((3, 9, 24), np.float32).transpose(2, 0, 1)
        self.same(np.array(light.project(3, lights, points, out=out)), expected)
        out = np.empty((9, 3, 24), np.float32).transpose(2, 1, 0)
        self.same(np.array(light.project(3, lights, points, out=out)), expected)

    def test_overlap(self):
        # what is written for one element would be read as the next one's direction
        many = unit_vectors(3, 2000).astype(np.float32)
        memory = np.empty((2001, 9), np.float32)
        memory[:2000, :3] = many
        expected = sh.eval(3, many)
        self.same(sh.eval(3, memory[:2000, :3], out=memory[1:]), expected)
        c = expected.copy()
        m = sh.make_rotation(3, [0.1, 0.2, 0.3, 0.9])
        self.same(sh.rotate(m, c, out=c), sh.rotate(m, expected))
        c = expected.copy()
        self.same(sh.combine(2, c, 1, c[::-1], out=c[::-1]),
                  np.float32(2) * expected + expected[::-1])

    def test_what_is_not_an_output(self):
        frozen = np.empty((24, 9), np.float32)
        frozen.flags.writeable = False
        for words, out in (("read-only", frozen), ("float32", np.empty((24, 9))),
                           ("shape", np.empty((23, 9), np.float32)), ("array", [[0] * 9] * 24),
                           ("shape", np.empty(216, np.float32))):
            self.refused(words, sh.eval, 3, ways, out=out)
        self.refused("read-only", light.add, 3, [], points, np.broadcast_to(
            np.float32(0), (24, 3, 9)))

    def test_add(self):
        lights = light.sphere([[0, 3, 0], [2, 2, 2]], 0.5, color)
        for coefficients in (np.zeros((24, 3, 9), np.float32),
                             np.zeros((9, 3, 24), np.float32).transpose(2, 1, 0)):
            for one in lights:
                self.assertIs(light.add(3, one, points, coefficients), coefficients)
            self.near(coefficients, light.project(3, lights, points), 1e-6)


class Copies(Case):
    def test_float32_is_not_copied(self):
        many = np.zeros((100000, 6), np.float32)
        many[:, 2] = 1
        slices = many[:, :3], many[:, ::2], many[::2, 1:4], many.reshape(1000, 100, 6)[..., :3]
        for places in slices:
            out = np.empty(places.shape[:-1] + (4,), np.float32)
            sphere.project(2, [0, 0, 9], 1, places, out=out)
            tracemalloc.start()
            sphere.project(2, [0, 0, 9], 1, places, out=out)
            _, peak = tracemalloc.get_traced_memory()
            tracemalloc.stop()
            self.assertLess(peak, 20000)
