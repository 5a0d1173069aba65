# SPDX-License-Identifier: MIT
"""The radiance that surfaces reflect to the viewer under many lights (lampion/shade.h).

L_o = ∫ L(w) f_r(w, v) max(n·w, 0) dw, specular parts in n bands, clamped at 0. Visibility is not
considered.
"""
from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core
from . import preintegrated as _preintegrated
from ._core import constants, ffi, lib
from .light import as_lights, pointer
from .material import Material, dtype
from .sh import Window

__all__ = ["Method", "shade", "environment"]

Method = _core.enumeration("Method", "lmp_shade_method", __name__)


def settings(method: str | int = "zonal", bands: int = 0, window: str | int = "none",
             window_size: float = 0, lobe: _preintegrated.Lobe | None = None) -> Any:
    """lmp_shade_settings."""
    if lobe is not None and not isinstance(lobe, _preintegrated.Lobe):
        raise TypeError(f"lobe must be a lampion.preintegrated.Lobe, not {type(lobe).__name__}")
    return ffi.new("lmp_shade_settings *", (
        _core.choice("method", Method, method),
        _core.integer_or_0("bands", bands, 1, constants.BANDS_MAX),
        _core.choice("window", Window, window), _core.number("window_size", window_size, 0),
        lobe._c if lobe else ffi.NULL))


class Surfaces:
    """Arrays as lmp_surfaces, `c`, and the shape that they broadcast to."""

    def __init__(self, material: Any, position: ArrayLike, normal: ArrayLike, view: ArrayLike,
                 tangent: ArrayLike | None, coat_normal: ArrayLike | None):
        if not isinstance(material, Material):
            raise TypeError(f"material must be of lampion.material, not {type(material).__name__}")
        arrays = {"position": _arrays.points("position", position),
                  "normal": _arrays.directions("normal", normal),
                  "view": _arrays.directions("view", view)}
        if tangent is not None:
            arrays["tangent"] = _arrays.points("tangent", tangent)
        if coat_normal is not None:
            arrays["coat_normal"] = _arrays.directions("coat_normal", coat_normal)
        self.reads = list(arrays.values())
        self.shape = _arrays.common_shape(("material", material._data, 0),
                                          *[(name, array, 1) for name, array in arrays.items()])
        self.count = math.prod(self.shape)
        self.keep: list = [material]
        self.c = ffi.new("lmp_surfaces *")
        for name, array in arrays.items():
            setattr(self.c, name, _arrays.vec3_array(array, self.shape, self.keep))
        materials = material._data
        if materials.ndim:
            materials = np.ascontiguousarray(np.broadcast_to(materials, self.shape))
            self.c.material_stride = dtype.itemsize
        self.keep.append(materials)
        self.c.material = _arrays.pointer(materials, "lmp_material *")


def _check_lobe(used: Any, surfaces: Surfaces) -> None:
    """PREINTEGRATED reads the lobe for all but tables without a coat."""
    if used.method != Method.PREINTEGRATED or used.lobe:
        return
    material = surfaces.keep[0]._data
    if ((material["kind"] < 2) | (material["coat"]["weight"] != 0)).any():
        raise ValueError("lobe must be given for the method preintegrated, if a material has "
                         "lobes or a coat")


def shade(material: Material, position: ArrayLike, normal: ArrayLike, view: ArrayLike, lights: Any,
          *, tangent: ArrayLike | None = None, coat_normal: ArrayLike | None = None,
          method: str | int = "zonal", bands: int = 0, window: str | int = "none",
          window_size: float = 0, lobe: _preintegrated.Lobe | None = None,
          out: NDArray | None = None) -> NDArray[np.float32]:
    """Radiance that surfaces reflect.

    Parameters
    ----------
    material : Material
        One for all, or one for each surface.
    position, normal, view : array_like, (…, 3)
        Normals, and views to the viewer, are unit.
    lights : array of `light.dtype`, or a sequence of such arrays
    tangent : array_like, (…, 3), optional
        The x axis of an anisotropic table.
    coat_normal : array_like, (…, 3), optional
        Unit.
    method : str
        ``"zonal"``, whose diffuse parts are exact for any number of bands; ``"coefficients"``, the
        paper's, in n bands throughout; or ``"preintegrated"``, which tables without a preintegrated
        series take as ``"zonal"``.
    bands : int
        0 means 10; a table has no more than its own.
    window, window_size
        As in `sh.make_window`.
    lobe : preintegrated.Lobe, optional
        Of the method ``"preintegrated"``; its bands and window then apply.
    out : ndarray of float32, (…, 3), optional

    Returns
    -------
    ndarray of float32, (…, 3)
        W·sr⁻¹·m⁻².
    """
    used, listed = settings(method, bands, window, window_size, lobe), as_lights(lights)
    surfaces = Surfaces(material, position, normal, view, tangent, coat_normal)
    _check_lobe(used, surfaces)
    result = _arrays.Result(out, surfaces.shape + (3,), surfaces.reads)
    lib.lmp_shade_n(used, surfaces.c, surfaces.count, pointer(listed), listed.size, result.rgb())
    return result.finish()


def environment(material: Material, normal: ArrayLike, view: ArrayLike, sh: ArrayLike, *,
                tangent: ArrayLike | None = None, coat_normal: ArrayLike | None = None,
                method: str | int = "zonal", bands: int = 0, window: str | int = "none",
                window_size: float = 0, lobe: _preintegrated.Lobe | None = None,
                out: NDArray | None = None) -> NDArray[np.float32]:
    """Radiance (…, 3) that surfaces reflect from far surroundings, whose radiance has the
    coefficients `sh` (3, n²); the other parameters are those of `shade`."""
    used = settings(method, bands, window, window_size, lobe)
    n, c = _arrays.coefficients("sh", sh, (3,))
    if c.ndim != 2:
        raise ValueError(f"sh must have the shape (3, n²), not {c.shape}")
    c = np.ascontiguousarray(c)
    surfaces = Surfaces(material, np.zeros(3, np.float32), normal, view, tangent, coat_normal)
    _check_lobe(used, surfaces)
    result = _arrays.Result(out, surfaces.shape + (3,), surfaces.reads + [c])
    around = ffi.new("lmp_environment *", (ffi.from_buffer("float[]", c), n))
    lib.lmp_shade_environment_n(used, surfaces.c, surfaces.count, around, result.rgb())
    return result.finish()
