# SPDX-License-Identifier: MIT
"""Fields: the light of thousands of lights at the nodes of a grid, read at any point
(lampion/field.h)."""
from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core, _host
from . import light as _light
from ._core import constants, ffi, lib
from .material import Material
from .shade import Surfaces, settings

__all__ = ["Field", "CoarserLevel"]


class Field(_host.Stored):
    """A field. Any number of threads may read it at once, as long as none changes it.

    Parameters
    ----------
    bands : int
        1 … 10; 0 means 5.
    nodes : int, or three of int
        Along x, y, z, 2 … 1024 each, at most 2^24 in all; 0 means 16.
    origin, cell : array_like, (3,) or ()
        Position of the first node, and the distance between nodes; 0 means 1.
    light_max : int
        The number of lights it has room for, 1 … 65536; 0 means 1024.
    error : float
        The largest error of a light's coefficients, 1e-5 … 1; 0 means 0.05.
    reach : float
        The distance from a light's surface within which it fades out, in longest cell edges,
        1 … 64; if it is given, `error` is ignored.
    """

    __slots__ = ()
    _ctype, _destroy = "lmp_field", lib.lmp_field_destroy
    _read, _size, _write = lib.lmp_field_read, lib.lmp_field_size, lib.lmp_field_write

    def __init__(self, bands: int = 0, *, nodes: int | tuple[int, int, int] = 0,
                 origin: ArrayLike = 0, cell: ArrayLike = 0, light_max: int = 0,
                 error: float = 0, reach: float = 0):
        desc = ffi.new("lmp_field_desc *")
        desc.bands = _core.integer_or_0("bands", bands, 1, constants.FIELD_BANDS_MAX)
        along = nodes if isinstance(nodes, (tuple, list)) else (nodes,) * 3
        if len(along) != 3:
            raise ValueError("nodes must be a number or three numbers")
        desc.nodes = [_core.integer_or_0("nodes", n, 2, constants.FIELD_NODES_MAX) for n in along]
        for name, value in (("origin", origin), ("cell", cell)):
            array = _arrays.finite(name, _arrays.numbers(name, value))
            if array.shape not in ((), (3,)):
                raise ValueError(f"{name} must have the shape (3,), not {array.shape}")
            setattr(desc, name, tuple(np.broadcast_to(array, 3).tolist()))
        desc.light_max = _core.integer_or_0("light_max", light_max, 1,
                                                     constants.FIELD_LIGHTS_MAX)
        desc.error = _core.number_or_0("error", error, 1e-5, 1)
        desc.reach = _core.number_or_0("reach", reach, 1, 64)
        self._create(lambda host, field: lib.lmp_field_create(host, desc, field))

    def describe(self) -> SimpleNamespace:
        """Its desc with the defaults filled in, reach, light_count, node_bytes and bytes."""
        return _core.record(lib.lmp_field_describe(self._c))

    def lights(self) -> NDArray:
        """A copy of its lights, in order."""
        count = lib.lmp_field_describe(self._c).light_count
        return _core.view(self, lib.lmp_field_lights(self._c), (count,), _light.dtype).copy()

    # --- changing it --------------------------------------------------------------------------

    def _fitting(self, lights: Any, others: int = 0) -> NDArray:
        """Lights for which there is room beside `others`, and none of which is an area."""
        listed, room = _light.as_lights(lights, areas=False), self.describe().desc.light_max
        if others + listed.size > room:
            raise ValueError(f"lights must be at most {room}, the field's light_max, "
                             f"not {others + listed.size}")
        return listed

    def update(self, lights: Any, *, threads: int = 1) -> None:
        """Replace all lights, none of which may be an area, and recompute every node."""
        listed, host = self._fitting(lights), _host.Host(threads)
        host.check(lib.lmp_field_update(host.c, self._c, _light.pointer(listed), listed.size))

    def reset(self, lights: Any) -> None:
        """Replace all lights and compute nothing: `want` says where, `compute` does."""
        listed = self._fitting(lights)
        _core.check(lib.lmp_field_reset(self._c, _light.pointer(listed), listed.size))

    def want(self, points: ArrayLike) -> None:
        """Mark the nodes around points (…, 3), to be computed."""
        places = _arrays.points("points", points)
        keep: list = []
        lib.lmp_field_want_n(self._c, _arrays.vec3_array(places, places.shape[:-1], keep),
                             places.size // 3)

    def compute(self, *, threads: int = 1) -> None:
        """Compute the nodes that are marked and not computed yet. Until then, read the field
        elsewhere only."""
        host = _host.Host(threads)
        host.check(lib.lmp_field_compute(host.c, self._c))

    def _indices(self, at: ArrayLike) -> NDArray[np.uintp]:
        count = lib.lmp_field_describe(self._c).light_count
        return np.ascontiguousarray(_arrays.indices("at", at, count).reshape(-1))

    def move(self, at: ArrayLike, lights: Any, *, threads: int = 1) -> None:
        """Replace light at[i] with lights[i]; all of `at` (k,) are different."""
        indices, listed = self._indices(at), _light.as_lights(lights, areas=False)
        if len(np.unique(indices)) != len(indices):
            raise ValueError("at must be different lights")
        if len(indices) != listed.size:
            raise ValueError(f"at and lights must be as many, not {len(indices)} and {listed.size}")
        host = _host.Host(threads)
        lib.lmp_field_move_n(host.c, self._c, ffi.from_buffer("size_t[]", indices),
                             _light.pointer(listed), listed.size)
        host.check(lib.LMP_OK)

    def add(self, light: Any) -> None:
        """Add one light, at the end."""
        one, host = _light.single(light), _host.Host()
        listed = self._fitting(one, self.describe().light_count)
        host.check(lib.lmp_field_add(host.c, self._c, _light.pointer(listed)))

    def remove(self, at: int) -> None:
        """Remove a light; the last one takes over its index."""
        index = int(self._indices([_core.integer("at", at, 0, constants.FIELD_LIGHTS_MAX)])[0])
        host = _host.Host()
        lib.lmp_field_remove(host.c, self._c, index)
        host.check(lib.LMP_OK)

    # --- reading it ---------------------------------------------------------------------------

    def eval(self, points: ArrayLike, *, out: NDArray | None = None) -> NDArray[np.float32]:
        """Coefficients (…, 3, n²) at points (…, 3), red, green, blue."""
        places = _arrays.points("points", points)
        shape, n = places.shape[:-1], lib.lmp_field_describe(self._c).desc.bands
        result = _arrays.Result(out, shape + (3, n * n), [places])
        keep: list = []
        lib.lmp_field_eval_n(self._c, _arrays.vec3_array(places, shape, keep), math.prod(shape),
                             result.sh(2))
        return result.finish()

    def eval_lobe(self, factors: ArrayLike, axis: ArrayLike, points: ArrayLike, *,
                  out: NDArray | None = None) -> NDArray[np.float32]:
        """Responses (…, 3) of a lobe (n,) around axes (…, 3), unit, at points (…, 3), as
        `lobe.response` computes them."""
        scales = _arrays.numbers("factors", factors)
        n = lib.lmp_field_describe(self._c).desc.bands
        if scales.shape != (n,):
            raise ValueError(f"factors must have the shape ({n},), not {scales.shape}")
        scales = np.ascontiguousarray(scales)
        axes, places = _arrays.directions("axis", axis), _arrays.points("points", points)
        shape = _arrays.common_shape(("axis", axes, 1), ("points", places, 1))
        result = _arrays.Result(out, shape + (3,), [axes, places])
        keep: list = []
        lib.lmp_field_eval_lobe_n(self._c, ffi.from_buffer("float[]", scales),
                                  _arrays.vec3_array(axes, shape, keep),
                                  _arrays.vec3_array(places, shape, keep), math.prod(shape),
                                  result.rgb())
        return result.finish()

    def shade(self, material: Material, position: ArrayLike, normal: ArrayLike, view: ArrayLike, *,
              tangent: ArrayLike | None = None, coat_normal: ArrayLike | None = None,
              window: str | int = "none", window_size: float = 0,
              out: NDArray | None = None) -> NDArray[np.float32]:
        """Radiance (…, 3) that surfaces reflect under the field's lights; the parameters are those
        of `shade.shade`."""
        used = settings(window=window, window_size=window_size)
        surfaces = Surfaces(material, position, normal, view, tangent, coat_normal)
        result = _arrays.Result(out, surfaces.shape + (3,), surfaces.reads)
        lib.lmp_field_shade_n(used, self._c, surfaces.c, surfaces.count, result.rgb())
        return result.finish()

    def find_near(self, point: ArrayLike) -> tuple[NDArray[np.uint32], NDArray[np.float32]]:
        """Indices of the lights near a point (3,), ascending, and the fraction of each, in (0, 1],
        that the field does not hold there."""
        place = _arrays.finite("point", _arrays.points("point", point))
        if place.ndim != 1:
            raise ValueError(f"point must have the shape (3,), not {place.shape}")
        where = tuple(place.tolist())
        count = lib.lmp_field_find_near(self._c, where, 0, ffi.NULL, ffi.NULL)
        lights, fractions = np.empty(count, np.uint32), np.empty(count, np.float32)
        lib.lmp_field_find_near(self._c, where, count, ffi.from_buffer("uint32_t[]", lights),
                                ffi.from_buffer("float[]", fractions))
        return lights, fractions

    # --- for shaders --------------------------------------------------------------------------

    def copy_nodes(self, first: int, count: int) -> NDArray[np.float32]:
        """Texels (count, 3 n², 4) of computed nodes, x varying fastest, then y, z: a coefficient of
        red, green or blue and its derivatives. May change in a minor version."""
        info = lib.lmp_field_describe(self._c)
        total = math.prod(info.desc.nodes)
        first = _core.integer("first", first, 0, total)
        count = _core.integer("count", count, 0, total - first)
        texels = np.empty((count, 3 * info.desc.bands ** 2, 4), np.float32)
        lib.lmp_field_copy_nodes(self._c, first, count, ffi.from_buffer("float[]", texels))
        return texels

    def copy_lists(self) -> tuple[NDArray[np.uint32], NDArray[np.uint32]]:
        """The lists of near lights, of blocks of 2 x 2 x 2 cells and then of those near everywhere:
        list i is lights[begin[i]:begin[i + 1]]. May change in a minor version."""
        nodes = lib.lmp_field_describe(self._c).desc.nodes
        blocks = math.prod(n // 2 for n in nodes)
        count = lib.lmp_field_copy_lists(self._c, 0, ffi.NULL, ffi.NULL)
        begin, lights = np.zeros(blocks + 2, np.uint32), np.empty(max(count, 1), np.uint32)
        lib.lmp_field_copy_lists(self._c, len(lights), ffi.from_buffer("uint32_t[]", begin),
                                 ffi.from_buffer("uint32_t[]", lights))
        return begin, lights[:count]

    def coarser_level(self) -> CoarserLevel | None:
        """The coarser field from which a field of 2048 nodes or more is made, or None. May change
        in a minor version."""
        found = lib.lmp_field_coarser_level(self._c)
        return CoarserLevel(self, found) if found else None


class CoarserLevel:
    """A field that belongs to another one: only describe and read it."""

    def __init__(self, owner: Field, pointer: Any):
        self._owner = owner  # which keeps it alive
        self._c = pointer

    describe = Field.describe
    lights = Field.lights
    eval = Field.eval
    copy_nodes = Field.copy_nodes
    copy_lists = Field.copy_lists
