# SPDX-License-Identifier: MIT
"""lampion.sh against its definitions by quadrature in double."""
import math

import numpy as np

from lampion import Error, sh
from oracle import Case, harmonics, rotation_of, sphere_rule, unit_vectors

directions = unit_vectors(1, 30)
float32 = directions.astype(np.float32)
random = np.random.default_rng(2)
matrix, quaternion = rotation_of(unit_vectors(3, 1)[0], 1.1)


class Evaluation(Case):
    def test_counts(self):
        self.assertEqual([sh.count(5), sh.index(2, -1), sh.rotation_count(3)], [25, 5, 1 + 9 + 25])

    def test_eval(self):
        self.near(sh.eval(8, directions), harmonics(8, directions), 2e-6)
        self.near(sh.eval_double(8, directions), harmonics(8, directions), 1e-13)

    def test_gradient_and_hessian(self):
        y, gradient = sh.eval_gradient(5, directions)
        y_double, slope = sh.eval_gradient_double(5, directions)
        hessian = sh.eval_hessian_double(5, directions)
        step = 1e-5
        for axis in range(3):
            ends = [directions + sign * step * np.eye(3)[axis] for sign in (1, -1)]
            ends = [end / np.linalg.norm(end, axis=1, keepdims=True) for end in ends]
            expected = (harmonics(5, ends[0]) - harmonics(5, ends[1])) / (2 * step)
            self.near(gradient[:, axis], expected, 1e-5)
            self.near(slope[:, axis], expected, 1e-8)
        self.near(y, harmonics(5, directions), 2e-6)
        self.near(y_double, harmonics(5, directions), 1e-13)
        degree = np.floor(np.sqrt(np.arange(25)))
        trace = hessian[:, 0] + hessian[:, 3] + hessian[:, 5]
        self.near(trace, -degree * (degree + 1) * y_double, 1e-11)

    def test_sums(self):
        a, b = random.normal(size=(2, 4, 16))
        self.near(sh.dot(a, b), (a * b).sum(1), 1e-5)
        self.near(sh.combine(2, a, -3, b), 2 * a - 3 * b, 1e-5)
        self.near(sh.reconstruct(a[:, None], float32), a @ harmonics(4, directions).T, 1e-5)

    def test_zonal(self):
        zonal, axis = random.normal(size=6), directions[0]
        cosines = directions @ axis
        expected = sum(zonal[l] * math.sqrt((2 * l + 1) / (4 * math.pi))
                       * np.polynomial.legendre.Legendre.basis(l)(cosines) for l in range(6))
        found = sh.expand_zonal(zonal, axis)
        self.near(harmonics(6, directions) @ found, expected, 1e-5)


class Rotation(Case):
    def test_all_ways_to_rotate_agree_with_the_rotated_function(self):
        c = random.normal(size=(7, 25))
        expected = harmonics(5, directions @ matrix) @ c.T  # f(R⁻¹ w)
        for rotated in (sh.rotate(sh.make_rotation(5, quaternion), c),
                        sh.rotate(sh.make_rotation_from_matrix(5, matrix), c),
                        sh.rotate(sh.make_rotation(5, [quaternion]), c),
                        sh.rotate_by_matrix(matrix, c)):
            self.near(harmonics(5, directions) @ rotated.T, expected, 2e-5)
        rotated = sh.rotate_double(sh.make_rotation_double(5, quaternion), c)
        self.near(harmonics(5, directions) @ rotated.T, expected, 1e-12)

    def test_around_z(self):
        c = random.normal(size=16)
        matrix, _ = rotation_of([0, 0, 1], 0.7)
        self.near(harmonics(4, directions) @ sh.rotate_z(0.7, c), harmonics(4, directions @ matrix)
                  @ c, 1e-5)


class Windows(Case):
    def test_weights(self):
        l = np.arange(10)
        self.near(sh.make_window(10, "hanning"), (1 + np.cos(np.pi * l / 10)) / 2, 1e-6)
        self.near(sh.make_window(10, "LANCZOS", 12), np.sinc(l / 12), 1e-6)
        self.same(sh.make_window(3, sh.Window.NONE), np.ones(3, np.float32))
        self.assertEqual(sh.window_name("lanczos"), "lanczos")

    def test_laplacian(self):
        c = random.normal(size=36)
        weights = sh.make_laplacian_window(0.25, c)
        l = np.arange(6)
        mu = (1 / weights[1] - 1) / 4
        self.near(weights, 1 / (1 + mu * (l * (l + 1)) ** 2), 1e-5)
        degree = np.floor(np.sqrt(np.arange(36)))
        energy = lambda c: np.sum((degree * (degree + 1) * c) ** 2)
        windowed = sh.apply_window(weights, c)
        self.near(energy(windowed) / energy(c), 0.25, 1e-4)
        self.near(windowed, weights[degree.astype(int)] * c, 1e-6)


class Projection(Case):
    def test_functions(self):
        nodes, weights = sphere_rule(24)
        function = lambda v: math.exp(v[0]) + v[1] * v[2]
        expected = (weights * [function(v) for v in nodes]) @ harmonics(5, nodes)
        self.near(sh.project_function(5, function, 24), expected, 1e-5)
        color = sh.project_function(5, lambda v: (function(v), 1, v[2]), 24)
        self.near(color[0], expected, 1e-5)
        self.near(color[2], [0, 0, math.sqrt(4 * math.pi / 3)] + [0] * 22, 1e-5)

    def test_an_exception_of_the_function_is_passed_on(self):
        calls = []

        def function(direction):
            calls.append(direction)
            if len(calls) > 3:
                raise KeyError("mine")
            return 1

        self.refused("mine", sh.project_function, 3, function, kind=KeyError)
        self.assertEqual(len(calls), 4)

    def test_images(self):
        height = 64
        theta = (np.arange(height) + 0.5) * math.pi / height
        phi = ((np.arange(2 * height) + 0.5) / (2 * height) - 0.5) * 2 * math.pi
        up, around = np.meshgrid(theta, phi, indexing="ij")
        x, y, z = np.sin(up) * np.cos(around), np.cos(up), np.sin(up) * np.sin(around)
        image = np.stack([x, y, z], -1)
        size = math.sqrt(4 * math.pi / 3)
        expected = np.zeros((3, 9))
        expected[0, 3], expected[1, 1], expected[2, 2] = -size, -size, size
        self.near(sh.project_latlong(3, image), expected, 4e-3)
        for other in (image.astype(np.float32)[::-1][::-1], np.asfortranarray(image, np.float32),
                      np.repeat(image, 2, 2).astype(np.float32)[..., ::2]):
            self.near(sh.project_latlong(3, other), expected, 4e-3)
        self.near(sh.project_latlong(3, image[..., 1]), expected[1], 4e-3)
        self.near(sh.project_latlong(3, image.astype(np.float16)), expected, 6e-3)
        self.near(sh.project_latlong(3, image[:, ::-1], mirrored=True), expected, 4e-3)

    def test_cube_maps(self):
        at = (np.arange(32) + 0.5) / 16 - 1
        column, row = np.meshgrid(at, at)
        one = np.ones_like(row)
        faces = np.array([(one, -row, -column), (-one, -row, column), (column, one, row),
                          (column, -one, -row), (column, -row, one), (-column, -row, -one)])
        faces /= np.linalg.norm(faces, axis=1, keepdims=True)
        found = sh.project_cubemap(3, np.moveaxis(faces, 1, -1))
        size = math.sqrt(4 * math.pi / 3)
        self.near([found[0, 3], found[1, 1], found[2, 2]], [-size, -size, size], 4e-3)
        self.near(sh.project_cubemap(3, faces[:, 2]), found[2], 1e-6)


class Products(Case):
    def test_against_quadrature(self):
        nodes, weights = sphere_rule(20)
        y = harmonics(5, nodes)
        a, b = random.normal(size=(2, 3, 25))
        expected = np.einsum("w,aw,aw,wk->ak", weights, a @ y.T, b @ y.T, y)
        self.near(sh.multiply_few(a, b), expected, 2e-5)
        self.near(sh.Product(5).multiply(a, b), expected, 2e-5)


class Halves(Case):
    def test_as_numpy_rounds(self):
        values = np.r_[random.normal(size=500) * 10.0 ** random.integers(-9, 6, 500), 0, -0.0,
                       65519, 65520, 1e30, 2.0**-24, 2.0**-25, np.inf].astype(np.float32)
        with np.errstate(over="ignore"):
            expected = values.astype(np.float16)
        self.same(sh.pack_half(values), expected)
        self.same(sh.unpack_half(expected), expected.astype(np.float32))
        self.same(sh.unpack_half(expected.view(np.uint16)), expected.astype(np.float32))
        self.assertTrue(np.isnan(sh.pack_half([np.nan])[0]))


class Errors(Case):
    def test_what_the_library_says(self):
        from lampion import brdf
        with self.assertRaises(Error) as caught:
            brdf.read_merl(b"no such file")
        self.assertEqual(caught.exception.result, "format")
        self.assertIsNotNone(caught.exception.offset)
