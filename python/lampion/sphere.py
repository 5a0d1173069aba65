# SPDX-License-Identifier: MIT
"""Uniform spheres, and their exact projection onto spherical harmonics (lampion/sphere.h).

Seen from a point, a sphere of radius r at distance d covers a cap of half angle a, sin a = r/d.
Inside it, the cap keeps growing to the full sphere at the center. Lengths are in one unit of your
choice; radiance is in W·sr⁻¹·m⁻².
"""
from __future__ import annotations

import math
import threading
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core
from ._core import ffi, lib

__all__ = ["project_zonal", "project", "project_double", "project_gradient", "project_all", "sum",
           "sum_gradient", "power_from_radiance", "radiance_from_power", "intensity_from_radiance",
           "radiance_from_intensity"]

_double = np.dtype(np.float64)


def _radii(value: ArrayLike, dtype: np.dtype = np.dtype(np.float32)) -> NDArray:
    return _arrays.within("radius", _arrays.numbers("radius", value, (), dtype), 0,
                          _core.constants.LENGTH_MAX)


def project_zonal(bands: int, radius: ArrayLike, distance: ArrayLike, *,
                  out: NDArray | None = None) -> NDArray[np.float32]:
    """Zonal coefficients of spheres of unit radiance, around the direction to the center.

    Z_l = sqrt(pi (2l+1)) / 2 sin²a R_l(cos a) (paper Eq. 12).

    Parameters
    ----------
    bands : int
    radius, distance : array_like, (…)
        At least 0.
    out : ndarray of float32, (…, n), optional

    Returns
    -------
    ndarray of float32, (…, n)
    """
    n = _core.bands(bands)
    radii = _radii(radius)
    distances = _arrays.within("distance", _arrays.numbers("distance", distance), 0,
                               _core.constants.LENGTH_MAX)
    shape = _arrays.common_shape(("radius", radii, 0), ("distance", distances, 0))
    result = _arrays.Result(out, shape + (n,), [radii, distances])
    keep: list = []
    lib.lmp_sphere_project_zonal_n(n, _arrays.float_array(radii, shape, keep),
                                   _arrays.float_array(distances, shape, keep), math.prod(shape),
                                   result.sh())
    return result.finish()


_spheres_pointer = ffi.typeof("lmp_spheres *")
_white = np.ones(3, np.float32)
_white_array = _arrays.vec3_array(_white, (), [])


def _spheres(center: NDArray, radii: NDArray, radiance: NDArray, shape: tuple[int, ...],
             keep: list) -> Any:
    """lmp_spheres."""
    white = radiance is _white
    return ffi.new(_spheres_pointer, (
        _arrays.vec3_array(center, shape, keep), _arrays.float_array(radii, shape, keep),
        _white_array if white else _arrays.vec3_array(radiance, shape, keep)))


def project(bands: int, center: ArrayLike, radius: ArrayLike, point: ArrayLike, *,
            out: NDArray | None = None) -> NDArray[np.float32]:
    """Project spheres of unit radiance at points, each sphere at its point.

    L_lm = pi sin²a R_l(cos a) Y_lm(w), w being the direction to the center (paper Eq. 13).

    Parameters
    ----------
    bands : int
    center : array_like, (…, 3)
    radius : array_like, (…)
        At least 0.
    point : array_like, (…, 3)
    out : ndarray of float32, (…, n²), optional
        The planar layout, ``np.empty((n * n, count), np.float32).T``, is the faster one.

    Returns
    -------
    ndarray of float32, (…, n²)
    """
    n = _core.bands(bands)
    centers, radii = _arrays.points("center", center), _radii(radius)
    places = _arrays.points("point", point)
    shape = _arrays.common_shape(("center", centers, 1), ("radius", radii, 0), ("point", places, 1))
    result = _arrays.Result(out, shape + (n * n,), [centers, radii, places])
    keep: list = []
    lib.lmp_sphere_project_n(n, _spheres(centers, radii, _white, shape, keep),
                             _arrays.vec3_array(places, shape, keep), math.prod(shape), result.sh())
    return result.finish()


def project_double(bands: int, center: ArrayLike, radius: ArrayLike, point: ArrayLike, *,
                   out: NDArray | None = None) -> NDArray[np.float64]:
    """Project spheres as `project` does, in double, for research."""
    n, radii = _core.bands(bands), _radii(radius, _double)
    centers = _arrays.numbers("center", center, (3,), _double)
    places = _arrays.numbers("point", point, (3,), _double)
    return _arrays.each(
        out, (n * n,), lambda c, r, p, sh: lib.lmp_sphere_project_double(n, c, r[0], p, sh),
        ("center", centers, 1, "double *"), ("radius", radii, 0, "double *"),
        ("point", places, 1, "double *"), dtype=_double, ctype="double *")


def project_gradient(bands: int, center: ArrayLike, radius: ArrayLike,
                     point: ArrayLike) -> tuple[NDArray, NDArray]:
    """Project spheres as `project` does, and differentiate with respect to the point.

    Returns
    -------
    sh : ndarray of float32, (…, n²)
    gradient : ndarray of float32, (…, 3, n²)
        d/dx, d/dy, d/dz. On the surface, where it is infinite, it is clamped. Radius and distance
        must not both be 0.
    """
    n, radii = _core.bands(bands), _radii(radius)
    centers, places = _arrays.points("center", center), _arrays.points("point", point)
    shape = _arrays.common_shape(("center", centers, 1), ("radius", radii, 0), ("point", places, 1))
    if ((radii == 0) & (centers == places).all(axis=-1)).any():
        raise ValueError("radius and distance must not both be 0")
    gradient = np.empty(shape + (3, n * n), np.float32)
    sh = _arrays.each(
        None, (n * n,),
        lambda c, r, p, g, sh: lib.lmp_sphere_project_gradient(n, c[0], r[0], p[0], sh, g),
        ("center", centers, 1, "lmp_vec3 *"), ("radius", radii, 0, "float *"),
        ("point", places, 1, "lmp_vec3 *"), ("gradient", gradient, 2, "float *"))
    return sh, gradient


def _list_of(center: ArrayLike, radius: ArrayLike, radiance: ArrayLike) -> tuple:
    """The arrays of a list of spheres, and their number."""
    centers, radii = _arrays.points("center", center), _radii(radius)
    colors = _arrays.colors("radiance", radiance)
    _arrays.finite("center", centers)
    shape = _arrays.common_shape(("center", centers, 1), ("radius", radii, 0),
                                 ("radiance", colors, 1))
    if len(shape) > 1:
        raise ValueError(f"spheres must be a list of them, not of the shape {shape}")
    shape = shape or (1,)
    return centers, radii, colors, shape


def project_all(bands: int, center: ArrayLike, radius: ArrayLike, point: ArrayLike, *,
                out: NDArray | None = None) -> NDArray[np.float32]:
    """Project every one of S spheres of unit radiance, as `project` does, at every point.

    Parameters
    ----------
    center : array_like, (S, 3)
    radius : array_like, (S,) or ()
    point : array_like, (…, 3)

    Returns
    -------
    ndarray of float32, (…, S, n²)
    """
    n, places = _core.bands(bands), _arrays.points("point", point)
    centers, radii, _, spheres = _list_of(center, radius, _white)
    shape = places.shape[:-1]
    result = _arrays.Result(out, shape + spheres + (n * n,), [centers, radii, places])
    keep: list = []
    lib.lmp_sphere_project_all_n(n, _spheres(centers, radii, _white, spheres, keep), spheres[0],
                                 _arrays.vec3_array(places, shape, keep), math.prod(shape),
                                 result.sh())
    return result.finish()


def visibilities(visibility: ArrayLike | None, lights: int, shape: tuple[int, ...],
                 keep: list) -> Any:
    """Visibility, broadcast to (lights, *shape), as C takes it."""
    if visibility is None:
        return ffi.NULL
    array = _arrays.numbers("visibility", visibility)
    try:
        array = np.ascontiguousarray(np.broadcast_to(array, (lights,) + shape))
    except ValueError:
        raise ValueError(f"visibility must broadcast to {(lights,) + shape}, "
                         f"not be of the shape {array.shape}") from None
    keep.append(array)
    return _arrays.pointer(array, "float *")


_of_thread = threading.local()


def scratch() -> Any:
    """Memory that makes sums of many bands faster, of each thread its own."""
    try:
        return _of_thread.scratch
    except AttributeError:
        size, alignment = _core.constants.SCRATCH_SIZE, _core.constants.SCRATCH_ALIGNMENT
        _of_thread.memory = np.empty(size + alignment, np.uint8)
        start = int(ffi.cast("uintptr_t", _arrays.pointer(_of_thread.memory)))
        _of_thread.scratch = ffi.new(
            "lmp_scratch *", (ffi.cast("void *", start + -start % alignment), size))
        return _of_thread.scratch


def sum(bands: int, center: ArrayLike, radius: ArrayLike, radiance: ArrayLike, point: ArrayLike, *,
        visibility: ArrayLike | None = None, out: NDArray | None = None) -> NDArray[np.float32]:
    """Sum the same S spheres at many points.

    Parameters
    ----------
    center : array_like, (S, 3)
    radius : array_like, (S,) or ()
    radiance : array_like, (S, 3) or (3,)
    point : array_like, (…, 3)
    visibility : array_like, (S, …), optional
        The fraction 0 … 1 of the light of each sphere that reaches each point.
    out : ndarray of float32, (…, 3, n²), optional

    Returns
    -------
    ndarray of float32, (…, 3, n²)
        Red, green, blue.
    """
    n, places = _core.bands(bands), _arrays.points("point", point)
    centers, radii, colors, spheres = _list_of(center, radius, radiance)
    shape = places.shape[:-1]
    result = _arrays.Result(out, shape + (3, n * n), [centers, radii, colors, places])
    keep: list = []
    lib.lmp_sphere_sum_n(scratch(), n, _spheres(centers, radii, colors, spheres, keep),
                         spheres[0], visibilities(visibility, spheres[0], shape, keep),
                         _arrays.vec3_array(places, shape, keep), math.prod(shape), result.sh(2))
    return result.finish()


def sum_gradient(bands: int, center: ArrayLike, radius: ArrayLike, radiance: ArrayLike,
                 point: ArrayLike) -> tuple[NDArray, NDArray]:
    """Sum spheres as `sum` does, and differentiate the sums with respect to the point.

    Returns
    -------
    sh : ndarray of float32, (…, 3, n²)
    gradient : ndarray of float32, (…, 3, 3, n²)
        d/dx of red, green, blue, then d/dy, then d/dz.
    """
    n, places = _core.bands(bands), _arrays.points("point", point)
    centers, radii, colors, spheres = _list_of(center, radius, radiance)
    shape = places.shape[:-1]
    result = _arrays.Result(None, shape + (3, n * n), [])
    gradient = _arrays.Result(None, shape + (3, 3, n * n), [])
    keep: list = []
    lib.lmp_sphere_sum_gradient_n(scratch(), n,
                                  _spheres(centers, radii, colors, spheres, keep), spheres[0],
                                  _arrays.vec3_array(places, shape, keep), math.prod(shape),
                                  result.sh(2), gradient.sh(3))
    return result.finish(), gradient.finish()


# --- units ------------------------------------------------------------------------------------


def _convert(function: Any, name: str, value: ArrayLike, radius: ArrayLike) -> NDArray:
    values = _arrays.finite(name, _arrays.numbers(name, value))
    radii = _arrays.numbers("radius", radius)
    if not (np.isfinite(radii).all() and (radii > 0).all()):
        raise ValueError("radius must be above 0")

    def call(value: Any, radius: Any, result: Any) -> None:
        result[0] = function(value[0], radius[0])

    return _arrays.each(None, (), call, (name, values, 0, "float *"),
                        ("radius", radii, 0, "float *"))


def power_from_radiance(radiance: ArrayLike, radius: ArrayLike) -> NDArray:
    """Power of a sphere, 4 pi² r² L; radius above 0."""
    return _convert(lib.lmp_sphere_power_from_radiance, "radiance", radiance, radius)


def radiance_from_power(power: ArrayLike, radius: ArrayLike) -> NDArray:
    """Radiance of a sphere of this power; radius above 0."""
    return _convert(lib.lmp_sphere_radiance_from_power, "power", power, radius)


def intensity_from_radiance(radiance: ArrayLike, radius: ArrayLike) -> NDArray:
    """Intensity of a sphere, pi r² L; radius above 0."""
    return _convert(lib.lmp_sphere_intensity_from_radiance, "radiance", radiance, radius)


def radiance_from_intensity(intensity: ArrayLike, radius: ArrayLike) -> NDArray:
    """Radiance of a sphere of this intensity; radius above 0."""
    return _convert(lib.lmp_sphere_radiance_from_intensity, "intensity", intensity, radius)
