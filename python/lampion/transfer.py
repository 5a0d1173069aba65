# SPDX-License-Identifier: MIT
"""Light that bounces between surfaces that rest (lampion/transfer.h), by rays that you cast once.
All of it may change in a minor version.

Sources are counted from 0: first the surfels, then the patches of the sky; `NONE` is what a ray
hits that finds no light.
"""
from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core, _host
from ._core import constants, ffi, lib

__all__ = ["NONE", "Transfer"]

#: What a ray hits that finds no light, and a link that is not used.
NONE = constants.TRANSFER_NONE

_surfel = _core.dtype_of("lmp_transfer_surfel")


def _sources(name: str, value: ArrayLike, rows: int, most: int) -> NDArray[np.uint32]:
    """Indices (rows, columns) of sources, or NONE."""
    array = np.asarray(value)
    if array.size and array.dtype.kind not in "iu":
        raise TypeError(f"{name} must be integers, not {array.dtype}")
    if array.ndim != 2 or array.shape[0] != rows:
        raise ValueError(f"{name} must have the shape ({rows}, n), not {array.shape}")
    if array.size and not (array.min() >= 0 and
                           ((array < most) | (array == NONE)).all()):
        raise ValueError(f"{name} must be 0 … {most - 1} or NONE")
    return np.ascontiguousarray(array, np.uint32)


class Transfer(_core.Owner):
    """What rays between surfaces found.

    Parameters
    ----------
    position, normal : array_like, (S, 3)
        Of the surfels; normals are unit.
    albedo : array_like, (S, 3) or (3,)
        0 … 1.
    radius : array_like, (S,) or ()
        Of the points that read a surfel; about 1.5 times their spacing.
    hits : array_like of int, (S, rays)
        Sources, of rays distributed as the cosine around the normal.
    sky_count : int
        Number of patches of the sky.
    links : array_like of int, (S, links), optional
        Surfels near each surfel, on the same surface.
    probe_directions : array_like, (R, 3), optional
        Unit, uniform on the sphere.
    probe_hits : array_like of int, (probes, R), optional
    bands : int
        Of probes, 1 … 8; 0 means 3.
    """

    __slots__ = ()

    def __init__(self, position: ArrayLike, normal: ArrayLike, albedo: ArrayLike,
                 radius: ArrayLike, hits: ArrayLike, *, sky_count: int = 0,
                 links: ArrayLike | None = None, probe_directions: ArrayLike | None = None,
                 probe_hits: ArrayLike | None = None, bands: int = 0):
        places = _arrays.finite("position", _arrays.numbers("position", position, (3,)))
        if places.ndim != 2 or not 1 <= len(places) <= constants.TRANSFER_SOURCES_MAX:
            raise ValueError(f"position must have the shape (S, 3), not {places.shape}")
        surfels = np.zeros(len(places), _surfel)
        for name, array in (
                ("position", places), ("normal", _arrays.directions("normal", normal)),
                ("albedo", _arrays.within("albedo", _arrays.numbers("albedo", albedo), 0, 1)),
                ("radius", _arrays.within("radius", _arrays.numbers("radius", radius), 1e-37))):
            try:
                surfels[name] = array
            except ValueError:
                raise ValueError(f"{name} must broadcast to {surfels[name].shape}, "
                                 f"not {array.shape}") from None
        count = len(places)
        sources = count + _core.integer("sky_count", sky_count, 0,
                                        constants.TRANSFER_SOURCES_MAX - count)
        desc = ffi.new("lmp_transfer_desc *")
        keep: list = [surfels]

        def indices(name: str, value: ArrayLike, rows: int, most: int) -> tuple[Any, int]:
            array = _sources(name, value, rows, most)
            keep.append(array)
            return _arrays.pointer(array, "uint32_t *"), array.shape[1]

        desc.surfels = _arrays.pointer(surfels, "lmp_transfer_surfel *")
        desc.surfel_count, desc.sky_count = count, sources - count
        desc.hits, desc.ray_count = indices("hits", hits, count, sources)
        if links is not None:
            desc.links, desc.link_count = indices("links", links, count, count)
        if (probe_directions is None) != (probe_hits is None):
            raise ValueError("probe_directions and probe_hits must be given together")
        if probe_hits is not None:
            ways = np.ascontiguousarray(_arrays.directions("probe_directions", probe_directions))
            keep.append(ways)
            desc.probe_directions = _arrays.pointer(ways, "lmp_vec3 *")
            desc.probe_count = len(probe_hits)  # type: ignore[arg-type]
            desc.probe_hits, rays = indices("probe_hits", probe_hits, desc.probe_count, sources)
            if ways.shape != (rays, 3):
                raise ValueError(f"probe_directions must have the shape ({rays}, 3), "
                                 f"not {ways.shape}")
            desc.probe_ray_count = rays
        desc.bands = _core.integer_or_0("bands", bands, 1, constants.TRANSFER_BANDS_MAX)
        self._own(_host.created("lmp_transfer", lambda host, transfer:
                                lib.lmp_transfer_create(host, desc, transfer)),
                  lib.lmp_transfer_destroy)

    def describe(self) -> SimpleNamespace:
        """Its counts, bands, bytes, and the iterations and remainder of the last update."""
        return _core.record(lib.lmp_transfer_describe(self._c))

    def _light(self, name: str, value: ArrayLike | None, count: int, keep: list) -> Any:
        if value is None:
            return ffi.NULL
        array = _arrays.within(name, _arrays.numbers(name, value, (3,)), -1e28, 1e28)
        if array.shape not in ((3,), (count, 3)):
            raise ValueError(f"{name} must have the shape ({count}, 3), not {array.shape}")
        keep.append(np.ascontiguousarray(np.broadcast_to(array, (count, 3))))
        return _arrays.pointer(keep[-1], "lmp_rgb *")

    def update(self, direct: ArrayLike | None = None, *, emission: ArrayLike | None = None,
               sky: ArrayLike | None = None, iterations: int = 0, remainder: float = 0,
               budget: int = 0, threads: int = 1) -> None:
        """Compute the indirect irradiance of the surfels, beginning with the last update's.

        Parameters
        ----------
        direct : array_like, (S, 3), optional
            Irradiance of each surfel by lights, W·m⁻², with their shadows.
        emission : array_like, (S, 3), optional
            Radiance that each surfel emits.
        sky : array_like, (sky_count, 3), optional
            Radiance of each patch.
        iterations : int
            At most, 1 … 1000; 0 means 4.
        remainder : float
            Stops when `describe` has at most this, 0 … 1.
        budget : int
            Number of surfels that an iteration computes; 0 means all.
        """
        info = lib.lmp_transfer_describe(self._c)
        keep: list = []
        lighting = ffi.new("lmp_transfer_lighting *",
                           (self._light("direct", direct, info.surfel_count, keep),
                            self._light("emission", emission, info.surfel_count, keep),
                            self._light("sky", sky, info.sky_count, keep)))
        limits = ffi.new("lmp_transfer_settings *", (
            _core.integer_or_0("iterations", iterations, 1,
                                         constants.TRANSFER_ITERATIONS_MAX),
            _core.number("remainder", remainder, 0, 1),
            _core.integer("budget", budget, 0, constants.TRANSFER_SOURCES_MAX)))
        host = _host.Host(threads)
        host.check(lib.lmp_transfer_update(host.c, self._c, limits, lighting))

    def reset(self) -> None:
        """Forget all light."""
        lib.lmp_transfer_reset(self._c)

    def irradiance(self, surfel: ArrayLike, point: ArrayLike,
                   normal: ArrayLike) -> NDArray[np.float32]:
        """Indirect irradiance (…, 3), W·m⁻², at points (…, 3) of surfaces with normals (…, 3),
        unit, to which surfels (…) are the nearest."""
        count = lib.lmp_transfer_describe(self._c).surfel_count
        indices = _arrays.indices("surfel", surfel, count)

        def call(surfel: Any, point: Any, normal: Any, rgb: Any) -> None:
            rgb[0] = lib.lmp_transfer_irradiance(self._c, surfel[0], point[0], normal[0])

        return _arrays.each(None, (3,), call, ("surfel", indices, 0, "size_t *"),
                            ("point", _arrays.points("point", point), 1, "lmp_vec3 *"),
                            ("normal", _arrays.directions("normal", normal), 1, "lmp_vec3 *"),
                            ctype="lmp_rgb *")

    def _range(self, first: int, count: int | None, total: int) -> tuple[int, int]:
        first = _core.integer("first", first, 0, total)
        rest = total - first
        return first, rest if count is None else _core.integer("count", count, 0, rest)

    def copy_irradiance(self, first: int = 0, count: int | None = None, *,
                        out: NDArray | None = None) -> NDArray[np.float32]:
        """Indirect irradiance (count, 3) of surfels, by default of all."""
        first, count = self._range(first, count, lib.lmp_transfer_describe(self._c).surfel_count)
        result = _arrays.Result(out, (count, 3), [])
        lib.lmp_transfer_copy_irradiance_n(self._c, first, count, result.rgb())
        return result.finish()

    def eval_probe(self, first: int = 0, count: int | None = None, *,
                   out: NDArray | None = None) -> NDArray[np.float32]:
        """Coefficients (count, 3, n²) of the light that probes receive, by default of all."""
        info = lib.lmp_transfer_describe(self._c)
        first, count = self._range(first, count, info.probe_count)
        result = _arrays.Result(out, (count, 3, info.bands ** 2), [])
        lib.lmp_transfer_eval_probe_n(self._c, first, count, result.sh(2))
        return result.finish()
