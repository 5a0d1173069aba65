# SPDX-License-Identifier: MIT
"""lampion.material, shade, field and transfer against quadrature and the radiosity equation."""
import math
import weakref

import numpy as np

from lampion import brdf, field, light, material, preintegrated, shade, transfer
from oracle import Case, cap_of, cap_rule, harmonics, sphere_rule, unit_vectors

center, radius, color = np.array([0.5, 3.0, 0.5]), 0.7, np.array([1.0, 2.0, 3.0])
lights = light.sphere(center, radius, color)
point, normal = np.zeros(3), np.array([0.0, 1, 0])
view = np.array([0.6, 0.8, 0])
mirror = np.array([-0.6, 0.8, 0])
diffuse, specular = np.array([0.5, 0.25, 0.125]), np.array([0.2, 0.3, 0.4])


def phong_series(bands, exponent, cosines):
    """The truncated series of (e+1)/(2 pi) max(t, 0)^e."""
    t, w = np.polynomial.legendre.leggauss(200)
    t, w = (t + 1) / 2, w / 2
    total = 0
    for l in range(bands):
        basis = np.polynomial.legendre.Legendre.basis(l)
        total = total + (2 * l + 1) / 2 * (w @ ((exponent + 1) / (2 * math.pi) * t**exponent
                                                * basis(t))) * basis(cosines)
    return total


class Shading(Case):
    def test_lobes(self):
        ways, weights = cap_rule(*cap_of(center, radius, point))
        exact = color * (weights @ np.maximum(ways @ normal, 0) * diffuse / math.pi
                         + weights @ phong_series(10, 20, ways @ mirror) * specular)
        stuff = material.lobes(diffuse, specular, 20)
        for method in ("zonal", shade.Method.ZONAL):
            self.near(shade.shade(stuff, point, normal, view, lights, method=method), exact, 2e-5)
        lobe = preintegrated.Lobe(10)
        self.near(shade.shade(stuff, point, normal, view, lights, method="preintegrated",
                              lobe=lobe), exact, 0.01 * exact.max())
        # the paper's method truncates the diffuse lobe, too
        self.near(shade.shade(stuff, point, normal, view, lights, method="coefficients"), exact,
                  0.03 * exact.max())

    def test_one_material_for_each_surface(self):
        rough = np.array([0.2, 0.5, 0.9])
        many = material.metallic_roughness(diffuse, [0, 0.5, 1], rough)
        self.assertEqual(many.shape, (3,))
        found = shade.shade(many, point, normal, view, lights)
        self.assertEqual(found.shape, (3, 3))
        for i, (metallic, roughness) in enumerate(zip([0, 0.5, 1], rough)):
            one = material.metallic_roughness(diffuse, metallic, roughness)
            self.near(found[i], shade.shade(one, point, normal, view, lights), 1e-6)
        self.assertFalse(np.allclose(found[0], found[1]))

    def test_environment(self):
        c = np.zeros((3, 16))
        c[:, 0] = math.sqrt(4 * math.pi) * color  # uniform radiance
        self.near(shade.environment(material.lobes(diffuse), normal, view, c), diffuse * color,
                  1e-5)

    def test_coat(self):
        fresnel = 0.04 + 0.96 * (1 - 0.8) ** 5
        weights = material.coat_reflectance([0, 0.5, 1], 0.1, normal, view)
        self.near(weights, np.array([0, 0.5, 1]) * fresnel, 1e-6)
        black, white = material.lobes(0), material.lobes(1)
        c = np.zeros((3, 4))
        c[:, 0] = math.sqrt(4 * math.pi)
        coated = [shade.environment(stuff.with_coat(1, 0.1), normal, view, c)
                  for stuff in (black, white)]
        self.near(coated[1] - coated[0], 1 - fresnel, 1e-5)

    def test_dielectric(self):
        f0 = ((1.5 - 1) / (1.5 + 1)) ** 2
        self.near(material.dielectric()["f0"], f0, 1e-6)
        self.near(material.dielectric(2.0, 0.5, [1, 0.5, 0])["f0"],
                  0.5 / 9 * np.array([1, 0.5, 0]), 1e-6)
        glass = material.dielectric(1.5)
        with_it = material.metallic_roughness(diffuse, 0, 0.3, dielectric=glass)
        without = material.metallic_roughness(diffuse, 0, 0.3)
        self.near(shade.shade(with_it, point, normal, view, lights),
                  shade.shade(without, point, normal, view, lights), 1e-6)

    def test_tables_and_sheen(self):
        lambert = brdf.Table(brdf.create_lambert(diffuse), 6, views=8)
        ways, weights = cap_rule(*cap_of(center, radius, point))
        exact = color * diffuse / math.pi * (weights @ np.maximum(ways @ normal, 0))
        stuff = material.table(lambert)
        alive = weakref.ref(lambert)
        del lambert
        self.assertIsNotNone(alive())
        self.near(shade.shade(stuff, point, normal, view, lights), exact, 0.02 * exact.max())
        white = [brdf.Table(brdf.create_sheen(r, 1), 4, views=4)
                 for r in np.linspace(0.07, 1, 16)]
        cloth = material.lobes(diffuse).with_sheen([0.5, 0.5, 0.5], 0.5, white)
        alive = weakref.ref(white[3])
        del white
        self.assertIsNotNone(alive())
        self.near(shade.shade(cloth.with_coat(0, 0), point, normal, view, lights),
                  shade.shade(cloth, point, normal, view, lights), 0)
        self.assertFalse(np.allclose(shade.shade(cloth, point, normal, view, lights),
                                     shade.shade(material.lobes(diffuse), point, normal, view,
                                                 lights)))

    def test_tangents_turn_an_anisotropic_table(self):
        table = brdf.Table(brdf.create_ggx(0.6, 0.9, alpha_y=0.1), 6, views=8, azimuths=8)
        stuff = material.table(table)
        straight, turned, level = (
            shade.shade(stuff, point, normal, normal, light.sphere([2, 3, 0], 0.2, color),
                        tangent=tangent) for tangent in ([1, 0, 0], [0, 0, 1], None))
        self.assertGreater(straight[0], 2 * turned[0])
        # without a tangent it is the horizontal one, which for a level surface is any
        self.assertTrue(np.isfinite(level).all())


class Fields(Case):
    some = light.sphere(unit_vectors(1, 40) * 3, 0.1, color)
    at = unit_vectors(2, 30) * 1.5

    def made(self, **keywords):
        grid = field.Field(4, nodes=(8, 8, 8), origin=(-2, -2, -2), cell=(0.6, 0.6, 0.6),
                           **keywords)
        grid.update(self.some, threads=2)
        return grid

    def test_against_the_sum(self):
        grid, exact = self.made(error=0.01), light.project(4, self.some, self.at)
        bound = 2e-3 * np.abs(exact).max()
        self.near(grid.eval(self.at), exact, bound)
        self.near(field.Field.read(grid.write()).eval(self.at), grid.eval(self.at), 0)
        factors = np.array([math.pi, 2 * math.pi / 3, math.pi / 4, 0])
        ways = unit_vectors(3, 30)
        degree = np.floor(np.sqrt(np.arange(16))).astype(int)
        series = np.einsum("pck,pk->pc", exact, factors[degree] * harmonics(4, ways))
        self.near(grid.eval_lobe(factors, ways, self.at), series, 3 * bound)
        stuff = material.lobes(diffuse, specular, 3)
        self.near(grid.shade(stuff, self.at, ways, ways),
                  shade.shade(stuff, self.at, ways, ways, self.some, bands=4), 6 * bound)

    def test_changes(self):
        grid = self.made()
        self.near(grid.lights()["position"], self.some["position"], 0)
        moved = light.sphere([[0, 4, 0], [4, 0, 0]], 0.2, color)
        grid.move([3, 0], moved)
        grid.remove(1)
        grid.add(light.point([0, -4, 0], color))
        expected = self.some.copy()
        expected[3], expected[0] = moved[0], moved[1]
        expected[1] = expected[39]
        expected = light.join(expected[:39], light.point([0, -4, 0], color))
        self.near(grid.lights()["position"], expected["position"], 0)
        fresh = self.made()
        fresh.update(expected)
        self.near(grid.eval(self.at), fresh.eval(self.at), 1e-4)
        self.assertEqual(grid.describe().light_count, 40)

    def test_pieces(self):
        grid, whole = field.Field(4, nodes=(8, 8, 8), origin=(-2, -2, -2),
                                  cell=(0.6, 0.6, 0.6)), self.made()
        grid.reset(self.some)
        grid.want(self.at)
        grid.compute(threads=2)
        self.near(grid.eval(self.at), whole.eval(self.at), 0)

    def test_near_lights(self):
        grid = self.made()
        at = self.some["position"][5]
        lights, fractions = grid.find_near(at)
        self.assertIn(5, lights)
        self.assertEqual(fractions[list(lights).index(5)], 1)
        begin, entries = grid.copy_lists()
        self.assertEqual(begin[-1], len(entries))
        self.assertTrue((np.diff(begin.astype(int)) >= 0).all() and entries.max() < 40)
        texels = grid.copy_nodes(10, 5)
        self.assertEqual(texels.shape, (5, 48, 4))
        inside = field.Field(4, nodes=(2, 2, 2), origin=(-2, -2, -2), cell=(4, 4, 4), reach=64)
        inside.update(self.some)
        self.assertIsNone(inside.coarser_level())

    def test_the_coarser_level_lives_with_the_field(self):
        grid = field.Field(3, nodes=(16, 16, 16), origin=(-2, -2, -2), cell=(0.3, 0.3, 0.3))
        grid.update(self.some)
        level = grid.coarser_level()
        del grid
        self.assertEqual(level.describe().desc.bands, 3)
        self.near(level.describe().desc.cell, 0.6, 1e-6)
        self.assertEqual(len(level.lights()), 40)


class Transfers(Case):
    def test_two_plates_that_see_each_other(self):
        albedo = np.array([0.5, 0.25, 0.75])
        made = transfer.Transfer([[0, 0, 0], [0, 1, 0]], [[0, 1, 0], [0, -1, 0]], albedo, 1,
                                 [[1, 1], [0, 0]])
        direct = np.array([[1.0, 2, 3], [0, 0, 0]])
        made.update(direct, iterations=200)
        # E0 = a E1, E1 = a (1 + E0)
        exact = np.array([albedo**2, albedo]) / (1 - albedo**2) * direct[0]
        self.near(made.copy_irradiance(), exact, 1e-5)
        self.near(made.irradiance([0, 1], [[0, 0, 0], [0, 1, 0]], [[0, 1, 0], [0, -1, 0]]), exact,
                  1e-5)
        self.assertLessEqual(made.describe().remainder, 1e-5)
        made.reset()
        self.near(made.copy_irradiance(), 0, 0)

    def test_sky_emission_and_probes(self):
        ways, _ = sphere_rule(8)
        up = ways[:, 1] > 0
        made = transfer.Transfer(
            [[0, 0, 0]], [[0, 1, 0]], 0, 1, [[1, 1, transfer.NONE, 1]], sky_count=1,
            links=[[transfer.NONE]], probe_directions=ways,
            probe_hits=[np.where(up, 1, transfer.NONE)], bands=2)
        made.update(sky=color)
        self.near(made.copy_irradiance()[0], math.pi * 0.75 * color, 1e-5)
        probes = made.eval_probe()
        self.assertEqual(probes.shape, (1, 3, 4))
        exact = 4 * math.pi / len(ways) * up @ harmonics(2, ways)
        self.near(probes[0], color[:, None] * exact, 1e-5)
        made.update(emission=color)
        self.near(made.copy_irradiance(), 0, 0)
