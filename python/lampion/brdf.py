# SPDX-License-Identifier: MIT
"""Measured and parametric BRDFs, and their tables of coefficients (lampion/brdf.h).

Directions are local: z is the normal, x the tangent; wi points to the light, wo to the viewer.
Values are f_r in sr⁻¹, linear RGB, without the cosine.
"""
from __future__ import annotations

from types import SimpleNamespace
from typing import Any, Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core, _host
from ._core import constants, ffi, lib
from .sh import Window

__all__ = ["Symmetry", "Brdf", "create_lambert", "create_phong", "create_ggx", "create_sheen",
           "create_sgd", "sgd_name", "find_sgd", "read_merl", "read_rgl", "encode_merl",
           "encode_rgl", "Table"]

Symmetry = _core.enumeration("Symmetry", "lmp_brdf_symmetry", __name__)
_double = np.dtype(np.float64)


class Brdf(_core.Owner):
    """A BRDF of any kind; the functions below make it."""

    __slots__ = ()

    def __init__(self, pointer: Any = None):
        if not isinstance(pointer, ffi.CData):
            raise TypeError("a Brdf is made by the functions of lampion.brdf")
        self._own(pointer, lib.lmp_brdf_destroy)

    def eval(self, wi: ArrayLike, wo: ArrayLike, *,
             out: NDArray | None = None) -> NDArray[np.float32]:
        """f_r (…, 3) for wi and wo (…, 3), of any length; 0 below the horizon."""
        def call(wi: Any, wo: Any, rgb: Any) -> None:
            rgb[0] = lib.lmp_brdf_eval(self._c, wi[0], wo[0])

        return _arrays.each(out, (3,), call,
                            ("wi", _arrays.points("wi", wi), 1, "lmp_vec3 *"),
                            ("wo", _arrays.points("wo", wo), 1, "lmp_vec3 *"), ctype="lmp_rgb *")

    def eval_double(self, wi: ArrayLike, wo: ArrayLike) -> NDArray[np.float64]:
        """f_r as `eval` gives it, in double."""
        return _arrays.each(
            None, (3,), lambda wi, wo, rgb: lib.lmp_brdf_eval_double(self._c, wi, wo, rgb),
            ("wi", _arrays.numbers("wi", wi, (3,), _double), 1, "double *"),
            ("wo", _arrays.numbers("wo", wo, (3,), _double), 1, "double *"), dtype=_double,
            ctype="double *")

    def describe(self) -> SimpleNamespace:
        """Its kind, anisotropic, mirrored, measured, spectral, shape, rings and bytes."""
        return _core.record(lib.lmp_brdf_describe(self._c))

    def project(self, bands: int, wo: ArrayLike, rings: int = 64) -> NDArray[np.float32]:
        """Coefficients (3, n²) of f_r cos theta_i seen from `wo` (3,), wo.z > 0, in the material's
        frame, by `rings` Gauss-Legendre rings of 2 rings azimuths."""
        n = _core.bands(bands)
        way = _arrays.finite("wo", _arrays.numbers("wo", wo, (3,)))
        if way.ndim != 1 or not way[2] > 0:
            raise ValueError("wo must be one direction above the horizon")
        sh = np.empty((3, n * n), np.float32)
        host = _host.Host()
        host.check(lib.lmp_brdf_project(host.c, n, _core.integer("rings", rings, 1, 2048), self._c,
                                        tuple(way.tolist()), ffi.from_buffer("float[]", sh)))
        return sh


def _create(function: Callable, *arguments: Any) -> Brdf:
    return Brdf(_host.created("lmp_brdf", lambda host, brdf: function(host, *arguments, brdf)))


def create_lambert(albedo: ArrayLike) -> Brdf:
    """A Lambertian BRDF, albedo/pi; albedo >= 0, a color or a number."""
    return _create(lib.lmp_brdf_create_lambert, _arrays.color("albedo", albedo))


def create_phong(reflectance: ArrayLike, exponent: float) -> Brdf:
    """A Phong lobe, reflectance (e+2)/(2 pi) max(wi·r, 0)^e (Lafortune and Willems 1994)."""
    return _create(lib.lmp_brdf_create_phong, _arrays.color("reflectance", reflectance),
                   _core.number("exponent", exponent, 0))


def create_ggx(alpha_x: float, f0: ArrayLike, diffuse: ArrayLike = 0,
               alpha_y: float = 0) -> Brdf:
    """glTF's microfacets: widths alpha, the square of glTF's roughness, 0.001 … 1 along x and y (0:
    as along x), reflectance f0 at normal incidence, 0 … 1, over a diffuse part of that albedo."""
    alpha_y = _core.number_or_0("alpha_y", alpha_y, 0.001, 1)
    ggx = ffi.new("lmp_ggx *", (_core.number("alpha_x", alpha_x, 0.001, 1), alpha_y,
                                _arrays.color("f0", f0, 1), _arrays.color("diffuse", diffuse)))
    return _create(lib.lmp_brdf_create_ggx, ggx)


def create_sheen(roughness: float, color: ArrayLike, diffuse: ArrayLike = 0) -> Brdf:
    """Cloth as in KHR_materials_sheen: roughness 0.07 … 1, reflectance of the fibers 0 … 1, over a
    diffuse base of that albedo."""
    rough = _core.number("roughness", roughness, constants.SHEEN_ROUGHNESS_MIN, 1)
    sheen = ffi.new("lmp_sheen *", (rough, _arrays.color("color", color, 1),
                                    _arrays.color("diffuse", diffuse)))
    return _create(lib.lmp_brdf_create_sheen, sheen)


def create_sgd(sgd: NDArray) -> Brdf:
    """The shifted gamma distribution of Bagher et al. (2012), of the parameters that `find_sgd`
    returns."""
    if getattr(sgd, "dtype", None) != _core.dtype_of("lmp_sgd") or sgd.size != 1:
        raise TypeError("sgd must be what find_sgd returns")
    parameters = np.array(sgd)
    return _create(lib.lmp_brdf_create_sgd,
                   _arrays.pointer(parameters, "lmp_sgd *"))


def sgd_name(index: int) -> str | None:
    """The name of material `index` of the MERL database, or None past the last."""
    return _core.text(lib.lmp_brdf_sgd_name(_core.integer("index", index, 0, 2**32)))


def find_sgd(name: str) -> NDArray:
    """The parameters that were fitted to a material of the MERL database, of which each member
    holds red, green, blue."""
    if not isinstance(name, str) or "\0" in name:
        raise TypeError("name must be a string")
    found = ffi.new("lmp_sgd *")
    if lib.lmp_brdf_find_sgd(name.encode(), found):
        raise ValueError(f"no material is called {name!r}")
    return np.frombuffer(bytes(ffi.buffer(found)), _core.dtype_of("lmp_sgd")).reshape(())


# --- files --------------------------------------------------------------------------------------


def read_merl(data: bytes) -> Brdf:
    """The BRDF of the bytes of a MERL .binary file (Matusik et al. 2003)."""
    return Brdf(_host.read_object("lmp_brdf", lib.lmp_brdf_read_merl, data))


def read_rgl(data: bytes) -> Brdf:
    """The BRDF of the bytes of an RGL .bsdf file (Dupuy and Jakob 2018)."""
    return Brdf(_host.read_object("lmp_brdf", lib.lmp_brdf_read_rgl, data))


def _as_brdf(brdf: Any) -> Any:
    """The library's object."""
    if not isinstance(brdf, Brdf):
        raise TypeError(f"brdf must be a lampion.brdf.Brdf, not {type(brdf).__name__}")
    return brdf._c


def _encode(encode: Callable, brdf: Brdf, threads: int) -> bytes:
    # The library would have Python release what C's malloc gave: Python's memory is lent instead.
    lent: dict[int, Any] = {}

    def allocate(size: int, user: Any) -> Any:
        memory = ffi.new("char[]", size + 64)
        start = int(ffi.cast("uintptr_t", memory))
        place = ffi.cast("void *", start + -start % 64)
        lent[int(ffi.cast("uintptr_t", place))] = memory
        return place

    def release(memory: Any, user: Any) -> None:
        lent.pop(int(ffi.cast("uintptr_t", memory)), None)

    host = _host.Host(threads)
    hooks = (ffi.callback("void *(size_t, void *)", allocate),
             ffi.callback("void(void *, void *)", release))
    host.c.allocate, host.c.release = hooks
    data, size = ffi.new("void **"), ffi.new("size_t *")
    host.check(encode(host.c, _as_brdf(brdf), data, size))
    return bytes(ffi.buffer(data[0], size[0]))


def encode_merl(brdf: Brdf, threads: int = 1) -> bytes:
    """A MERL file of samples of a BRDF, 35 MB."""
    return _encode(lib.lmp_brdf_encode_merl, brdf, threads)


def encode_rgl(brdf: Brdf, threads: int = 1) -> bytes:
    """An RGL file of samples of a BRDF."""
    return _encode(lib.lmp_brdf_encode_rgl, brdf, threads)


# --- tables -------------------------------------------------------------------------------------


class Table(_host.Stored):
    """Coefficients of f_r cos theta_i for each direction of the view (paper §4.1).

    Making one takes seconds to minutes on `threads`; `progress` is called with the fraction done,
    and Ctrl+C ends it.

    Parameters
    ----------
    brdf : Brdf
    bands, views, azimuths : int
        0 means 10, 64 (5/4 per band if that is more), and 32.
    window : str
        ``"none"``, ``"hanning"``, which the paper uses, or ``"lanczos"``.
    window_size : float
        As in `sh.make_window`.
    tolerance : float
        The change, relative to a view's largest coefficient, at which rings are doubled no more; 0
        means 1e-4.
    rings_max : int
        The most rings of the quadrature, 16 … 2048; 0 means those that resolve the BRDF, or 512.
    symmetry : str
        ``"auto"``, ``"mirror"`` or ``"none"``.
    """

    __slots__ = ()
    _ctype, _destroy = "lmp_brdf_table", lib.lmp_brdf_table_destroy
    _read, _size = lib.lmp_brdf_table_read, lib.lmp_brdf_table_size
    _write = lib.lmp_brdf_table_write

    def __init__(self, brdf: Brdf, bands: int = 0, *, views: int = 0, azimuths: int = 0,
                 window: str | int = "none", window_size: float = 0,
                 symmetry: str | int = "auto", tolerance: float = 0, rings_max: int = 0,
                 threads: int = 1, progress: Callable[[float], Any] | None = None):
        desc = ffi.new("lmp_brdf_table_desc *", {
            "bands": _core.integer_or_0("bands", bands, 1, constants.BANDS_MAX),
            "views": _core.integer_or_0("views", views, 2, 1024),
            "azimuths": _core.integer_or_0("azimuths", azimuths, 4, 256),
            "window": _core.choice("window", Window, window),
            "window_size": _core.number("window_size", window_size, 0),
            "symmetry": _core.choice("symmetry", Symmetry, symmetry),
            "tolerance": _core.number("tolerance", tolerance, 0),
            "rings_max": _core.integer_or_0("rings_max", rings_max, 16, 2048)})
        source = _as_brdf(brdf)
        self._create(lambda host, table: lib.lmp_brdf_table_create(host, desc, source, table),
                     _host.Host(threads, progress))

    def describe(self) -> SimpleNamespace:
        """Its bands, views, azimuths, mirrored, count, window, window_size, rings, change and
        theta_step."""
        return _core.record(lib.lmp_brdf_table_describe(self._c))

    def coefficients(self) -> NDArray[np.float32]:
        """All coefficients, (azimuths, views, 3, count), which the table owns."""
        info = self.describe()
        return _core.view(self, lib.lmp_brdf_table_coefficients(self._c),
                          (info.azimuths, info.views, 3, info.count), np.float32)

    def interpolate(self, cos_theta_o: ArrayLike, phi_o: ArrayLike = 0) -> NDArray[np.float32]:
        """Coefficients (…, 3, count) for views between those of the table, in their frames."""
        count = self.describe().count
        cosines = _arrays.finite("cos_theta_o", _arrays.numbers("cos_theta_o", cos_theta_o))
        angles = _arrays.finite("phi_o", _arrays.numbers("phi_o", phi_o))
        return _arrays.each(
            None, (3, count),
            lambda c, phi, sh: lib.lmp_brdf_table_interpolate(self._c, c[0], phi[0], sh),
            ("cos_theta_o", cosines, 0, "float *"), ("phi_o", angles, 0, "float *"))

    def find_albedo(self, view: int, azimuth: int = 0) -> tuple[NDArray, NDArray]:
        """The fraction of light reflected toward a view, (3,): of the BRDF, and of its series."""
        info = self.describe()
        view = _core.integer("view", view, 0, info.views - 1)
        azimuth = _core.integer("azimuth", azimuth, 0, info.azimuths - 1)
        whole, series = ffi.new("lmp_rgb *"), ffi.new("lmp_rgb *")
        lib.lmp_brdf_table_find_albedo(self._c, view, azimuth, whole, series)
        return (np.array(_core.vector_of(whole[0]), np.float32),
                np.array(_core.vector_of(series[0]), np.float32))


def as_table(table: Any) -> Any:
    """The library's object."""
    if not isinstance(table, Table):
        raise TypeError(f"table must be a lampion.brdf.Table, not {type(table).__name__}")
    return table._c
