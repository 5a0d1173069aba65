# SPDX-License-Identifier: MIT
"""What surfaces are made of: lobes, glTF's metallic-roughness or a table, and the layers over it
(lampion/material.h).

The functions named after a kind make materials, many where their arguments are arrays: one for each
surface, or a single one for all. Colors are linear.
"""
from __future__ import annotations

from typing import Any, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core
from . import brdf as _brdf
from . import preintegrated as _preintegrated
from ._core import constants, ffi, lib

__all__ = ["Kind", "dtype", "Material", "lobes", "metallic_roughness", "table", "preintegrated",
           "dielectric", "coat_reflectance"]

Kind = _core.enumeration("Kind", "lmp_material_kind", __name__)

#: The type of a material, of the same layout as lmp_material.
dtype = _core.dtype_of("lmp_material")


class Material:
    """One material, or an array of them; `shape` is () or the array's. It keeps its tables alive.
    The functions below make it, and `with_coat` and `with_sheen` lay something over it."""

    __slots__ = ("_data", "_keep")

    def __init__(self, data: NDArray, keep: tuple):
        if not isinstance(data, np.ndarray) or data.dtype != dtype:
            raise TypeError("a Material is made by the functions of lampion.material")
        self._data = data
        self._keep = keep

    @property
    def shape(self) -> tuple[int, ...]:
        """() of one material, else the shape of the array."""
        return self._data.shape

    def _over(self, name: str, members: dict[str, tuple[NDArray, int]], keep: tuple) -> Material:
        """A copy whose structure `name` has other members."""
        arrays = {key: value for key, (value, _) in members.items()}
        shape = _arrays.common_shape(("the material", self._data, 0),
                                     *[(key, value, core)
                                       for key, (value, core) in members.items()])
        data = np.broadcast_to(self._data, shape).copy()
        for key, array in arrays.items():
            data[name][key] = array
        return Material(data, self._keep + keep)

    def with_coat(self, weight: ArrayLike, roughness: ArrayLike) -> Material:
        """This material under a clear coat as in KHR_materials_clearcoat, both numbers 0 … 1."""
        return self._over("coat", {"weight": (_fraction("weight", weight), 0),
                                   "roughness": (_fraction("roughness", roughness), 0)}, ())

    def with_sheen(self, color: ArrayLike, roughness: ArrayLike,
                   white: Sequence[_brdf.Table]) -> Material:
        """This material under a layer of fibers as in KHR_materials_sheen: color (…, 3) and
        roughness (…), 0 … 1, and 16 tables of white fibers over black (`brdf.create_sheen`) for
        roughnesses spaced evenly over 0.07 … 1."""
        tables = list(white)
        if len(tables) != constants.SHEEN_TABLES:
            raise ValueError(f"white must be {constants.SHEEN_TABLES} tables, not {len(tables)}")
        pointers = ffi.new("lmp_brdf_table *[]", [_brdf.as_table(table) for table in tables])
        members = {"color": (_fraction("color", color, (3,)), 1),
                   "roughness": (_fraction("roughness", roughness), 0),
                   "white": (np.asarray(_address(pointers), np.uintp), 0)}
        return self._over("sheen", members, (tables, pointers))


def _address(pointer: Any) -> int:
    return int(ffi.cast("uintptr_t", pointer))


def _fraction(name: str, value: ArrayLike, core: tuple[int, ...] = ()) -> NDArray:
    return _arrays.within(name, _arrays.numbers(name, value, core), 0, 1)


def _make(kind: int, keep: tuple, **members: NDArray) -> Material:
    cores = {name: len(dtype[name].shape) for name in members}
    shape = _arrays.common_shape(*[(name, array, cores[name]) for name, array in members.items()])
    data = np.zeros(shape, dtype)
    data["kind"] = kind
    for name, array in members.items():
        data[name] = array
    return Material(data, keep)


def _color(name: str, value: ArrayLike) -> NDArray:
    return _arrays.within(name, _arrays.colors(name, value), 0)


def lobes(diffuse: ArrayLike, specular: ArrayLike = 0, exponent: ArrayLike = 0) -> Material:
    """The paper's two lobes (§4.1): diffuse/pi max(n·w, 0) + specular (e+1)/(2 pi) max(r·w, 0)^e.

    Colors (…, 3), or a number for gray, and exponent (…), at least 0."""
    return _make(Kind.LOBES, (), diffuse=_color("diffuse", diffuse),
                 specular=_color("specular", specular),
                 exponent=_arrays.within("exponent", _arrays.numbers("exponent", exponent), 0))


def metallic_roughness(base_color: ArrayLike, metallic: ArrayLike, roughness: ArrayLike,
                       dielectric: NDArray | None = None) -> Material:
    """glTF 2.0's: base_color (…, 3), metallic and roughness (…), all 0 … 1; `dielectric` is what
    the function of that name returns."""
    # which are, in this order, in unions with the members of lobes
    members = {"diffuse": _fraction("base_color", _color("base_color", base_color), (3,)),
               "exponent": _fraction("metallic", metallic),
               "roughness": _fraction("roughness", roughness)}
    if dielectric is not None:
        if getattr(dielectric, "dtype", None) != dtype["dielectric"]:
            raise TypeError("dielectric must be what the function dielectric returns")
        members["dielectric"] = np.asarray(dielectric)
    return _make(Kind.METALLIC_ROUGHNESS, (), **members)


def table(table: _brdf.Table, preintegrated: _preintegrated.Brdf | None = None) -> Material:
    """A tabulated BRDF, and what the method ``"preintegrated"`` reads in its place."""
    members = {"table": np.asarray(_address(_brdf.as_table(table)), np.uintp)}
    if preintegrated is not None:
        members["preintegrated"] = _of_preintegrated(preintegrated)
    return _make(Kind.TABLE, (table, preintegrated), **members)


def preintegrated(preintegrated: _preintegrated.Brdf) -> Material:
    """A preintegrated BRDF without its table."""
    return _make(Kind.PREINTEGRATED, (preintegrated,),
                 preintegrated=_of_preintegrated(preintegrated))


def _of_preintegrated(brdf: Any) -> NDArray:
    if not isinstance(brdf, _preintegrated.Brdf):
        raise TypeError("preintegrated must be a lampion.preintegrated.Brdf, "
                        f"not {type(brdf).__name__}")
    return np.asarray(_address(brdf._c), np.uintp)


def dielectric(ior: ArrayLike = 1.5, specular: ArrayLike = 1,
               color: ArrayLike = 1) -> NDArray:
    """The reflectance of a dielectric of this index of refraction (…), >= 0, weight (…), 0 … 1, and
    color (…, 3), >= 0: an array (…) of lmp_dielectric, for `metallic_roughness`."""
    def call(ior: Any, specular: Any, color: Any, result: Any) -> None:
        result[0] = lib.lmp_material_dielectric(ior[0], specular[0], color[0])

    return _arrays.each(
        None, (), call,
        ("ior", _arrays.within("ior", _arrays.numbers("ior", ior), 0), 0, "float *"),
        ("specular", _fraction("specular", specular), 0, "float *"),
        ("color", _color("color", color), 1, "lmp_rgb *"), dtype=dtype["dielectric"],
        ctype="lmp_dielectric *")


def coat_reflectance(weight: ArrayLike, roughness: ArrayLike, normal: ArrayLike,
                     view: ArrayLike) -> NDArray[np.float32]:
    """Fractions (…) of the light that coats of weight and roughness (…), 0 … 1, reflect toward
    views (…, 3), by their normals (…, 3), both unit."""
    weights, rough = _fraction("weight", weight), _fraction("roughness", roughness)

    def call(weight: Any, roughness: Any, normal: Any, view: Any, value: Any) -> None:
        coat = ffi.new("lmp_coat *", (weight[0], roughness[0]))
        value[0] = lib.lmp_material_coat_reflectance(coat, normal[0], view[0])

    return _arrays.each(None, (), call, ("weight", weights, 0, "float *"),
                        ("roughness", rough, 0, "float *"),
                        ("normal", _arrays.directions("normal", normal), 1, "lmp_vec3 *"),
                        ("view", _arrays.directions("view", view), 1, "lmp_vec3 *"))
