# SPDX-License-Identifier: MIT
"""Light probes: irradiance, fits to samples, positive series, the conventions of other software
(lampion/probe.h). A probe is an array (3, n²) of coefficients, red, green, blue.
"""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core, _host
from ._core import constants, ffi, lib

__all__ = ["Sign", "Normalization", "Engine", "irradiance", "make_constants", "fit",
           "make_positive_window", "minimum", "Convention", "convert", "recognize", "Format",
           "engine_format", "export"]

Sign = _core.enumeration("Sign", "lmp_probe_sign", __name__)
Normalization = _core.enumeration("Normalization", "lmp_probe_normalization", __name__)
Engine = _core.enumeration("Engine", "lmp_probe_engine", __name__)


def _probes(sh: ArrayLike, least: int = 1) -> tuple[int, NDArray]:
    """Bands and coefficients of probes (…, 3, n²)."""
    n, c = _arrays.coefficients("sh", sh, (3,))
    if n < least:
        raise ValueError(f"sh must have at least {least} bands, not {n}")
    return n, c


def irradiance(sh: ArrayLike, normals: ArrayLike, *,
               out: NDArray | None = None) -> NDArray[np.float32]:
    """Irradiance (…, 3), W·m⁻², that surfaces with unit `normals` (…, 3) receive from probes `sh`
    (…, 3, n²): Σ A_l L_lm Y_lm(n) (Ramamoorthi and Hanrahan 2001). It may ring below 0. Many
    normals at one probe are a batch; a normal for each of many probes takes a microsecond or two
    each, and `lobe.response` of the lights themselves less."""
    n, c = _probes(sh)
    ways = _arrays.directions("normals", normals)
    if c.ndim > 2:
        def call(sh: Any, normal: Any, rgb: Any) -> None:
            rgb[0] = lib.lmp_probe_irradiance(n, sh, normal[0])

        return _arrays.each(out, (3,), call, ("sh", c, 2, "float *"),
                            ("normals", ways, 1, "lmp_vec3 *"), ctype="lmp_rgb *")
    c = np.ascontiguousarray(c)
    shape = ways.shape[:-1]
    result = _arrays.Result(out, shape + (3,), [ways, c])
    keep: list = []
    lib.lmp_probe_irradiance_n(n, ffi.from_buffer("float[]", c),
                               _arrays.vec3_array(ways, shape, keep), ways.size // 3,
                               result.rgb())
    return result.finish()


def make_constants(sh: ArrayLike, scale: float = 1) -> dict[str, NDArray[np.float32]]:
    """The polynomial of the irradiance of one probe `sh` (3, n²) times `scale`, by three bands,
    that engines upload: linear (3, 4), quadratic (3, 4) and last (4,) (Sloan 2008, appendix
    A10)."""
    n, c = _probes(sh, 3)
    if c.ndim != 2:
        raise ValueError(f"sh must be one probe, of the shape (3, n²), not {c.shape}")
    c = np.ascontiguousarray(c)
    found = ffi.new("lmp_probe_constants *")
    lib.lmp_probe_make_constants(n, _core.number("scale", scale), ffi.from_buffer("float[]", c),
                                 found)
    members = np.frombuffer(ffi.buffer(found), _core.dtype_of("lmp_probe_constants"))[0]
    return {name: members[name].copy() for name in members.dtype.names}


def fit(bands: int, directions: ArrayLike, values: ArrayLike, weights: ArrayLike | None = None,
        smoothness: float = 0) -> NDArray[np.float32]:
    """Fit a series to samples, which need not be uniform.

    Parameters
    ----------
    bands : int
        1 … 32.
    directions : array_like, (N, 3)
        Unit.
    values, weights : array_like, (N,)
        Weights are at least 0, and 1 if they are not given.
    smoothness : float
        Of the term Σ l² (l+1)² f_lm² that is minimized beside Σ weight (series - value)².

    Returns
    -------
    ndarray of float32, (n²,)

    Raises
    ------
    Error
        The samples leave some coefficient undetermined.
    """
    n = _core.bands(bands, constants.PROBE_FIT_BANDS_MAX)
    ways = _arrays.directions("directions", directions).reshape(-1, 3)
    seen = _arrays.finite("values", _arrays.numbers("values", values)).reshape(-1)
    shape = (len(ways),)
    if seen.shape != shape:
        raise ValueError(f"values must have the shape {shape}, not {seen.shape}")
    keep: list = []
    samples = ffi.new("lmp_probe_samples *")
    samples.directions = _arrays.vec3_array(ways, shape, keep)
    samples.values = _arrays.float_array(seen, shape, keep)
    if weights is not None:
        scales = _arrays.within("weights", _arrays.numbers("weights", weights), 0)
        if scales.shape not in ((), shape):
            raise ValueError(f"weights must have the shape {shape}, not {scales.shape}")
        samples.weights = _arrays.float_array(scales, shape, keep)
    samples.count = len(ways)
    sh = np.empty(n * n, np.float32)
    host = _host.Host()
    result = lib.lmp_probe_fit(host.c, n, _core.number("smoothness", smoothness, 0), samples,
                               ffi.from_buffer("float[]", sh))
    if result == lib.LMP_ERROR_ARGUMENT:
        raise _core.Error(f"these {len(ways)} samples do not determine the {n * n} coefficients of "
                          f"{n} bands: give more, or a smoothness", "argument")
    host.check(result)
    return sh


def make_positive_window(sh: ArrayLike) -> NDArray[np.float32]:
    """Weights (n,) of the weakest window 1 / (1 + mu l² (l+1)²) under which no function of `sh`
    (…, n²) falls below 0, up to 32 bands; exact up to 3 (Sloan 2008)."""
    n, c = _arrays.coefficients("sh", sh, most=constants.PROBE_POSITIVE_BANDS_MAX)
    c = np.ascontiguousarray(_arrays.finite("sh", c))
    weights = np.empty(n, np.float32)
    lib.lmp_probe_make_positive_window(n, ffi.from_buffer("float[]", c), c.size // (n * n),
                                       ffi.from_buffer("float[]", weights))
    return weights


def minimum(sh: ArrayLike) -> NDArray[np.float32]:
    """Smallest values (…) of functions (…, n²) of 1 to 3 bands."""
    n, c = _arrays.coefficients("sh", sh, most=3)

    def call(c: Any, value: Any) -> None:
        value[0] = lib.lmp_probe_minimum(n, c)

    return _arrays.each(None, (), call, ("sh", c, 1, "float *"))


# --- conventions --------------------------------------------------------------------------------


@dataclass(frozen=True)
class Convention:
    """How other software defines coefficients; by default as this library does.

    ``sign`` is ``"condon_shortley"`` or ``"positive"``, ``normalization`` ``"orthonormal"``,
    ``"n3d"`` or ``"sn3d"``; ``axes`` are the convention's x, y, z in this library's world, 1, 2, 3
    for x, y, z, negative for their opposites."""

    sign: str = "condon_shortley"
    normalization: str = "orthonormal"
    axes: tuple[int, int, int] = (1, 2, 3)

    def _c(self) -> Any:
        axes = [_core.integer("axes", axis, -3, 3) for axis in self.axes]
        if sorted(abs(axis) for axis in axes) != [1, 2, 3]:
            raise ValueError(f"axes must be 1, 2, 3 in some order and sign, not {self.axes}")
        return ffi.new("lmp_probe_convention *",
                       (_core.choice("sign", Sign, self.sign),
                        _core.choice("normalization", Normalization, self.normalization),
                        axes))


def _checked(name: str, value: Any, kind: type) -> Any:
    if not isinstance(value, kind):
        raise TypeError(f"{name} must be a {kind.__name__}, not {type(value).__name__}")
    return value


def _convention(struct: Any) -> Convention:
    axes = struct.axes if any(struct.axes) else (1, 2, 3)
    return Convention(Sign(struct.sign).name.lower(),
                      Normalization(struct.normalization).name.lower(),
                      (axes[0], axes[1], axes[2]))


def convert(from_: Convention, to: Convention, sh: ArrayLike, *,
            out: NDArray | None = None) -> NDArray:
    """Convert coefficients (…, n²) from one convention to another; where their axes differ, of at
    most 16 bands."""
    ours = _checked("from_", from_, Convention)._c()
    theirs = _checked("to", to, Convention)._c()
    most = constants.BANDS_MAX if from_.axes == to.axes else constants.PROBE_AXES_BANDS_MAX
    n, c = _arrays.coefficients("sh", sh, most=most)
    return _arrays.each(out, (n * n,), lambda c, o: lib.lmp_probe_convert(n, ours, theirs, c, o),
                        ("sh", c, 1, "float *"))


def recognize(tolerance: float, ours: ArrayLike, theirs: ArrayLike) -> Convention | None:
    """The convention of `theirs` (n²,), coefficients of the same function as `ours` in this
    library's, or None if none agrees to within `tolerance` times the largest."""
    n, c = _arrays.coefficients("ours", ours)
    other = _arrays.numbers("theirs", theirs, (n * n,))
    if c.ndim != 1 or other.ndim != 1:
        raise ValueError("ours and theirs must have the shape (n²,)")
    c, other = np.ascontiguousarray(c), np.ascontiguousarray(other)
    found = ffi.new("lmp_probe_convention *")
    if lib.lmp_probe_recognize(n, _core.number("tolerance", tolerance, 0),
                               ffi.from_buffer("float[]", c), ffi.from_buffer("float[]", other),
                               found):
        return _convention(found)
    return None


# --- engines ------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Format:
    """The form in which an engine stores a probe (`dataclasses.replace` changes its axes)."""

    name: str
    convention: Convention
    unit: float
    interleaved: bool
    factors: tuple[float, ...]


def engine_format(engine: str | int) -> Format:
    """The format of an engine's probes: ``"unity"``, ``"unreal"``, ``"godot"`` or
    ``"filament"``."""
    found = lib.lmp_probe_engine_format(_core.choice("engine", Engine, engine))
    return Format(ffi.string(found.name).decode(), _convention(found.convention), found.unit,
                  found.interleaved, tuple(found.factors))


def export(format: Format | str, sh: ArrayLike) -> NDArray[np.float32]:
    """Values (…, 27) of probes (…, 3, n²) of at least 3 bands in a format, or in that of an engine
    by its name."""
    n, c = _probes(sh, 3)
    if isinstance(format, str):
        format = engine_format(format)
    if len(_checked("format", format, Format).factors) != 9:
        raise ValueError("factors must be 9")
    name = ffi.new("char[]", format.name.encode())
    described = ffi.new("lmp_probe_format *",
                        (name, format.convention._c()[0], format.unit, format.interleaved,
                         format.factors))
    return _arrays.each(None, (27,), lambda c, out: lib.lmp_probe_export(n, described, c, out),
                        ("sh", c, 2, "float *"))
