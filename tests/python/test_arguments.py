# SPDX-License-Identifier: MIT
"""Bad arguments raise TypeError or ValueError, and never crash."""
import inspect
import math
import warnings

import numpy as np

from lampion import (Error, brdf, cpu, field, light, lobe, material, preintegrated, probe, sh,
                     shade, sphere, transfer)
from oracle import Case, unit_vectors

up, at, color = [0, 1, 0], [[0, 0, 0], [1, 2, 3]], [1, 2, 3]
lights = light.sphere([[0, 3, 0]], 0.5, color)
square = light.rectangle([0, 2, 0], [[1, 0, 0], [0, 0, 1]], [1, 1, 1])
lambert = brdf.create_lambert(0.5)
table = brdf.Table(lambert, 3, views=4)
lobes = material.lobes(0.5, 0.5, 3)
product = sh.Product(3)
pre_lobe, pre_brdf = preintegrated.Lobe(3), preintegrated.Brdf(table)
grid = field.Field(3, nodes=(3, 3, 3))
grid.update(lights)
small = field.Field(3, nodes=2, light_max=1)
small.update(lights)
bounce = transfer.Transfer(at, [up, up], 0.5, 1, [[1], [0]], probe_directions=[up],
                           probe_hits=[[1]])
c, rgb, ways = np.ones(9), np.ones((3, 9)), unit_vectors(1, 12)
own = probe.Convention()

# Each function with arguments that it takes.
calls = [
    (sh.count, 3), (sh.index, 2, 1), (sh.rotation_count, 3), (sh.eval, 3, up),
    (sh.eval_gradient, 3, up), (sh.reconstruct, c, up), (sh.combine, 1, c, 2, c), (sh.dot, c, c),
    (sh.expand_zonal, [1, 2, 3], up), (sh.make_rotation, 3, [0, 0, 0, 1]),
    (sh.make_rotation_from_matrix, 3, np.eye(3)), (sh.rotate_z, 0.5, c),
    (sh.rotate, np.ones(35), c), (sh.rotate_by_matrix, np.eye(3), c), (sh.window_name, "none"),
    (sh.make_window, 3, "hanning", 4), (sh.make_laplacian_window, 0.5, c),
    (sh.apply_window, [1, 2, 3], c), (sh.project_function, 3, lambda v: v[0], 4),
    (sh.project_latlong, 3, np.ones((12, 24, 3))), (sh.project_cubemap, 3, np.ones((6, 4, 4))),
    (sh.multiply_few, c, c), (sh.Product, 3), (product.multiply, c, c), (sh.pack_half, c),
    (sh.unpack_half, c.astype(np.float16)), (sh.eval_double, 3, up),
    (sh.eval_gradient_double, 3, up), (sh.eval_hessian_double, 3, up),
    (sh.make_rotation_double, 3, [0, 0, 0, 1]), (sh.rotate_double, np.ones(35), c),
    (sphere.project_zonal, 3, 1, 2), (sphere.project, 3, up, 1, at),
    (sphere.project_double, 3, up, 1, at), (sphere.project_gradient, 3, up, 1, at),
    (sphere.project_all, 3, [up], 1, at), (sphere.sum, 3, [up], 1, color, at),
    (sphere.sum_gradient, 3, [up], 1, color, at), (sphere.power_from_radiance, 1, 2),
    (sphere.radiance_from_power, 1, 2), (sphere.intensity_from_radiance, 1, 2),
    (sphere.radiance_from_intensity, 1, 2),
    (light.sphere, up, 1, color), (light.point, up, color),
    (light.spot, up, up, 0.1, 0.5, color), (light.directional, up, color),
    (light.cap, up, 0.1, color), (light.hemisphere, up, color, color),
    (light.rectangle, up, [[1, 0, 0], [0, 0, 1]], color, True), (light.disk, up, up, 1, color),
    (light.tube, up, up, 1, color), (light.polygon, up, np.eye(3), color), (light.join, lights),
    (light.find_cap, lights, at), (light.project_zonal, 3, lights, at),
    (light.project_gradient, 3, lights, at), (light.project, 3, lights, at),
    (light.add, 3, lights, at, np.zeros((2, 3, 9), np.float32)),
    (light.irradiance, lights, at, up), (light.range, lights, 0.1),
    (light.copy_area_texels, square), (light.cap_irradiance_from_radiance, 1, 0.1),
    (light.cap_radiance_from_irradiance, 1, 0.1), (light.power_from_radiance, square, 1),
    (light.radiance_from_power, square, 1), (light.intensity_from_radiance, square, 1),
    (light.radiance_from_intensity, square, 1),
    (lobe.make_diffuse, 3), (lobe.make_phong, 3, 2), (lobe.make_vmf, 3, 2),
    (lobe.project, [1, 2, 3], up), (lobe.response, [1, 2, 3], up, lights, at),
    (lobe.find_ggx, up, up, 0.5),
    (probe.irradiance, rgb, up), (probe.make_constants, rgb, 1),
    (probe.fit, 2, ways, np.ones(12), np.ones(12), 0.1), (probe.make_positive_window, c),
    (probe.minimum, c), (probe.convert, own, own, c), (probe.recognize, 0.1, c, c),
    (probe.engine_format, "unity"), (probe.export, probe.engine_format("unity"), rgb),
    (brdf.create_lambert, 0.5), (brdf.create_phong, 0.5, 3), (brdf.create_ggx, 0.5, 0.5, 0.5, 0.5),
    (brdf.create_sheen, 0.5, 0.5, 0.5), (brdf.create_sgd, brdf.find_sgd("brass")),
    (brdf.sgd_name, 3), (brdf.find_sgd, "brass"), (lambert.eval, up, up),
    (lambert.eval_double, up, up), (lambert.project, 3, [0, 0, 1], 8), (table.interpolate, 0.5, 0),
    (table.find_albedo, 1, 0), (brdf.Table.read, table.write()),
    (pre_lobe.eval, 1, 0.1, 0.5), (preintegrated.Lobe.read, pre_lobe.write()),
    (pre_brdf.eval, 0.5, [0, 0, 1], 0.1), (pre_brdf.ambient, 0.5), (preintegrated.Brdf, table),
    (preintegrated.Brdf.read, pre_brdf.write()),
    (material.lobes, 0.5, 0.5, 3), (material.metallic_roughness, color[:1] * 3, 0.5, 0.5),
    (material.table, table, pre_brdf), (material.preintegrated, pre_brdf),
    (material.dielectric, 1.5, 1, 1), (material.coat_reflectance, 1, 0.1, up, up),
    (lobes.with_coat, 1, 0.1), (lobes.with_sheen, [1, 1, 1], 0.5, [table] * 16),
    (shade.shade, lobes, at, up, up, lights), (shade.environment, lobes, up, up, rgb),
    (field.Field, 3), (field.Field.read, grid.write()), (grid.update, lights),
    (grid.move, [0], lights), (grid.want, at), (grid.eval, at),
    (grid.eval_lobe, [1, 2, 3], up, at), (grid.shade, lobes, at, up, up), (grid.find_near, up),
    (grid.copy_nodes, 0, 3),
    (transfer.Transfer, at, [up, up], 0.5, 1, [[1], [0]]), (bounce.update, np.ones((2, 3))),
    (bounce.irradiance, 0, up, up), (bounce.copy_irradiance, 0, 2), (bounce.eval_probe, 0, 1),
    (cpu.limit, 15)]

bad = [None, "text", b"bytes", object(), {}, 1j, math.nan, -math.inf, -1, 0, 10**30, 129, 1.5,
       [], [1, 2], [[1], [2, 3]], [None] * 3, np.full(3, math.nan), np.full((2, 3), 1e300),
       np.zeros((2, 2)), np.zeros(5, "S3"), np.zeros((0, 3)), np.zeros(3, complex),
       np.zeros(0, light.dtype), np.full((3, 4, 5, 6), 7), np.frombuffer(bytes(range(172)) * 2,
                                                                     light.dtype)]


class Sweep(Case):
    def test_the_calls_are_good(self):
        for function, *arguments in calls:
            with self.subTest(function=function):
                function(*arguments)

    def test_nothing_crashes(self):
        refused = 0
        for function, *arguments in calls:
            for place in range(len(arguments)):
                for value in bad:
                    tried = arguments[:place] + [value] + arguments[place + 1:]
                    try:
                        function(*tried)
                    except (TypeError, ValueError, Error) as error:
                        self.assertTrue(str(error))
                        refused += 1
        cpu.limit(15)
        self.assertGreater(refused, 5000)

    def test_bands(self):
        tried = 0
        for function, *arguments in calls:
            if "bands" in inspect.signature(function).parameters and arguments[0] == 3:
                for value in (-1, 129, 2**40, 2.5, "3", None, math.nan):
                    self.refused("bands must be", function, value, *arguments[1:])
                    tried += 1
        self.assertGreater(tried, 100)

    def test_none_and_text_are_refused(self):
        optional = {"weights", "preintegrated", "count", "direct"}
        for function, *arguments in calls:
            names = list(inspect.signature(function).parameters)
            for place, name in zip(range(len(arguments)), names):
                for value in (None, object()):
                    if value is None and name in optional:
                        continue
                    with self.subTest(function=function, argument=name, value=value):
                        with self.assertRaises((TypeError, ValueError)):
                            function(*arguments[:place], value, *arguments[place + 1:])


class Messages(Case):
    """Errors name the argument and the fault."""

    def test_shapes_and_types(self):
        for words, function, *arguments in (
                ("point must have the shape (…, 3)", sphere.project, 3, up, 1, [1, 2]),
                ("radius must be 0 …", sphere.project, 3, up, -1, at),
                ("radius must be finite", sphere.project, 3, up, math.nan, at),
                ("point must be numbers", sphere.project, 3, up, 1, ["a", "b", "c"]),
                ("directions must be unit", sh.eval, 3, [1, 1, 0]),
                ("directions must be unit", sh.eval, 3, [math.nan, 0, 0]),
                ("sh must have n² coefficients", sh.reconstruct, np.ones(10), up),
                ("b must have the shape (…, 9)", sh.dot, np.ones(9), np.ones(4)),
                ("window must be one of none, hanning", sh.make_window, 3, "hamming"),
                ("rotation must not be 0", sh.make_rotation, 3, [0, 0, 0, 0]),
                ("rotation must be a rotation", sh.rotate_by_matrix, -np.eye(3), c),
                ("rotation must be a rotation", sh.rotate_by_matrix, 2 * np.eye(3), c),
                ("m must be -2 … 2", sh.index, 2, 3),
                ("inner must be at most outer", light.spot, up, up, 0.5, 0.1, color),
                ("angle must be 0 … 3.14", light.cap, up, 4, color),
                ("direction must be unit", light.cap, [0, 2, 0], 0.1, color),
                ("the number of corners must be 3 … 8", light.polygon, up, np.ones((9, 3)), color),
                ("corner must lie in a plane", light.polygon, up,
                 [[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 1, 1]], color),
                ("radiance must be finite", light.sphere, up, 1, [math.inf, 0, 0]),
                ("image must have at least 12 rows for 3 bands, not 4", sh.project_latlong, 3,
                 np.ones((4, 8))),
                ("image must be linear radiance, not the uint8", sh.project_latlong, 3,
                 np.ones((12, 24), np.uint8)),
                ("must not be areas", light.find_cap, square, at),
                ("must be an area", light.power_from_radiance, lights, 1),
                ("light must be a single one", light.range, light.join(lights, lights), 1),
                ("lights must be made", light.project, 3, [1, 2, 3], at),
                ("exponent must be at least 0", lobe.make_phong, 3, -1),
                ("axes must be 1, 2, 3", probe.convert, probe.Convention(axes=(1, 1, 2)), own, c),
                ("sign must be one of", probe.convert, probe.Convention("plus"), own, c),
                ("must have at least 3 bands", probe.make_constants, np.ones((3, 4))),
                ("f0 must be 0 … 1", brdf.create_ggx, 0.5, 2),
                ("alpha_x must be 0.001 … 1", brdf.create_ggx, 0, 0.5),
                ("no material is called", brdf.find_sgd, "cheese"),
                ("data must be bytes", brdf.read_merl, "text"),
                ("view must be 0 … 3", table.find_albedo, 4),
                ("white must be 16 tables", lobes.with_sheen, [1, 1, 1], 0.5, [table]),
                ("lobe must be given", lambda: shade.shade(lobes, at, up, up, lights,
                                                           method="preintegrated")),
                ("method must be one of zonal", lambda: shade.shade(lobes, at, up, up, lights,
                                                                    method="magic")),
                ("at must be 0 … 0", grid.move, [1], lights),
                ("at must be an index, and there is none", field.Field(3).remove, 0),
                ("lights must not be areas", grid.update, square),
                ("lights must not be areas", grid.reset, square),
                ("lights must not be areas", grid.add, square),
                ("lights must be at most 1, the field's light_max, not 2", small.update,
                 light.join(lights, lights)),
                ("lights must be at most 1, the field's light_max, not 2", small.add, lights),
                ("a Brdf is made by the functions", brdf.Brdf),
                ("at must be different", grid.move, [0, 0], light.join(lights, lights)),
                ("count must be 0 … 27", grid.copy_nodes, 0, 28),
                ("nodes must be 2 … 1024", lambda: field.Field(3, nodes=(1, 2, 2))),
                ("hits must be 0 … 1 or NONE", transfer.Transfer, at, [up, up], 0.5, 1,
                 [[2], [0]]),
                ("hits must have the shape (2, n)", transfer.Transfer, at, [up, up], 0.5, 1,
                 [[1]]),
                ("surfel must be 0 … 1", bounce.irradiance, 2, up, up),
                ("albedo must be 0 … 1", transfer.Transfer, at, [up, up], 2, 1, [[1], [0]])):
            with self.subTest(words):
                self.refused(words, function, *arguments)

    def test_visibility(self):
        self.refused("visibility must broadcast to (1, 2)", light.project, 3, lights, at,
                     visibility=[1, 1, 1])

    def test_what_the_library_refuses(self):
        self.refused("these 3 samples do not determine the 9 coefficients of 3 bands", probe.fit, 3,
                     [up] * 3, np.ones(3), kind=Error)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.refused("", field.Field, 3, nodes=(1024, 1024, 1024), kind=Error)

    def test_damaged_lights(self):
        for member, value in (("kind", 10), ("radius", -1), ("position", math.nan)):
            one = lights.copy()
            one[member] = value
            self.refused(member, light.project, 3, one, at)
        one = light.polygon(up, np.eye(3), color)
        one["corner_count"] = 9
        self.refused("corner_count", light.project, 3, one, at)
