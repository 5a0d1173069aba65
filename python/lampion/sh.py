# SPDX-License-Identifier: MIT
"""Real spherical harmonics: evaluation, rotation, windows, projection, products (lampion/sh.h).

n bands are the degrees l = 0 … n-1, with n² coefficients; (l, m) has the index l² + l + m. The
basis is real and orthonormal, with the Condon-Shortley sign: Y_1 = 0.4886 (-y, z, -x). Functions
that are given coefficients know the bands by their number.
"""
from __future__ import annotations

from typing import Any, Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core, _host
from ._core import ffi, lib

__all__ = ["Window", "count", "index", "rotation_count", "eval", "eval_gradient", "reconstruct",
           "combine", "dot", "expand_zonal", "make_rotation", "make_rotation_from_matrix",
           "rotate_z", "rotate", "rotate_by_matrix", "window_name", "make_window",
           "make_laplacian_window", "apply_window", "project_function", "project_latlong",
           "project_cubemap", "multiply_few", "Product", "pack_half", "unpack_half", "eval_double",
           "eval_gradient_double", "eval_hessian_double", "make_rotation_double", "rotate_double"]

Window = _core.enumeration("Window", "lmp_window", __name__)
_double = np.dtype(np.float64)


def count(bands: int) -> int:
    """Number of coefficients of `bands` bands, n²."""
    return _core.bands(bands) ** 2


def index(l: int, m: int) -> int:
    """Index of degree l and order m among the coefficients, l² + l + m."""
    l = _core.integer("l", l, 0, _core.constants.BANDS_MAX - 1)
    return l * l + l + _core.integer("m", m, -l, l)


def rotation_count(bands: int) -> int:
    """Number of floats in the matrices of a rotation: (2l+1)² for each band."""
    n = _core.bands(bands)
    return (4 * n * n - 1) * n // 3


# --- evaluation -------------------------------------------------------------------------------


def eval(bands: int, directions: ArrayLike, *, out: NDArray | None = None) -> NDArray[np.float32]:
    """Evaluate Y_lm (paper Eq. 1).

    Parameters
    ----------
    bands : int
    directions : array_like, (…, 3)
        Unit.
    out : ndarray of float32, (…, n²), optional
        The planar layout, ``np.empty((n * n, count), np.float32).T``, is the faster one.

    Returns
    -------
    ndarray of float32, (…, n²)
    """
    n = _core.bands(bands)
    ways = _arrays.directions("directions", directions)
    shape = ways.shape[:-1]
    result = _arrays.Result(out, shape + (n * n,), [ways])
    keep: list = []
    lib.lmp_sh_eval_n(n, _arrays.vec3_array(ways, shape, keep), ways.size // 3, result.sh())
    return result.finish()


def eval_gradient(bands: int, directions: ArrayLike, *, out: NDArray | None = None,
                  gradient: NDArray | None = None) -> tuple[NDArray, NDArray]:
    """Evaluate Y_lm and its surface gradient, which is perpendicular to the direction.

    Parameters
    ----------
    directions : array_like, (…, 3)
        Unit.
    out, gradient : ndarray of float32, optional
        Where the results go.

    Returns
    -------
    sh : ndarray, (…, n²)
    gradient : ndarray, (…, 3, n²)
        d/dx, d/dy, d/dz of Y_lm(v / |v|).
    """
    n = _core.bands(bands)
    ways = _arrays.directions("directions", directions)
    shape = ways.shape[:-1]
    result = _arrays.Result(out, shape + (n * n,), [ways])
    slope = _arrays.Result(gradient, shape + (3, n * n), [ways, result.out], name="gradient")
    keep: list = []
    lib.lmp_sh_eval_gradient_n(n, _arrays.vec3_array(ways, shape, keep), ways.size // 3,
                               result.sh(), slope.sh(2))
    return result.finish(), slope.finish()


def reconstruct(sh: ArrayLike, directions: ArrayLike, *, out: NDArray | None = None) -> NDArray:
    """Values (…) at `directions` (…, 3) of the functions with coefficients `sh` (…, n²) (paper
    Eq. 6). Elements are taken one by one: for very many, multiply by `eval`."""
    n, c = _arrays.coefficients("sh", sh)
    ways = _arrays.directions("directions", directions)

    def call(c: Any, way: Any, value: Any) -> None:
        value[0] = lib.lmp_sh_reconstruct(n, c, way[0])

    return _arrays.each(out, (), call, ("sh", c, 1, "float *"),
                        ("directions", ways, 1, "lmp_vec3 *"))


def combine(s: float, a: ArrayLike, t: float, b: ArrayLike, *,
            out: NDArray | None = None) -> NDArray:
    """Combine coefficients (…, n²) into s a + t b."""
    s, t = _core.number("s", s), _core.number("t", t)
    n, a = _arrays.coefficients("a", a)
    b = _arrays.numbers("b", b, (n * n,))
    return _arrays.each(out, (n * n,), lambda x, y, sh: lib.lmp_sh_combine(n, s, x, t, y, sh),
                        ("a", a, 1, "float *"), ("b", b, 1, "float *"))


def dot(a: ArrayLike, b: ArrayLike, *, out: NDArray | None = None) -> NDArray:
    """Integrals (…) of the products of two functions: Σ a_i b_i of coefficients (…, n²) (paper
    Eq. 4)."""
    n, a = _arrays.coefficients("a", a)
    b = _arrays.numbers("b", b, (n * n,))
    shape = _arrays.common_shape(("a", a, 1), ("b", b, 1))
    result = _arrays.Result(out, shape, [a, b])
    # both have the same layout
    a = np.ascontiguousarray(np.broadcast_to(a, shape + (n * n,)))
    b = np.ascontiguousarray(np.broadcast_to(b, shape + (n * n,)))
    lib.lmp_sh_dot_n(n, lib.LMP_SH_INTERLEAVED, 0, ffi.from_buffer("float[]", a),
                     ffi.from_buffer("float[]", b), a.size // (n * n), result.pointer())
    return result.finish()


def expand_zonal(zonal: ArrayLike, axis: ArrayLike, *, out: NDArray | None = None) -> NDArray:
    """Coefficients (…, n²) of functions symmetric around `axis` (…, 3), unit, of which `zonal`
    (…, n) are the coefficients of Y_l0 in the frame whose z is the axis (paper Eq. 3, 13)."""
    n, bands = _arrays.per_band("zonal", zonal)
    ways = _arrays.directions("axis", axis)
    return _arrays.each(out, (n * n,), lambda z, way, sh: lib.lmp_sh_expand_zonal(n, z, way[0], sh),
                        ("zonal", bands, 1, "float *"), ("axis", ways, 1, "lmp_vec3 *"))


# --- rotation ---------------------------------------------------------------------------------


def make_rotation(bands: int, rotation: ArrayLike, *, out: NDArray | None = None) -> NDArray:
    """Matrices (…, `rotation_count`) of a rotation, a quaternion (…, 4) x, y, z, w that is not 0:
    M^l of f'(w) = f(R⁻¹ w), each row-major, for l = 0 … n-1."""
    n = _core.bands(bands)
    quaternions = _arrays.finite("rotation", _arrays.numbers("rotation", rotation, (4,)))
    if not quaternions.any(axis=-1).all():
        raise ValueError("rotation must not be 0")
    return _arrays.each(out, (rotation_count(n),),
                        lambda q, matrices: lib.lmp_sh_make_rotation(n, q[0], matrices),
                        ("rotation", quaternions, 1, "lmp_quat *"))


def _rotations(rotation: ArrayLike) -> NDArray:
    """Matrices (…, 3, 3), which must be rotations up to rounding."""
    matrices = _arrays.finite("rotation", _arrays.numbers("rotation", rotation, (3, 3)))
    square = matrices @ np.swapaxes(matrices, -1, -2)
    tolerance = _core.constants.UNIT_TOLERANCE
    if matrices.size and not (np.abs(square - np.eye(3)).max() <= tolerance
                              and np.linalg.det(matrices).min() > 0):
        raise ValueError("rotation must be a rotation matrix")
    return matrices


def make_rotation_from_matrix(bands: int, rotation: ArrayLike, *,
                              out: NDArray | None = None) -> NDArray:
    """Matrices of a rotation as `make_rotation` makes them, from a matrix (…, 3, 3)."""
    n = _core.bands(bands)
    return _arrays.each(out, (rotation_count(n),),
                        lambda r, matrices: lib.lmp_sh_make_rotation_from_matrix(n, r, matrices),
                        ("rotation", _rotations(rotation), 2, "float *"))


def rotate_z(angle: ArrayLike, sh: ArrayLike, *, out: NDArray | None = None) -> NDArray:
    """Rotate coefficients (…, n²) by `angle` (…), radians, around z, from x toward y."""
    n, c = _arrays.coefficients("sh", sh)
    angles = _arrays.finite("angle", _arrays.numbers("angle", angle))
    return _arrays.each(out, (n * n,), lambda a, c, r: lib.lmp_sh_rotate_z(n, a[0], c, r),
                        ("angle", angles, 0, "float *"), ("sh", c, 1, "float *"))


def rotate(matrices: ArrayLike, sh: ArrayLike, *, out: NDArray | None = None) -> NDArray:
    """Rotate coefficients (…, n²) by `matrices`, which `make_rotation` makes. Many functions that
    share one rotation are rotated at once."""
    n, c = _arrays.coefficients("sh", sh)
    m = _arrays.numbers("matrices", matrices, (rotation_count(n),))
    if m.ndim > 1:
        return _arrays.each(out, (n * n,), lambda m, c, r: lib.lmp_sh_rotate(n, m, c, r),
                            ("matrices", m, 1, "float *"), ("sh", c, 1, "float *"))
    result = _arrays.Result(out, c.shape, [m, c])
    # c must have the layout of the result, which is contiguous
    m, c = np.ascontiguousarray(m), np.ascontiguousarray(c)
    place = ffi.new("lmp_sh_array *", (result.pointer(), 0, lib.LMP_SH_INTERLEAVED))
    lib.lmp_sh_rotate_n(n, ffi.from_buffer("float[]", m), ffi.from_buffer("float[]", c),
                        c.size // (n * n), place[0])
    return result.finish()


def rotate_by_matrix(rotation: ArrayLike, sh: ArrayLike, *, out: NDArray | None = None) -> NDArray:
    """Rotate coefficients (…, n²) by matrices (…, 3, 3) that few functions share."""
    n, c = _arrays.coefficients("sh", sh)
    return _arrays.each(out, (n * n,), lambda r, c, o: lib.lmp_sh_rotate_by_matrix(n, r, c, o),
                        ("rotation", _rotations(rotation), 2, "float *"), ("sh", c, 1, "float *"))


# --- windows ----------------------------------------------------------------------------------


def window_name(window: str | int) -> str:
    """The library's name of a windowing filter."""
    return ffi.string(lib.lmp_sh_window_name(_core.choice("window", Window, window))).decode()


def make_window(bands: int, window: str | int, size: float = 0) -> NDArray[np.float32]:
    """Weights (n,) of a windowing filter, ``"none"``, ``"hanning"`` or ``"lanczos"``. They fall to
    0 at the band `size`; 0 means `bands`, as in the paper (§4.2)."""
    n, kind = _core.bands(bands), _core.choice("window", Window, window)
    weights = np.empty(n, np.float32)
    lib.lmp_sh_make_window(n, kind, _core.number("size", size, 0),
                           ffi.from_buffer("float[]", weights))
    return weights


def make_laplacian_window(keep: float, sh: ArrayLike) -> NDArray[np.float32]:
    """Weights (…, n) that leave the fraction 0 < `keep` <= 1 of the squared Laplacian of
    functions (…, n²): 1 / (1 + mu l² (l+1)²) (Sloan 2008)."""
    n, c = _arrays.coefficients("sh", sh)
    keep = _core.number("keep", keep, 1e-30, 1)
    _arrays.finite("sh", c)
    return _arrays.each(None, (n,), lambda c, w: lib.lmp_sh_make_laplacian_window(n, keep, c, w),
                        ("sh", c, 1, "float *"))


def apply_window(weights: ArrayLike, sh: ArrayLike, *, out: NDArray | None = None) -> NDArray:
    """Scale band l of coefficients (…, n²) by weights (…, n)."""
    n, c = _arrays.coefficients("sh", sh)
    w = _arrays.numbers("weights", weights, (n,))
    return _arrays.each(out, (n * n,), lambda w, c, o: lib.lmp_sh_apply_window(n, w, c, o),
                        ("weights", w, 1, "float *"), ("sh", c, 1, "float *"))


# --- projection -------------------------------------------------------------------------------


def project_function(bands: int, function: Callable[[tuple[float, float, float]], Any],
                     nodes: int = 0) -> NDArray[np.float32]:
    """Project a function of a unit direction (x, y, z) (paper Eq. 5).

    Parameters
    ----------
    function : callable
        Returns a number, or a color of three.
    nodes : int
        Of the quadrature: `function` is called at `nodes` heights times 2 `nodes` azimuths, which
        is exact for degrees up to 2 nodes - bands. 0 means `bands`.

    Returns
    -------
    ndarray of float32, (n²,), or of three planes, (3, n²)
    """
    n = _core.bands(bands)
    nodes = _core.integer("nodes", nodes, 0, 1 << 14)
    if not callable(function):
        raise TypeError("function must be callable")
    failures: list = []
    color = np.ndim(function((0.0, 0.0, 1.0))) > 0

    def fail(kind: Any, value: BaseException, trace: Any) -> None:
        failures.append(value)

    def call(direction: Any, user: Any) -> Any:
        if failures:
            return (0, 0, 0) if color else 0
        value = function(_core.vector_of(direction))
        return ffi.new("lmp_rgb *", tuple(map(float, value)))[0] if color else float(value)

    project = lib.lmp_sh_project_function_rgb if color else lib.lmp_sh_project_function
    kind = "lmp_sh_function_rgb" if color else "lmp_sh_function"
    result = np.empty((3, n * n) if color else n * n, np.float32)
    project(n, nodes, ffi.callback(kind, call, onerror=fail), ffi.NULL,
            ffi.from_buffer("float[]", result))
    if failures:
        raise failures[0]
    return result


def _texels(name: str, image: ArrayLike) -> NDArray:
    """An image of float32 or float16 whose strides are above 0, as C's are."""
    array = np.asarray(image)
    if array.dtype.kind == "u" and array.dtype.itemsize <= 2:
        raise TypeError(f"{name} must be linear radiance, not the {array.dtype} of a picture: "
                        "convert it")
    if array.dtype not in (np.float32, np.float16):
        array = _arrays.numbers(name, array)
    if min(array.strides, default=1) <= 0 or not array.flags.aligned:
        array = array.copy()
    if array.size == 0:
        raise ValueError(f"{name} must have texels")
    _core.integer("the size of " + name, max(array.shape), 1, 1 << 30)
    return array


def _fill_texels(image: Any, array: NDArray) -> None:
    """Describes texels (rows, columns, channels)."""
    image.channels = array.shape[2]
    image.texel = lib.LMP_TEXEL_HALF if array.dtype == np.float16 else lib.LMP_TEXEL_FLOAT
    image.row_stride, image.texel_stride, image.channel_stride = array.strides


def project_latlong(bands: int, image: ArrayLike, *, azimuth: float = 0, mirrored: bool = False,
                    z_up: bool = False) -> NDArray[np.float32]:
    """Project a latitude-longitude image of the surroundings, which has at least 4 x `bands` rows.

    Parameters
    ----------
    image : array_like of float32 or float16, (height, width) or (height, width, channels)
        The upper edge of row 0 is up (+y); the center column shows +x, and columns run toward +z.
    azimuth : float
        Of the center column, radians from +x toward +z.
    mirrored : bool
        Columns run from +z toward -z.
    z_up : bool
        (x, y, z) of a y-up world is (x, -z, y) in the image's.

    Returns
    -------
    ndarray of float32, (n²,) or (channels, n²)
    """
    n = _core.bands(bands)
    array = _texels("image", image)
    if array.ndim not in (2, 3):
        raise ValueError("image must have the shape (height, width[, channels]), "
                         f"not {array.shape}")
    if len(array) < 4 * n:
        raise ValueError(f"image must have at least {4 * n} rows for {n} bands, not {len(array)}")
    planes = array[..., np.newaxis] if array.ndim == 2 else array
    latlong = ffi.new("lmp_latlong *")
    latlong.pixels = _arrays.pointer(planes, "void *")
    latlong.height, latlong.width = planes.shape[:2]
    _fill_texels(latlong, planes)
    latlong.azimuth = _core.number("azimuth", azimuth)
    latlong.mirrored, latlong.z_up = bool(mirrored), bool(z_up)
    result = np.empty((planes.shape[2], n * n), np.float32)
    lib.lmp_sh_project_latlong(n, latlong, ffi.from_buffer("float[]", result))
    return result[0] if array.ndim == 2 else result


def project_cubemap(bands: int, faces: ArrayLike, *,
                    left_handed: bool = False) -> NDArray[np.float32]:
    """Project a cube map of float32 or float16, (6, size, size) or (6, size, size, channels).

    Its faces are +x, -x, +y, -y, +z, -z, as OpenGL, Vulkan and Direct3D store them; `left_handed`
    ones have their z at -z. Returns (n²,) or (channels, n²)."""
    n = _core.bands(bands)
    array = _texels("faces", faces)
    if array.ndim not in (3, 4) or array.shape[0] != 6 or array.shape[1] != array.shape[2]:
        raise ValueError("faces must have the shape (6, size, size[, channels]), "
                         f"not {array.shape}")
    planes = array[..., np.newaxis] if array.ndim == 3 else array
    cubemap = ffi.new("lmp_cubemap *")
    for i, face in enumerate(planes):
        cubemap.faces[i] = _arrays.pointer(face, "void *")
    cubemap.size = planes.shape[1]
    _fill_texels(cubemap, planes[0])
    cubemap.left_handed = bool(left_handed)
    result = np.empty((planes.shape[3], n * n), np.float32)
    lib.lmp_sh_project_cubemap(n, cubemap, ffi.from_buffer("float[]", result))
    return result[0] if array.ndim == 3 else result


# --- products ---------------------------------------------------------------------------------


def multiply_few(a: ArrayLike, b: ArrayLike, *, out: NDArray | None = None) -> NDArray:
    """Multiply functions of 1 … 6 bands: the first n bands of the product, coefficients (…, n²)."""
    n, a = _arrays.coefficients("a", a, most=_core.constants.SH_FEW_BANDS)
    b = _arrays.numbers("b", b, (n * n,))
    return _arrays.each(out, (n * n,), lambda x, y, c: lib.lmp_sh_multiply_few(n, x, y, c),
                        ("a", a, 1, "float *"), ("b", b, 1, "float *"))


class Product(_core.Owner):
    """A quadrature grid for products of functions of any number of bands."""

    __slots__ = ("bands",)

    def __init__(self, bands: int):
        n = self.bands = _core.bands(bands)
        self._own(_host.created("lmp_sh_product", lambda host, product:
                                lib.lmp_sh_product_create(host, n, product)),
                  lib.lmp_sh_product_destroy)

    def multiply(self, a: ArrayLike, b: ArrayLike, *, out: NDArray | None = None) -> NDArray:
        """Multiply functions, coefficients (…, n²), as `multiply_few` does."""
        shape = (self.bands ** 2,)
        a, b = _arrays.numbers("a", a, shape), _arrays.numbers("b", b, shape)
        return _arrays.each(out, shape, lambda x, y, c: lib.lmp_sh_multiply(self._c, x, y, c),
                            ("a", a, 1, "float *"), ("b", b, 1, "float *"))


# --- half precision ---------------------------------------------------------------------------


def pack_half(values: ArrayLike) -> NDArray[np.float16]:
    """Round floats of any shape to float16: to nearest, ties to even, from 65520 on to infinity."""
    array = np.ascontiguousarray(_arrays.numbers("values", values))
    halves = np.empty(array.shape, np.float16)
    lib.lmp_sh_pack_half_n(ffi.from_buffer("float[]", array), array.size,
                           _arrays.pointer(halves, "uint16_t *"))
    return halves


def unpack_half(halves: ArrayLike) -> NDArray[np.float32]:
    """Floats of float16 numbers, or of their bits as uint16, of any shape."""
    array = np.ascontiguousarray(halves)
    if array.dtype not in (np.float16, np.uint16):
        raise TypeError(f"halves must be of float16 or uint16, not {array.dtype}")
    values = np.empty(array.shape, np.float32)
    lib.lmp_sh_unpack_half_n(_arrays.pointer(array, "uint16_t *"), array.size,
                             ffi.from_buffer("float[]", values))
    return values


# --- in double --------------------------------------------------------------------------------


def eval_double(bands: int, directions: ArrayLike, *,
                out: NDArray | None = None) -> NDArray[np.float64]:
    """Evaluate Y_lm as `eval` does, in double: within 1e-13 up to 20 bands."""
    n, ways = _core.bands(bands), _arrays.directions("directions", directions, _double)
    return _arrays.each(out, (n * n,), lambda way, sh: lib.lmp_sh_eval_double(n, way, sh),
                        ("directions", ways, 1, "double *"), dtype=_double, ctype="double *")


def eval_gradient_double(bands: int, directions: ArrayLike) -> tuple[NDArray, NDArray]:
    """Evaluate Y_lm (…, n²) and its surface gradient (…, 3, n²) as `eval_gradient` does, in
    double."""
    n, ways = _core.bands(bands), _arrays.directions("directions", directions, _double)
    gradient = np.empty(ways.shape[:-1] + (3, n * n))
    sh = _arrays.each(None, (n * n,),
                      lambda way, slope, sh: lib.lmp_sh_eval_gradient_double(n, way, sh, slope),
                      ("directions", ways, 1, "double *"), ("gradient", gradient, 2, "double *"),
                      dtype=_double, ctype="double *")
    return sh, gradient


def eval_hessian_double(bands: int, directions: ArrayLike, *,
                        out: NDArray | None = None) -> NDArray[np.float64]:
    """Evaluate the second derivatives (…, 6, n²) of Y_lm(v / |v|): d²/dx², dx dy, dx dz, dy²,
    dy dz, dz². Their trace is -l(l+1) Y_lm."""
    n, ways = _core.bands(bands), _arrays.directions("directions", directions, _double)
    return _arrays.each(out, (6, n * n), lambda way, h: lib.lmp_sh_eval_hessian_double(n, way, h),
                        ("directions", ways, 1, "double *"), dtype=_double, ctype="double *")


def make_rotation_double(bands: int, rotation: ArrayLike) -> NDArray[np.float64]:
    """Matrices of a rotation as `make_rotation` makes them, in double."""
    n = _core.bands(bands)
    quaternions = _arrays.finite("rotation", _arrays.numbers("rotation", rotation, (4,), _double))
    if not quaternions.any(axis=-1).all():
        raise ValueError("rotation must not be 0")
    return _arrays.each(None, (rotation_count(n),),
                        lambda q, m: lib.lmp_sh_make_rotation_double(n, q, m),
                        ("rotation", quaternions, 1, "double *"), dtype=_double, ctype="double *")


def rotate_double(matrices: ArrayLike, sh: ArrayLike, *,
                  out: NDArray | None = None) -> NDArray[np.float64]:
    """Rotate coefficients (…, n²) by the matrices of `make_rotation_double`."""
    n, c = _arrays.coefficients("sh", sh, dtype=_double)
    m = _arrays.numbers("matrices", matrices, (rotation_count(n),), _double)
    return _arrays.each(out, (n * n,), lambda m, c, r: lib.lmp_sh_rotate_double(n, m, c, r),
                        ("matrices", m, 1, "double *"), ("sh", c, 1, "double *"), dtype=_double,
                        ctype="double *")
