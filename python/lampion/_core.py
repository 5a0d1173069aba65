# SPDX-License-Identifier: MIT
"""The shared library, its errors and types, and checks of single values. A release build of the
library trusts its caller: here is what checks in its place, before C is called."""
from __future__ import annotations

import enum
import math
import operator
import os
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from ._native import CONSTANTS, ffi

#: The numbers of the headers without their prefix: ``constants.BANDS_MAX`` is ``LMP_BANDS_MAX``.
constants = SimpleNamespace(**{name[4:]: value for name, value in CONSTANTS.items()})

_version = (constants.VERSION_MAJOR, constants.VERSION_MINOR)


def _open() -> Any:
    """Opens the library that LAMPION_LIBRARY names, or the one beside this file, as in a wheel, or
    the one that the system finds."""
    soname = "liblampion.so.{}.{}".format(*_version)
    beside = Path(__file__).with_name(soname)
    name = os.environ.get("LAMPION_LIBRARY") or (str(beside) if beside.exists() else soname)
    try:
        library = ffi.dlopen(name)
    except OSError as error:
        raise ImportError(
            f"lampion: {error}: install the package of the library, or let LAMPION_LIBRARY name it"
        ) from None
    # Structures of another version may have another layout.
    found = library.lmp_version()
    if (found >> 16, found >> 8 & 255) != _version:
        raise ImportError(f"lampion: {name} is of version {found >> 16}.{found >> 8 & 255}, "
                          "this package of {}.{}".format(*_version))
    return library


lib = _open()


class Error(Exception):
    """What the library could not do.

    Attributes
    ----------
    result : str
        ``"argument"``, ``"memory"``, ``"format"``, ``"version"``, ``"checksum"`` or
        ``"cancelled"``; ``"program"`` if the program ``lampion`` failed.
    offset : int or None
        Of the first byte concerned, where bytes were read.
    """

    def __init__(self, text: str, result: str, offset: int | None = None):
        super().__init__(text)
        self.result = result
        self.offset = offset

    def __reduce__(self) -> Any:
        # so that processes can send it to each other
        return Error, (str(self), self.result, self.offset)


Error.__module__ = "lampion"


def check(result: int, error: Any = None) -> None:
    """Raises what a result other than LMP_OK says; error is an lmp_parse_error."""
    if result == lib.LMP_OK:
        return
    name = ffi.typeof("lmp_result").elements[result][len("LMP_ERROR_"):].lower()
    if error:
        raise Error(ffi.string(error.text).decode(), name, error.offset)
    raise Error(ffi.string(lib.lmp_result_text(result)).decode(), name)


# --- types ------------------------------------------------------------------------------------


def enumeration(name: str, ctype: str, module: str) -> Any:
    """The enumerators of ctype without their common prefix, as a class of a module."""
    elements = ffi.typeof(ctype).elements
    prefix = os.path.commonprefix(list(elements.values()))
    prefix = prefix[:prefix.rindex("_") + 1]
    members = {text[len(prefix):]: value for value, text in sorted(elements.items())}
    make: Any = enum.IntEnum  # of which mypy wants a name that it can read
    made = make(name, members, module=module)
    made.__doc__ = f"The enumerators of {ctype}."
    return made


_vectors = {"struct lmp_vec3": 3, "struct lmp_rgb": 3, "struct lmp_quat": 4}
_numbers = {"float": np.float32, "double": np.float64, "int": np.intc, "_Bool": np.bool_,
            "size_t": np.uintp, "uint32_t": np.uint32, "int16_t": np.int16,
            "signed char": np.int8}


def dtype_of(ctype: Any) -> np.dtype:
    """The NumPy type of the same layout as a C type. Of a union it has the first of the largest
    members, because NumPy can neither join nor save arrays whose members overlap; vectors and
    colors are arrays of their components, and pointers are addresses."""
    ctype = ffi.typeof(ctype) if isinstance(ctype, str) else ctype
    if ctype.cname in _vectors:
        return np.dtype((np.float32, _vectors[ctype.cname]))
    if ctype.cname in _numbers:
        return np.dtype(_numbers[ctype.cname])
    if ctype.kind == "enum":
        return np.dtype(np.uint32)
    if ctype.kind == "pointer":
        return np.dtype(np.uintp)
    if ctype.kind == "array":
        return np.dtype((dtype_of(ctype.item), ctype.length))
    fields: dict[int, tuple[str, np.dtype]] = {}
    for name, field in ctype.fields:
        dtype = dtype_of(field.type)
        if field.offset not in fields or fields[field.offset][1].itemsize < dtype.itemsize:
            fields[field.offset] = (name, dtype)
    return np.dtype({"names": [name for name, _ in fields.values()],
                     "formats": [dtype for _, dtype in fields.values()], "offsets": list(fields),
                     "itemsize": ffi.sizeof(ctype)}, align=True)


def record(struct: Any) -> SimpleNamespace:
    """The members of a structure, as Python's numbers, tuples and names; pointers are omitted."""
    members = {}
    for name, field in ffi.typeof(struct).fields:
        value = getattr(struct, name)
        if field.type.kind == "struct":
            vector = field.type.cname in _vectors
            members[name] = vector_of(value) if vector else record(value)
        elif field.type.kind == "enum":
            members[name] = enumerator_name(field.type, value)
        elif field.type.kind == "array":
            members[name] = tuple(value)
        elif field.type.kind != "pointer":
            members[name] = value
    return SimpleNamespace(**members)


def vector_of(struct: Any) -> Any:
    """The components of an lmp_vec3, lmp_rgb or lmp_quat."""
    return tuple(getattr(struct, name) for name, _ in ffi.typeof(struct).fields)


def enumerator_name(ctype: Any, value: int) -> str:
    """An enumerator's name in lower case, without the prefix that all of them have."""
    elements = ctype.elements
    prefix = os.path.commonprefix(list(elements.values()))
    return elements[value][prefix.rindex("_") + 1:].lower()


def _flat(members: SimpleNamespace) -> dict[str, Any]:
    """The members of a record and of the records in it."""
    flat = {}
    for name, value in vars(members).items():
        flat.update(_flat(value) if isinstance(value, SimpleNamespace) else {name: value})
    return flat


def _listed(members: SimpleNamespace) -> str:
    """Members as arguments would be written."""
    return ", ".join(f"{name}={value:g}" if isinstance(value, float) else f"{name}={value!r}"
                     for name, value in _flat(members).items())


class Owner:
    """An object of the library, which is freed with the Python object. The library's objects are
    immutable unless their methods say otherwise: threads may share them."""

    __slots__ = ("_c", "__weakref__")

    def _own(self, pointer: Any, destroy: Any) -> None:
        self._c = ffi.gc(pointer, destroy)

    def __reduce__(self) -> Any:
        raise TypeError(f"a {type(self).__name__} can be neither copied nor pickled: make another")

    def __repr__(self) -> str:
        cls, describe = type(self), getattr(self, "describe", None)
        members = f": {_listed(describe())}" if describe else ""
        return f"<{cls.__module__}.{cls.__qualname__}{members}>"


class _View:
    """Memory that an owner keeps, for NumPy to refer to."""

    def __init__(self, owner: object, interface: dict[str, Any]):
        self.owner = owner
        self.__array_interface__ = interface


def view(owner: object, pointer: Any, shape: tuple[int, ...], dtype: Any) -> np.ndarray:
    """What a pointer into an object leads to, read-only; the array keeps the object alive."""
    dtype = np.dtype(dtype)
    if 0 in shape:
        return np.empty(shape, dtype)
    interface = {"shape": (math.prod(shape) * dtype.itemsize,), "typestr": "|u1", "version": 3,
                 "data": (int(ffi.cast("uintptr_t", pointer)), True)}
    return np.asarray(_View(owner, interface)).view(dtype).reshape(shape)


# --- single values ----------------------------------------------------------------------------


def integer(name: str, value: Any, least: int, most: int) -> int:
    """A whole number in a range."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} must be an integer, not {type(value).__name__}") from None
    if not least <= number <= most:
        raise ValueError(f"{name} must be {least} … {most}, not {number}")
    return number


def integer_or_0(name: str, value: Any, least: int, most: int) -> int:
    """A whole number in a range, or 0, which stands for a default."""
    return 0 if isinstance(value, int) and value == 0 else integer(name, value, least, most)


def number_or_0(name: str, value: Any, least: float, most: float) -> float:
    """A number in a range, or 0, which stands for a default."""
    zero = isinstance(value, (int, float)) and value == 0
    return 0.0 if zero else number(name, value, least, most)


def bands(value: Any, most: int = constants.BANDS_MAX) -> int:
    """A number of bands."""
    return integer("bands", value, 1, most)


def number(name: str, value: Any, least: float = -math.inf, most: float = math.inf) -> float:
    """A finite number in a range, which a float32 can hold."""
    try:
        result = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name} must be a number, not {value!r:.60}") from None
    if not abs(result) <= 3.4028234e38:
        raise ValueError(f"{name} must be finite, not {result}")
    if not least <= result <= most:
        bound = f"at least {least:g}" if most == math.inf else f"{least:g} … {most:g}"
        raise ValueError(f"{name} must be {bound}, not {result:g}")
    return result


def choice(name: str, kinds: Any, value: Any) -> int:
    """An enumerator, by its name in any case, or itself."""
    if not isinstance(value, (str, int)):
        raise TypeError(f"{name} must be a name, not {type(value).__name__}")
    try:
        return int(kinds[value.upper()] if isinstance(value, str) else kinds(value))
    except (KeyError, ValueError):
        names = ", ".join(member.name.lower() for member in kinds)
        raise ValueError(f"{name} must be one of {names}, not {value!r:.60}") from None


def text(pointer: Any) -> str | None:
    """A string of the library's, or None."""
    return ffi.string(pointer).decode() if pointer else None
