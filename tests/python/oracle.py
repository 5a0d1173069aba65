# SPDX-License-Identifier: MIT
"""Spherical harmonics and integrals over the sphere in NumPy, from their definitions, and
assertions about errors. Nothing here calls the library."""
import math
import unittest

import numpy as np


def legendre(l, m, t):
    """P_l^m(t) with the Condon-Shortley sign, by its recurrence in double."""
    value = np.ones_like(t)
    for k in range(1, m + 1):
        value = -value * (2 * k - 1) * np.sqrt(np.maximum(0, 1 - t * t))
    if l == m:
        return value
    before, value = value, t * (2 * m + 1) * value
    for k in range(m + 2, l + 1):
        before, value = value, ((2 * k - 1) * t * value - (k + m - 1) * before) / (k - m)
    return value


def harmonics(bands, directions):
    """Y_lm of directions (…, 3) in double, (…, n²): the definition of lampion/sh.h."""
    x, y, z = np.moveaxis(np.asarray(directions, float), -1, 0)
    phi = np.arctan2(y, x)
    planes = []
    for l in range(bands):
        for m in range(-l, l + 1):
            k = math.sqrt((2 * l + 1) / (4 * math.pi)
                          * math.factorial(l - abs(m)) / math.factorial(l + abs(m)))
            plane = k * legendre(l, abs(m), z)
            if m:
                plane = plane * math.sqrt(2) * (np.sin(-m * phi) if m < 0 else np.cos(m * phi))
            planes.append(plane)
    return np.stack(planes, -1)


def sphere_rule(rings):
    """Directions and weights of a quadrature of the sphere, exact to degree 2 rings - 1."""
    z, w = np.polynomial.legendre.leggauss(rings)
    phi = (np.arange(2 * rings) + 0.5) * math.pi / rings
    radius = np.sqrt(1 - z * z)
    directions = np.stack([np.outer(radius, np.cos(phi)), np.outer(radius, np.sin(phi)),
                           np.outer(z, np.ones_like(phi))], -1)
    return directions.reshape(-1, 3), np.outer(w, np.full(2 * rings, math.pi / rings)).ravel()


def cap_rule(axis, one_minus_cos, rings=40):
    """Directions and weights of a quadrature of a spherical cap around a unit axis."""
    t, w = np.polynomial.legendre.leggauss(rings)
    z = 1 - one_minus_cos * (1 - t) / 2
    w = w * one_minus_cos / 2
    phi = (np.arange(2 * rings) + 0.5) * math.pi / rings
    helper = np.eye(3)[np.argmin(np.abs(axis))]
    u = np.cross(axis, helper)
    u /= np.linalg.norm(u)
    v = np.cross(axis, u)
    radius = np.sqrt(np.maximum(0, 1 - z * z))
    directions = (z[:, None, None] * np.asarray(axis, float)
                  + radius[:, None, None] * (np.cos(phi)[:, None] * u + np.sin(phi)[:, None] * v))
    return directions.reshape(-1, 3), np.outer(w, np.full(2 * rings, math.pi / rings)).ravel()


def cap_of(center, radius, point):
    """Axis and 1 - cos a of a sphere seen from outside."""
    offset = np.subtract(center, point, dtype=float)
    distance = np.linalg.norm(offset)
    return offset / distance, 1 - math.sqrt(1 - (radius / distance) ** 2)


def sphere_coefficients(bands, center, radius, point):
    """The projection of a sphere of radiance 1, by quadrature of its cap."""
    directions, weights = cap_rule(*cap_of(center, radius, point))
    return weights @ harmonics(bands, directions)


def unit_vectors(seed, count):
    vectors = np.random.default_rng(seed).normal(size=(count, 3))
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def rotation_of(axis, angle):
    """Rodrigues' matrix, and the quaternion x, y, z, w of the same rotation."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    return matrix, np.r_[np.multiply(axis, math.sin(angle / 2)), math.cos(angle / 2)]


class Case(unittest.TestCase):
    def near(self, found, expected, bound, what=""):
        """The largest difference is at most bound; NaN fails."""
        found, expected = np.asarray(found), np.asarray(expected)
        self.assertEqual(found.shape, np.broadcast_shapes(found.shape, expected.shape), what)
        error = np.max(np.abs(found - expected), initial=0)
        if not error <= bound:
            self.fail(f"{what} error {error:.3g}, not at most {bound:.3g}")

    def same(self, found, expected):
        """Arrays of the same shape and bits."""
        np.testing.assert_array_equal(found, expected, strict=True)

    def refused(self, words, call, *arguments, kind=(ValueError, TypeError), **keywords):
        """The call raises such an error, whose text has these words."""
        with self.assertRaises(kind) as caught:
            call(*arguments, **keywords)
        self.assertIn(words, str(caught.exception))
