# SPDX-License-Identifier: MIT
"""Lights of every kind, and their exact projection onto spherical harmonics (lampion/light.h).

Lights are NumPy arrays of the type `dtype`, the library's own structure; members that a kind does
not have are 0. The functions named after a kind make them, many at once where their arguments are
arrays; `join` makes one list of several arrays. Colors are (…, 3), or a number for gray. Angles are
in radians, lengths in one unit of your choice.
"""
from __future__ import annotations

import functools
import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core
from ._core import constants, ffi, lib
from .sphere import scratch, visibilities

__all__ = ["Kind", "dtype", "sphere", "point", "spot", "directional", "cap", "hemisphere",
           "rectangle", "disk", "tube", "polygon", "join", "find_cap", "project_zonal",
           "project_gradient", "project", "add", "irradiance", "range", "copy_area_texels",
           "cap_irradiance_from_radiance", "cap_radiance_from_irradiance", "power_from_radiance",
           "radiance_from_power", "intensity_from_radiance", "radiance_from_intensity"]

Kind = _core.enumeration("Kind", "lmp_light_kind", __name__)

#: The type of a light, of the same layout as lmp_light. ``radiance`` is also the intensity or the
#: irradiance of the kinds that have these, and ``corner`` begins with what C calls ``half``.
dtype = _core.dtype_of("lmp_light")

_directed = [Kind.SPOT, Kind.DIRECTIONAL, Kind.CAP, Kind.HEMISPHERE, Kind.DISK]
_placed = [Kind.SPHERE, Kind.POINT, Kind.SPOT, Kind.RECTANGLE, Kind.DISK, Kind.TUBE, Kind.POLYGON]
_areas = [Kind.RECTANGLE, Kind.DISK, Kind.TUBE, Kind.POLYGON]
_corners = (constants.LIGHT_CORNERS_MAX, 3)


# --- making lights ----------------------------------------------------------------------------


def _make(kind: int, **members: tuple[ArrayLike, tuple[int, ...]]) -> NDArray:
    """Lights of a kind; of each member its value and core shape."""
    arrays = {name: _arrays.numbers(name, value, core) for name, (value, core) in members.items()}
    shape = _arrays.common_shape(*[(name, arrays[name], len(core))
                                   for name, (_, core) in members.items()])
    lights = np.zeros(shape, dtype)
    lights["kind"] = kind
    for name, array in arrays.items():
        lights[name][...] = array
    check(lights)
    return lights


def _color(name: str, value: ArrayLike) -> tuple[NDArray, tuple[int, ...]]:
    """A member that is a color."""
    return _arrays.colors(name, value), (3,)


def _padded(corners: NDArray) -> NDArray:
    """Corners (…, k, 3) as the structure has room for them."""
    padded = np.zeros(corners.shape[:-2] + _corners, np.float32)
    padded[..., :corners.shape[-2], :] = corners
    return padded


def sphere(position: ArrayLike, radius: ArrayLike, radiance: ArrayLike) -> NDArray:
    """Spheres: position (…, 3), radius (…) >= 0, radiance (…, 3), W·sr⁻¹·m⁻²."""
    return _make(Kind.SPHERE, position=(position, (3,)), radius=(radius, ()),
                 radiance=_color("radiance", radiance))


def point(position: ArrayLike, intensity: ArrayLike) -> NDArray:
    """Points: position (…, 3), intensity (…, 3), W·sr⁻¹."""
    return _make(Kind.POINT, position=(position, (3,)), radiance=_color("intensity", intensity))


def spot(position: ArrayLike, direction: ArrayLike, inner: ArrayLike, outer: ArrayLike,
         intensity: ArrayLike) -> NDArray:
    """Spots: position and direction (…, 3), unit and from the light, half angles 0 <= inner <=
    outer <= pi (…), intensity (…, 3), W·sr⁻¹."""
    return _make(Kind.SPOT, position=(position, (3,)), direction=(direction, (3,)),
                 inner=(inner, ()), outer=(outer, ()), radiance=_color("intensity", intensity))


def directional(direction: ArrayLike, irradiance: ArrayLike) -> NDArray:
    """Directional lights: direction (…, 3), unit and to the light, irradiance (…, 3), W·m⁻²."""
    return _make(Kind.DIRECTIONAL, direction=(direction, (3,)),
                 radiance=_color("irradiance", irradiance))


def cap(direction: ArrayLike, angle: ArrayLike, radiance: ArrayLike) -> NDArray:
    """Caps, such as a sun: direction (…, 3), unit and to the light, half angle 0 … pi (…),
    radiance (…, 3)."""
    return _make(Kind.CAP, direction=(direction, (3,)), angle=(angle, ()),
                 radiance=_color("radiance", radiance))


def hemisphere(direction: ArrayLike, radiance: ArrayLike, ground: ArrayLike) -> NDArray:
    """Skies: direction (…, 3), unit and up, radiance above and `ground` below (…, 3)."""
    return _make(Kind.HEMISPHERE, direction=(direction, (3,)),
                 radiance=_color("radiance", radiance), ground=_color("ground", ground))


def rectangle(position: ArrayLike, half: ArrayLike, radiance: ArrayLike,
              two_sided: ArrayLike = False) -> NDArray:
    """Rectangles: center (…, 3), half (…, 2, 3) from it to the middles of two adjacent sides,
    radiance (…, 3). The normal, to the side that shines, is that of half[0] × half[1]."""
    return _make(Kind.RECTANGLE, position=(position, (3,)),
                 corner=(_padded(_arrays.numbers("half", half, (2, 3))), _corners),
                 radiance=_color("radiance", radiance), two_sided=(two_sided, ()))


def disk(position: ArrayLike, direction: ArrayLike, radius: ArrayLike, radiance: ArrayLike,
         two_sided: ArrayLike = False) -> NDArray:
    """Disks: center (…, 3), direction (…, 3) of the normal, unit, radius (…), radiance (…, 3)."""
    return _make(Kind.DISK, position=(position, (3,)), direction=(direction, (3,)),
                 radius=(radius, ()), radiance=_color("radiance", radiance),
                 two_sided=(two_sided, ()))


def tube(position: ArrayLike, half: ArrayLike, radius: ArrayLike, radiance: ArrayLike) -> NDArray:
    """Tubes with round ends: center (…, 3), half (…, 3) from it to an end of the axis, radius (…),
    radiance (…, 3)."""
    axis = _arrays.numbers("half", half, (3,))[..., np.newaxis, :]
    return _make(Kind.TUBE, position=(position, (3,)), corner=(_padded(axis), _corners),
                 radius=(radius, ()),
                 radiance=_color("radiance", radiance))


def polygon(position: ArrayLike, corner: ArrayLike, radiance: ArrayLike,
            two_sided: ArrayLike = False) -> NDArray:
    """Polygons: position (…, 3), 3 … 8 corners (…, k, 3) relative to it, in a plane and
    counter-clockwise as seen from the side that shines, radiance (…, 3)."""
    corners = _arrays.numbers("corner", corner, (None, 3))
    count = _core.integer("the number of corners", corners.shape[-2], 3, _corners[0])
    return _make(Kind.POLYGON, position=(position, (3,)), corner=(_padded(corners), _corners),
                 radiance=_color("radiance", radiance), two_sided=(two_sided, ()),
                 corner_count=(count, ()))


def join(*lights: ArrayLike) -> NDArray:
    """One list of all lights of several arrays."""
    return as_lights(list(lights))


# --- checks -----------------------------------------------------------------------------------


def _are_flat(corners: NDArray, count: NDArray) -> bool:
    """Whether the first `count` corners of each polygon lie in a plane, to a thousandth of its
    size."""
    used = np.arange(_corners[0]) < count[..., np.newaxis]
    away = np.where(used[..., np.newaxis], corners - corners[..., :1, :], 0).astype(float)
    normal = np.cross(away, np.roll(away, -1, axis=-2)).sum(axis=-2, keepdims=True)
    height = np.abs((away * normal).sum(axis=-1)).max(axis=-1)
    size = np.linalg.norm(away, axis=-1).max(axis=-1)
    return bool((height <= 1e-3 * size * np.linalg.norm(normal[..., 0, :], axis=-1)).all())


def check(lights: NDArray) -> None:
    """Raise ValueError for the first member of a light that is outside its range."""
    kind = lights["kind"]
    if lights.size and not kind.max() < constants.LIGHT_KIND_COUNT:
        raise ValueError(f"kind must be one of {', '.join(k.name.lower() for k in Kind)}")

    def of(kinds: list, member: str) -> NDArray:
        return lights[member][np.isin(kind, kinds)]

    for member in ("radiance", "ground"):
        _arrays.finite(member, lights[member])
    _arrays.within("position", of(_placed, "position"), -constants.LENGTH_MAX, constants.LENGTH_MAX)
    _arrays.unit("direction", of(_directed, "direction"))
    _arrays.within("radius", of([Kind.SPHERE, Kind.DISK, Kind.TUBE], "radius"), 0,
                   constants.LENGTH_MAX)
    straight = float(np.float32(math.pi))
    _arrays.within("angle", of([Kind.CAP], "angle"), 0, straight)
    inner, outer = of([Kind.SPOT], "inner"), of([Kind.SPOT], "outer")
    _arrays.within("inner", inner, 0, straight)
    _arrays.within("outer", outer, 0, straight)
    if not (inner <= outer).all():
        raise ValueError("inner must be at most outer")
    _arrays.finite("half", of([Kind.RECTANGLE], "corner")[..., :2, :])
    _arrays.finite("half", of([Kind.TUBE], "corner")[..., 0, :])
    count = of([Kind.POLYGON], "corner_count")
    if not ((count >= 3) & (count <= constants.LIGHT_CORNERS_MAX)).all():
        raise ValueError(f"corner_count must be 3 … {constants.LIGHT_CORNERS_MAX}")
    corners = _arrays.finite("corner", of([Kind.POLYGON], "corner"))
    if corners.size and not _are_flat(corners, count):
        raise ValueError("corner must lie in a plane")


@functools.lru_cache(maxsize=64)
def _check_bytes(data: bytes) -> None:
    check(np.frombuffer(data, dtype))


def as_lights(lights: Any, *, areas: bool = True) -> NDArray:
    """A checked, contiguous list of lights: an array of `dtype`, or a sequence of such arrays."""
    if isinstance(lights, (list, tuple)):
        parts = [as_lights(part) for part in lights]
        lights = np.concatenate(parts) if parts else np.empty(0, dtype)
    if not isinstance(lights, (np.ndarray, np.void)) or lights.dtype != dtype:
        raise TypeError("lights must be made by the functions of lampion.light")
    array = np.ascontiguousarray(lights).reshape(-1)
    if array.nbytes <= 1 << 14:
        _check_bytes(array.tobytes())  # programs light many batches by the same few lights
    else:
        check(array)
    if not areas and np.isin(array["kind"], _areas).any():
        raise ValueError("lights must not be areas here")
    return array


def pointer(lights: NDArray) -> Any:
    """Lights of `as_lights`, as C takes them."""
    return _arrays.pointer(lights, "lmp_light *")


def single(light: Any, areas: bool = True) -> NDArray:
    """One checked light."""
    array = as_lights(light, areas=areas)
    if array.size != 1:
        raise ValueError(f"light must be a single one, not {array.size}")
    return array


def _one_area(area: Any) -> NDArray:
    array = single(area)
    if not np.isin(array["kind"], _areas).all():
        raise ValueError("light must be an area")
    return array


# --- any light --------------------------------------------------------------------------------


def find_cap(light: Any, point: ArrayLike) -> NDArray:
    """The cap of one light, which is not an area, as seen from points (…, 3): an array (…) with the
    members axis, sin2, one_minus_cos, strength and ambient of lmp_cap."""
    one, places = single(light, areas=False), _arrays.points("point", point)
    return _arrays.each(None, (), lambda p, cap: lib.lmp_light_find_cap(pointer(one), p[0], cap),
                        ("point", places, 1, "lmp_vec3 *"), dtype=_core.dtype_of("lmp_cap"),
                        ctype="lmp_cap *")


def project_zonal(bands: int, light: Any, point: ArrayLike) -> tuple[NDArray, NDArray]:
    """Zonal coefficients (…, n) at points (…, 3) of one light of unit strength, which is not an
    area, and their axes (…, 3), to the light."""
    n, one, places = _core.bands(bands), single(light, areas=False), _arrays.points("point", point)
    axis = np.empty(places.shape, np.float32)
    zonal = _arrays.each(
        None, (n,),
        lambda p, a, z: lib.lmp_light_project_zonal(n, pointer(one), p[0], z, a),
        ("point", places, 1, "lmp_vec3 *"), ("axis", axis, 1, "lmp_vec3 *"))
    return zonal, axis


def project_gradient(bands: int, light: Any, point: ArrayLike) -> tuple[NDArray, NDArray]:
    """Coefficients (…, n²) at points (…, 3) of one light of unit strength, and their derivatives
    (…, 3, n²) with respect to the point: d/dx, d/dy, d/dz."""
    n, one, places = _core.bands(bands), single(light), _arrays.points("point", point)
    gradient = np.empty(places.shape[:-1] + (3, n * n), np.float32)
    sh = _arrays.each(
        None, (n * n,),
        lambda p, g, sh: lib.lmp_light_project_gradient(n, pointer(one), p[0], sh, g),
        ("point", places, 1, "lmp_vec3 *"), ("gradient", gradient, 2, "float *"))
    return sh, gradient


def _sum(function: Any, bands: int, lights: Any, point: ArrayLike, visibility: ArrayLike | None,
         result: _arrays.Result, listed: NDArray, places: NDArray) -> NDArray:
    keep: list = []
    shape = places.shape[:-1]
    function(scratch(), bands, pointer(listed), listed.size,
             visibilities(visibility, listed.size, shape, keep),
             _arrays.vec3_array(places, shape, keep), math.prod(shape), result.sh(2))
    return result.finish()


def project(bands: int, lights: Any, point: ArrayLike, *, visibility: ArrayLike | None = None,
            out: NDArray | None = None) -> NDArray[np.float32]:
    """Project the sum of lights at points.

    Parameters
    ----------
    bands : int
    lights : array of `dtype`, or a sequence of such arrays
    point : array_like, (…, 3)
    visibility : array_like, (lights, …), optional
        The fraction 0 … 1 of each light that reaches each point.
    out : ndarray of float32, (…, 3, n²), optional

    Returns
    -------
    ndarray of float32, (…, 3, n²)
        Red, green, blue.
    """
    n, listed, places = _core.bands(bands), as_lights(lights), _arrays.points("point", point)
    result = _arrays.Result(out, places.shape[:-1] + (3, n * n), [places])
    return _sum(lib.lmp_light_project_n, n, lights, point, visibility, result, listed, places)


def add(bands: int, lights: Any, point: ArrayLike, sh: NDArray, *,
        visibility: ArrayLike | None = None) -> NDArray[np.float32]:
    """Add lights to the coefficients `sh` (…, 3, n²) of `project`, in place, for example when they
    are switched on. Lights with negated colors are removed, up to rounding."""
    n, listed, places = _core.bands(bands), as_lights(lights), _arrays.points("point", point)
    result = _arrays.Result(sh, places.shape[:-1] + (3, n * n), [places], name="sh")
    result.sh(2)  # which decides where it is written
    if result.target is not sh:
        np.copyto(result.target, sh)
    return _sum(lib.lmp_light_add_n, n, lights, point, visibility, result, listed, places)


def irradiance(lights: Any, point: ArrayLike, normal: ArrayLike, *,
               out: NDArray | None = None) -> NDArray[np.float32]:
    """Irradiance (…, 3), W·m⁻², of the sum of lights at points (…, 3) of surfaces with unit normals
    (…, 3): a closed form, exact to 1e-6, also where the horizon cuts a light."""
    listed, places = as_lights(lights), _arrays.points("point", point)
    normals = _arrays.directions("normal", normal)

    def call(place: Any, normal: Any, rgb: Any) -> None:
        rgb[0] = lib.lmp_light_irradiance(pointer(listed), listed.size, place[0], normal[0])

    return _arrays.each(out, (3,), call, ("point", places, 1, "lmp_vec3 *"),
                        ("normal", normals, 1, "lmp_vec3 *"), ctype="lmp_rgb *")


def range(light: Any, irradiance: float) -> float:
    """The distance beyond which one light gives any surface at most this irradiance, above 0, in
    every channel; 0 if it never gives more, infinity if it does everywhere."""
    return lib.lmp_light_range(pointer(single(light)), _core.number("irradiance", irradiance, 1e-45))


def copy_area_texels(area: Any) -> NDArray[np.float32]:
    """Texels (11, 4) by which area.glsl lights with one area."""
    one = _one_area(area)
    texels = np.empty((constants.AREA_TEXELS, 4), np.float32)
    lib.lmp_light_copy_area_texels(pointer(one), ffi.from_buffer("float[]", texels))
    return texels


# --- units ------------------------------------------------------------------------------------


def _cap_unit(function: Any, name: str, value: float, angle: float) -> float:
    return function(_core.number(name, value), _core.number("angle", angle, 1e-30, math.pi / 2))


def cap_irradiance_from_radiance(radiance: float, angle: float) -> float:
    """Normal irradiance of a cap, pi sin²a L, 0 < a <= pi/2."""
    return _cap_unit(lib.lmp_light_cap_irradiance_from_radiance, "radiance", radiance, angle)


def cap_radiance_from_irradiance(irradiance: float, angle: float) -> float:
    """Radiance of a cap of this normal irradiance, 0 < a <= pi/2."""
    return _cap_unit(lib.lmp_light_cap_radiance_from_irradiance, "irradiance", irradiance, angle)


def _area_unit(function: Any, name: str, area: Any, value: float) -> float:
    one = _one_area(area)
    return function(pointer(one), _core.number(name, value))


def power_from_radiance(area: Any, radiance: float) -> float:
    """Power of an area, pi L times all of its surface that shines."""
    return _area_unit(lib.lmp_light_power_from_radiance, "radiance", area, radiance)


def radiance_from_power(area: Any, power: float) -> float:
    """Radiance of an area of this power."""
    return _area_unit(lib.lmp_light_radiance_from_power, "power", area, power)


def intensity_from_radiance(area: Any, radiance: float) -> float:
    """Largest intensity of an area, L times the largest area that it turns to any direction."""
    return _area_unit(lib.lmp_light_intensity_from_radiance, "radiance", area, radiance)


def radiance_from_intensity(area: Any, intensity: float) -> float:
    """Radiance of an area of this largest intensity."""
    return _area_unit(lib.lmp_light_radiance_from_intensity, "intensity", area, intensity)
