# SPDX-License-Identifier: MIT
"""lampion.brdf and preintegrated against formulas and quadrature."""
import math
import os
import signal
import threading
import weakref

import numpy as np

from lampion import Error, brdf, preintegrated
from oracle import Case, cap_rule, harmonics, sphere_rule, unit_vectors

upper = unit_vectors(1, 40) * [1, 1, 0] + np.abs(unit_vectors(1, 40)) * [0, 0, 1]
other = upper[::-1]
albedo = np.array([0.5, 0.25, 0.125])


class Formulas(Case):
    def test_lambert_and_phong(self):
        lambert = brdf.create_lambert(albedo)
        self.near(lambert.eval(upper, other), np.broadcast_to(albedo / math.pi, (40, 3)), 1e-7)
        self.near(lambert.eval([0, 0, -1], [0, 0, 1]), 0, 0)
        mirrored = other * [-1, -1, 1]
        cosine = np.maximum((upper * mirrored).sum(1), 0)
        exact = albedo * 7 / (2 * math.pi) * (cosine**5)[:, None]
        phong = brdf.create_phong(albedo, 5)
        self.near(phong.eval(upper, other), exact, 1e-5)
        self.near(phong.eval_double(upper, other), exact, 1e-7)

    def test_ggx(self):
        alpha, f0 = 0.3, np.array([0.9, 0.6, 0.3])
        half = upper + other
        half /= np.linalg.norm(half, axis=1, keepdims=True)
        spread = alpha**2 / (math.pi * ((half[:, 2] ** 2) * (alpha**2 - 1) + 1) ** 2)
        nv, nl = other[:, 2], upper[:, 2]
        smith = 0.5 / (nl * np.sqrt(nv**2 * (1 - alpha**2) + alpha**2)
                       + nv * np.sqrt(nl**2 * (1 - alpha**2) + alpha**2))
        fresnel = f0 + (1 - f0) * ((1 - (upper * half).sum(1)) ** 5)[:, None]
        exact = fresnel * (spread * smith)[:, None]
        self.near(brdf.create_ggx(alpha, f0).eval_double(upper, other), exact, 1e-5)

    def test_kinds(self):
        made = {"lambert": brdf.create_lambert(0.5), "phong": brdf.create_phong(0.5, 5),
                "ggx": brdf.create_ggx(0.3, 0.5, 0.1, 0.6), "sheen": brdf.create_sheen(0.5, 0.5),
                "sgd": brdf.create_sgd(brdf.find_sgd("gold-metallic-paint"))}
        for kind, made_of in made.items():
            self.assertEqual(made_of.describe().kind, kind)
        self.assertTrue(made["ggx"].describe().anisotropic)
        names = [brdf.sgd_name(i) for i in range(101)]
        self.assertIn("gold-metallic-paint", names[:100])
        self.assertIsNone(names[100])
        fit = brdf.find_sgd("gold-metallic-paint")
        self.assertEqual(fit["rho_d"].shape, (3,))
        self.assertGreater(fit["rho_d"][0], fit["rho_d"][2])

    def test_projection(self):
        nodes, weights = sphere_rule(64)
        wo = np.array([0.6, 0, 0.8])
        phong = brdf.create_phong(albedo, 5)
        cosine = np.maximum(nodes @ [-0.6, 0, 0.8], 0)
        values = 7 / (2 * math.pi) * cosine**5 * np.maximum(nodes[:, 2], 0)
        exact = np.outer(albedo, (weights * values) @ harmonics(4, nodes))
        self.near(phong.project(4, wo), exact, 1e-4)


class Files(Case):
    def test_rgl_round_trip(self):
        phong = brdf.create_phong(albedo, 2)
        data = brdf.encode_rgl(phong)
        read = brdf.read_rgl(bytearray(data))
        self.assertEqual(read.describe().kind, "rgl")
        self.near(read.eval([0.3, 0, 0.95], [-0.3, 0.1, 0.9]),
                  phong.eval([0.3, 0, 0.95], [-0.3, 0.1, 0.9]), 5e-3)
        self.refused("", brdf.read_rgl, data[:1000], kind=Error)

    def test_merl(self):
        size = np.array([2, 2, 2], "<i4").tobytes()
        cells = np.full(3 * 8, 1500.0)
        read = brdf.read_merl(size + cells.astype("<f8").tobytes())
        self.near(read.eval([0, 0, 1], [0.1, 0, 0.99]), [1, 1.15, 1.66], 1e-5)
        self.assertEqual(read.describe().shape, (2, 2, 2))


class Tables(Case):
    table = brdf.Table(brdf.create_phong(albedo, 5), 6, views=8)

    def test_coefficients_are_projections(self):
        info = self.table.describe()
        self.assertEqual((info.bands, info.views, info.azimuths, info.window), (6, 8, 1, "none"))
        coefficients = self.table.coefficients()
        self.assertEqual(coefficients.shape, (1, 8, 3, info.count))
        self.assertFalse(coefficients.flags.writeable)
        nodes, weights = sphere_rule(64)
        theta = 3 * info.theta_step
        cosine = np.maximum(nodes @ [-math.sin(theta), 0, math.cos(theta)], 0)
        values = 7 / (2 * math.pi) * cosine**5 * np.maximum(nodes[:, 2], 0)
        exact = (weights * values) @ harmonics(6, nodes)
        half = [l * l + l + m for l in range(6) for m in range(l + 1)]  # m >= 0 alone is kept
        self.near(coefficients[0, 3], np.outer(albedo, exact[half]), 1e-4)
        self.near(self.table.interpolate(math.cos(theta)), coefficients[0, 3], 1e-5)
        whole, series = self.table.find_albedo(3)
        self.near(whole, albedo * (weights @ values), 1e-3)

    def test_views_outlive_their_table(self):
        table = brdf.Table(brdf.create_lambert(albedo), 3, views=4)
        coefficients = table.coefficients()
        alive = weakref.ref(table)
        del table
        self.assertIsNotNone(alive())
        self.near(coefficients[0, 0, :, 0], albedo / math.sqrt(4 * math.pi), 1e-5)

    def test_bytes(self):
        data = self.table.write()
        self.same(brdf.Table.read(data).coefficients(), self.table.coefficients())
        self.same(brdf.Table.read(np.frombuffer(data, np.uint8)).coefficients(),
                  self.table.coefficients())
        damaged = bytearray(data)
        damaged[-5] ^= 1
        with self.assertRaises(Error) as caught:
            brdf.Table.read(damaged)
        self.assertEqual(caught.exception.result, "checksum")

    def test_threads_progress_and_cancelling(self):
        told = []
        made = brdf.Table(brdf.create_phong(albedo, 5), 6, views=8, threads=3,
                          progress=told.append)
        self.same(made.coefficients(), self.table.coefficients())
        self.assertEqual(told, sorted(told))
        self.assertEqual(told[-1], 1)

        def stop(done):
            raise KeyboardInterrupt

        for threads in (1, 2):
            self.refused("", brdf.Table, brdf.create_phong(albedo, 5), 6, progress=stop,
                         threads=threads, kind=KeyboardInterrupt)

    def test_control_c_ends_it_early(self):
        source = brdf.create_ggx(0.5, 0.5, alpha_y=0.05)
        for threads in (1, 2):
            told = [0]
            timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
            timer.start()
            self.refused("", brdf.Table, source, 60, views=200, azimuths=256, threads=threads,
                         progress=told.append, kind=KeyboardInterrupt)
            timer.join()
            self.assertLess(told[-1], 0.1)  # the whole takes many minutes


class Preintegrated(Case):
    def test_lobe(self):
        lobe = preintegrated.Lobe(8)
        one_minus_cos, cosine, exponent = 0.05, 0.9, 12
        ways, weights = cap_rule(np.array([0, 0, 1.0]), one_minus_cos)
        axis = np.array([math.sqrt(1 - cosine**2), 0, cosine])
        t, w = np.polynomial.legendre.leggauss(200)
        t, w = (t + 1) / 2, w / 2
        value = 0
        for l in range(8):
            basis = np.polynomial.legendre.Legendre.basis(l)
            scale = 2 * math.pi * w @ (13 / (2 * math.pi) * t**12 * basis(t))
            value += (2 * l + 1) / (4 * math.pi) * scale * (weights @ basis(ways @ axis))
        strength = math.pi * (1 - (1 - one_minus_cos) ** 2)
        self.near(lobe.eval([exponent], one_minus_cos, cosine), [value / strength],
                  0.006 * value / strength)
        again = preintegrated.Lobe.read(lobe.write())
        self.same(again.eval([1, 10], 0.1, 0.5), lobe.eval([1, 10], 0.1, 0.5))
        info = lobe.describe()
        self.assertEqual((info.bands, info.cell_count), (8, len(info.cells)))
        self.assertEqual(info.remap.shape, (321,))
        self.assertEqual(info.coefficients.shape, (info.pair_count, 2))

    def test_brdf(self):
        table = brdf.Table(brdf.create_lambert(albedo), 4, views=8)
        made = preintegrated.Brdf(table)
        nodes, weights = sphere_rule(30)
        series = (weights * np.maximum(nodes[:, 2], 0)) @ harmonics(4, nodes)
        ways, sizes = cap_rule(np.array([0.6, 0, 0.8]), 0.02)
        mean = (sizes @ harmonics(4, ways)) @ series / (math.pi * (1 - 0.98**2))
        self.near(made.eval(0.9, [0.6, 0, 0.8], 0.02), albedo / math.pi * mean, 2e-3)
        self.near(made.ambient([0.5, 0.9]), [albedo, albedo], 2e-3)
        self.same(preintegrated.Brdf.read(made.write()).ambient(0.5), made.ambient(0.5))
        info = made.describe()
        self.assertEqual(info.slices.shape, (info.view_count, info.cap_count))
        self.assertEqual(info.texels.shape, (info.texel_count, 3))
        self.near(info.ambient, albedo, 2e-3)
