# SPDX-License-Identifier: MIT
"""lampion.sphere, light, lobe and probe against quadrature of caps and closed forms."""
import io
import math

import numpy as np

from lampion import cpu, light, lobe, probe, sh, sphere
from oracle import (Case, cap_of, cap_rule, harmonics, sphere_coefficients, sphere_rule,
                    unit_vectors)

center, radius, color = np.array([1.0, 2.0, 0.5]), 0.7, np.array([1.0, 2.0, 3.0])
points = np.random.default_rng(1).normal(size=(6, 3)) - [0, 2, 0]
expected = np.array([sphere_coefficients(5, center, radius, point) for point in points])
normals = unit_vectors(4, 6)
one = light.sphere(center, radius, color)


def slope(function, at, step=1e-3):
    """The derivatives (…, 3, n²) of a function of points, by differences."""
    ends = [[function(at + sign * step * np.eye(3)[axis]) for sign in (1, -1)] for axis in range(3)]
    return np.stack([(up - down) / (2 * step) for up, down in ends], -2)


class Spheres(Case):
    def test_projections(self):
        self.near(sphere.project(5, center, radius, points), expected, 1e-6)
        self.near(sphere.project_double(5, center, radius, points), expected, 1e-12)
        distance = np.linalg.norm(points - center, axis=1)
        zonal = sphere.project_zonal(5, radius, distance)
        self.near(np.linalg.norm(zonal, axis=1), np.linalg.norm(expected, axis=1), 1e-6)
        for z, point, sh_ in zip(zonal, points, expected):
            self.near(sh.expand_zonal(z, cap_of(center, radius, point)[0]), sh_, 1e-6)

    def test_inside_it_is_a_full_sphere_at_the_center(self):
        self.near(sphere.project(3, center, radius, center), [math.sqrt(4 * math.pi)] + [0] * 8,
                  1e-6)

    def test_all_and_sum(self):
        centers, radii = np.array([center, [-1, 3, 0]]), np.array([radius, 0.2])
        colors = np.array([color, [5, 0, 1]])
        other = np.array([sphere_coefficients(5, centers[1], 0.2, point) for point in points])
        both = np.stack([expected, other], 1)
        self.near(sphere.project_all(5, centers, radii, points), both, 1e-6)
        self.near(sphere.sum(5, centers, radii, colors, points),
                  np.einsum("psk,sc->pck", both, colors), 4e-6)
        visibility = np.random.default_rng(5).uniform(size=(2, 6))
        self.near(sphere.sum(5, centers, radii, colors, points, visibility=visibility),
                  np.einsum("psk,sc,sp->pck", both, colors, visibility), 4e-6)

    def test_gradients(self):
        exact = slope(lambda p: sphere.project_double(5, center, radius, p), points)
        found, gradient = sphere.project_gradient(5, center, radius, points)
        self.near(found, expected, 1e-6)
        self.near(gradient, exact, 2e-6)
        total, gradients = sphere.sum_gradient(5, [center], radius, color, points)
        self.near(total, expected[:, None] * color[:, None], 4e-6)
        self.near(gradients, exact[:, :, None] * color[:, None], 6e-6)
        self.near(light.project_gradient(5, one, points)[1], exact, 2e-6)

    def test_units(self):
        self.near(sphere.power_from_radiance(2, 3), 4 * math.pi**2 * 9 * 2, 1e-3)
        self.near(sphere.intensity_from_radiance([2, 4], 3), [math.pi * 18, math.pi * 36], 1e-4)
        self.near(sphere.radiance_from_power(sphere.power_from_radiance(2, 3), 3), 2, 1e-6)
        self.near(sphere.radiance_from_intensity(sphere.intensity_from_radiance(2, 3), 3), 2, 1e-6)


class Lights(Case):
    def test_spheres_as_lights(self):
        self.same(light.sphere(center, radius, 2)["radiance"], np.full(3, 2, np.float32))
        self.near(light.project(5, one, points), expected[:, None] * color[:, None], 4e-6)
        zonal, axis = light.project_zonal(5, one, points)
        self.near(sh.expand_zonal(zonal, axis), expected, 1e-6)
        cap = light.find_cap(one, points)
        distance = np.linalg.norm(points - center, axis=1)
        self.near(cap["sin2"], radius**2 / distance**2, 1e-6)
        self.near(cap["axis"], (center - points) / distance[:, None], 1e-6)
        self.near(cap["strength"], math.pi * color * cap["sin2"][:, None], 1e-5)

    def test_visibility(self):
        lights = light.sphere([center, center], [radius, radius], color)
        visibility = np.zeros((2, 6))
        visibility[1] = np.arange(6) / 5
        self.near(light.project(5, lights, points, visibility=visibility),
                  expected[:, None] * color[:, None] * visibility[1][:, None, None], 4e-6)
        self.near(light.project(5, lights, points, visibility=0.25),
                  expected[:, None] * color[:, None] / 2, 4e-6)

    def test_every_kind(self):
        up = [0, 1, 0]
        sun = light.project(4, light.cap(up, 0.3, [1, 1, 1]), [9, 9, 9])
        ways, weights = cap_rule(np.array(up, float), 1 - math.cos(0.3))
        self.near(sun[0], weights @ harmonics(4, ways), 1e-6)
        y = harmonics(4, np.array(up, float))
        self.near(light.project(4, light.directional(up, [2, 1, 1]), points[0])[0], 2 * y, 1e-6)
        self.near(light.project(4, light.point([0, 3, 0], [9, 1, 1]), [0, 0, 0])[0], y, 1e-6)
        spot = light.spot([0, 3, 0], [0, -1, 0], 0.2, 0.6, [9, 1, 1])
        self.near(light.project(4, spot, [0, 0, 0])[0], y, 1e-6)
        self.near(light.project(4, spot, [5, 0, 0]), 0, 0)
        sky = light.project(4, light.hemisphere(up, [1, 1, 1], [0.5, 0, 0]), [0, 0, 0])
        ways, weights = cap_rule(np.array(up, float), 1)
        ground, below = cap_rule(-np.array(up, float), 1)
        self.near(sky[0], weights @ harmonics(4, ways) + below / 2 @ harmonics(4, ground), 1e-6)

    def test_areas(self):
        # a grid of points on the area, each with its solid angle
        u = (np.arange(200) + 0.5) / 100 - 1
        a, b = np.meshgrid(u, u)
        plate = np.stack([a, 0 * a + 2, b], -1).reshape(-1, 3)
        distance = np.linalg.norm(plate, axis=1)
        weights = 1e-4 * 2 / distance**3
        exact = weights @ harmonics(4, plate / distance[:, None])
        corners = [[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]]
        square = light.rectangle([0, 2, 0], [[1, 0, 0], [0, 0, 1]], [1, 1, 1])
        for area in (square, light.polygon([0, 2, 0], corners, [1, 1, 1])):
            self.near(light.project(4, area, [0, 0, 0])[0], exact, 2e-4)
        self.near(light.project(4, light.polygon([0, 2, 0], corners[::-1], [1, 1, 1]), [0, 0, 0]),
                  0, 0)
        inside = plate[np.hypot(plate[:, 0], plate[:, 2]) < 1]
        distance = np.linalg.norm(inside, axis=1)
        exact = (1e-4 * 2 / distance**3) @ harmonics(4, inside / distance[:, None])
        disk = light.disk([0, 2, 0], [0, -1, 0], 1, [1, 1, 1])
        self.near(light.project(4, disk, [0, 0, 0])[0], exact, 2e-3)
        # a tube of length 0 is a sphere
        tube = light.tube(center, [1e-9, 0, 0], radius, color)
        self.near(light.project(5, tube, points), expected[:, None] * color[:, None], 1e-4)
        self.near(light.power_from_radiance(square, 2), math.pi * 2 * 4, 1e-5)
        self.near(light.intensity_from_radiance(disk, 2), math.pi * 2, 1e-5)
        self.near(light.radiance_from_power(square, 8 * math.pi), 2, 1e-6)
        self.near(light.radiance_from_intensity(disk, 2 * math.pi), 2, 1e-6)
        texels = light.copy_area_texels(square)
        self.assertEqual(texels.shape, (11, 4))
        self.assertTrue(texels[:7].any() and not texels[7:].any())

    def test_many_lights_are_made_at_once_and_joined(self):
        grid = light.sphere(points.reshape(2, 3, 3), 0.1, color)
        self.assertEqual(grid.shape, (2, 3))
        joined = light.join(grid, one, light.point([0, 1, 0], color))
        self.assertEqual(joined["kind"].tolist(), [0] * 7 + [1])
        self.near(joined["position"][6], center, 1e-6)
        self.near(joined["radiance"][7], color, 0)
        # NumPy's own functions know the type, too
        self.same(np.concatenate([grid.ravel(), joined[6:]]).view("u1"), joined.view("u1"))
        with io.BytesIO() as file:
            np.save(file, joined)
            file.seek(0)
            self.same(light.project(3, np.load(file), points), light.project(3, joined, points))
        self.same(light.project(3, joined, points), light.project(3, [*joined], points))

    def test_irradiance(self):
        for point, normal in zip(points, normals):
            ways, weights = cap_rule(*cap_of(center, radius, point), 200)
            exact = weights @ np.maximum(ways @ normal, 0)
            self.near(light.irradiance(one, point, normal), exact * color, 2e-4)
        self.near(light.irradiance(light.hemisphere([0, 1, 0], color, [0, 0, 0]), [0, 0, 0],
                                   [0, 1, 0]), math.pi * color, 1e-5)

    def test_range(self):
        distance = light.range(one, 0.01)
        at = center + [distance, 0, 0]
        self.near(light.irradiance(one, at, [-1, 0, 0]).max(), 0.01, 1e-5)
        self.assertEqual(light.range(light.directional([0, 1, 0], color), 0.5), math.inf)

    def test_caps_in_other_units(self):
        self.near(light.cap_irradiance_from_radiance(2, 0.3), 2 * math.pi * math.sin(0.3)**2, 1e-6)
        self.near(light.cap_radiance_from_irradiance(2 * math.pi * math.sin(0.3)**2, 0.3), 2, 1e-5)


class Lobes(Case):
    def test_factors(self):
        t, w = np.polynomial.legendre.leggauss(400)
        half, weight = (t + 1) / 2, w / 2
        basis = lambda l, t: np.polynomial.legendre.Legendre.basis(l)(t)
        for found, kernel in ((lobe.make_diffuse(6), lambda t: np.maximum(t, 0)),
                              (lobe.make_phong(6, 3.5),
                               lambda t: 4.5 / (2 * math.pi) * np.maximum(t, 0) ** 3.5)):
            self.near(found, [2 * math.pi * weight @ (kernel(half) * basis(l, half))
                              for l in range(6)], 1e-6)
        k = 7
        vmf = k / (2 * math.pi * (1 - math.exp(-2 * k))) * np.exp(k * (t - 1))
        self.near(lobe.make_vmf(6, k), [2 * math.pi * w @ (vmf * basis(l, t)) for l in range(6)],
                  1e-6)

    def test_responses_are_dot_products(self):
        factors = lobe.make_phong(5, 9)
        degree = np.floor(np.sqrt(np.arange(25))).astype(int)
        kernels = factors[degree] * harmonics(5, normals)
        self.near(lobe.project(factors, normals), kernels, 1e-6)
        exact = (kernels * expected).sum(1)[:, None] * color
        self.near(lobe.response(factors, normals, one, points), exact, 4e-6)
        mixed = light.join(one, light.directional([0, 1, 0], [0, 0, 1]))
        exact[:, 2] += kernels @ harmonics(5, np.array([0.0, 1, 0]))
        self.near(lobe.response(factors, normals, mixed, points), exact, 4e-6)

    def test_ggx(self):
        found = lobe.find_ggx([0, 0, 1], [0, 0, 1], [0.3, 0.6])
        self.assertEqual(found["lobe"].shape, (2, 5))
        self.near(found["diffuse_f0"] + found["diffuse_f90"], 1, 1e-6)
        self.near(np.linalg.norm(found["lobe"]["axis"], axis=-1), 1, 1e-5)
        # seen head-on with F0 = F90 = 1, a smooth surface reflects nearly all light
        weights = found["lobe"]["f0"] + found["lobe"]["f90"]
        self.near(weights[0].sum(), 1, 0.03)
        self.assertEqual(lobe.copy_ggx_texels().shape, (5152, 4))


class Probes(Case):
    coefficients = np.random.default_rng(7).normal(size=(3, 9)) * 0.1 + np.eye(9)[0]

    def test_irradiance(self):
        nodes, weights = sphere_rule(30)
        radiance = harmonics(3, nodes) @ self.coefficients.T
        # the cosine's series of three bands: quadrature of its own projection
        ways, cosines = cap_rule(np.array([0, 0, 1.0]), 1)
        zonal = (cosines * ways[:, 2]) @ harmonics(3, ways)
        factors = [zonal[l * l + l] * math.sqrt(4 * math.pi / (2 * l + 1)) for l in range(3)]
        degree = np.floor(np.sqrt(np.arange(9))).astype(int)
        exact = harmonics(3, normals) @ (np.take(factors, degree)
                                         * (weights @ (radiance[:, :, None]
                                                       * harmonics(3, nodes)[:, None])
                                            .reshape(len(nodes), -1)).reshape(3, 9)).T
        self.near(probe.irradiance(self.coefficients, normals), exact, 1e-5)
        many = self.coefficients * np.arange(6)[:, None, None]
        self.near(probe.irradiance(many, normals), exact * np.arange(6)[:, None], 1e-5)
        c = probe.make_constants(self.coefficients)
        x, y, z = normals.T
        one = np.ones(6)
        polynomial = (np.stack([x, y, z, one], 1) @ c["linear"].T
                      + np.stack([x * y, y * z, z * z, z * x], 1) @ c["quadratic"].T
                      + np.outer(x * x - y * y, c["last"][:3]))
        self.near(polynomial, exact, 1e-5)

    def test_fit(self):
        ways = unit_vectors(8, 200)
        values = harmonics(3, ways) @ self.coefficients[0]
        self.near(probe.fit(3, ways, values), self.coefficients[0], 1e-5)
        self.near(probe.fit(3, ways, values, np.full(200, 2)), self.coefficients[0], 1e-5)
        rough = probe.fit(3, ways, values, smoothness=100)
        self.assertLess(np.abs(rough[4:]).max(), np.abs(self.coefficients[0, 4:]).max() / 5)

    def test_positive(self):
        c = np.zeros((1, 9))
        c[0, 0], c[0, 2] = 1, 2
        ways = unit_vectors(9, 2000)
        exact = math.sqrt(1 / (4 * math.pi)) - 2 * math.sqrt(3 / (4 * math.pi))
        self.near(probe.minimum(c), exact, 1e-6)
        windowed = sh.apply_window(probe.make_positive_window(c), c)
        self.near(probe.minimum(windowed), 0, 1e-5)
        self.assertGreaterEqual((harmonics(3, ways) @ windowed[0]).min(), -1e-5)

    def test_conventions(self):
        ours = np.random.default_rng(10).normal(size=16)
        theirs = probe.Convention("positive", "n3d", (1, -3, 2))
        converted = probe.convert(probe.Convention(), theirs, ours)
        # their f at (x, y, z) is ours at x X + y Y + z Z, with X, Y, Z their axes
        ways = unit_vectors(11, 20)
        world = np.stack([ways[:, 0], ways[:, 2], -ways[:, 1]], 1)
        order = np.concatenate([np.arange(-l, l + 1) for l in range(4)])
        basis = harmonics(4, ways) * (-1.0) ** np.abs(order)
        self.near(basis @ converted / math.sqrt(4 * math.pi),
                  harmonics(4, world) @ ours, 1e-5)
        # half a turn around z is the other sign: what is found may be named otherwise
        found = probe.recognize(1e-4, ours, converted)
        self.near(probe.convert(probe.Convention(), found, ours), converted, 1e-5)
        self.assertIsNone(probe.recognize(1e-4, ours, np.arange(16)))
        self.near(probe.convert(theirs, probe.Convention(), converted), ours, 1e-5)

    def test_engines(self):
        names = [probe.engine_format(engine).name for engine in probe.Engine]
        self.assertEqual(names, ["unity", "unreal", "godot", "filament"])
        form = probe.engine_format("unreal")
        values = probe.export(form, self.coefficients)
        converted = probe.convert(probe.Convention(), form.convention, self.coefficients)
        scaled = converted * np.float32(form.factors)
        self.near(values, scaled.T.ravel() if form.interleaved else scaled.ravel(), 1e-6)
        self.same(probe.export("unreal", [self.coefficients] * 2), np.stack([values, values]))


class Cpu(Case):
    def test_every_set_gives_the_same_bits(self):
        found = []
        for flag in (1, 2, 4, 8):
            if cpu.flags() & flag:
                self.assertEqual(cpu.limit(flag), flag)
                found.append((cpu.name(), sphere.project(5, center, radius, points)))
        cpu.limit(15)
        self.assertEqual(found[0][0], "scalar")
        for _, result in found:
            self.same(result, found[0][1])
