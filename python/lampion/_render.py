# SPDX-License-Identifier: MIT
"""Images by the program `lampion`."""
from __future__ import annotations

import os
import shutil
import struct
import subprocess
import tempfile
import zlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._core import Error, integer


def render(scene: str | os.PathLike, *, size: tuple[int, int] = (640, 360),
           timeout: float | None = None, **options: Any) -> NDArray[np.float32]:
    """Render a scene by the program `lampion`, which LAMPION_PROGRAM names or PATH has.

    Parameters
    ----------
    scene : path
        A file of the user's, or one that the program has: ``"builtin:atrium"``,
        ``"builtin:ball"``, ``"builtin:balls"`` or ``"builtin:room"``.
    size : (width, height)
        The program alone would draw 1280 x 720.
    timeout : float, optional
        In seconds; subprocess.TimeoutExpired says that they passed.
    **options
        Those of ``lampion render --help``, with _ for -: ``bands=8``, ``random_lights=30``,
        ``eye=(0, 2, 5)``. True gives an option that takes no value, None leaves it
        out, and False turns it off: ``shadows=False``.

    Returns
    -------
    ndarray of float32, (height, width, 3)
        Linear radiance; row 0 is the upper one.

    Raises
    ------
    Error
        What the program says.
    """
    if np.shape(size) != (2,):
        raise ValueError(f"size must be width and height, not {size!r:.60}")
    width, height = (integer("size", number, 1, 16384) for number in size)
    program = os.environ.get("LAMPION_PROGRAM") or shutil.which("lampion")
    if not program:
        raise Error("the program lampion is not on PATH, and LAMPION_PROGRAM does not name it: "
                    "install it, or let LAMPION_PROGRAM name it", "program")
    with tempfile.TemporaryDirectory(prefix="lampion-") as folder:
        image = Path(folder, "image.exr")
        # What follows -- cannot be taken for an option.
        command = [program, "render", f"--size={width}x{height}", f"--output={image}", "--quiet",
                   *_arguments(options), "--", os.fspath(scene)]
        try:
            done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, timeout=timeout, check=False)
        except OSError as problem:
            raise Error(f"the program {program} does not start: {problem.strerror}",
                        "program") from None
        if done.returncode or not image.exists():
            lines = done.stderr.decode(errors="replace").strip().splitlines()
            line = lines[-1] if lines else f"{program} ended with status {done.returncode}"
            raise Error(line.removeprefix("lampion: "), "program")
        return read_exr(image.read_bytes())


#: What is on unless an option --no-… turns it off.
_TURNED_OFF = ("shadows", "shadow_filter")


def _arguments(options: dict[str, Any]) -> list[str]:
    """The options as the program takes them, each in one word with its value."""
    words = []
    for name, value in options.items():
        if name in ("output", "o", "size", "s", "help", "frames", "shard"):
            raise ValueError(f"{name} is not an option here: an array is returned")
        if not name.isidentifier() or not name.isascii():
            raise ValueError(f"{name!r} is not the name of an option")
        option = "--" + name.replace("_", "-")
        if value is True:
            words.append(option)
        elif value is False and name in _TURNED_OFF:
            words.append("--no-" + name.replace("_", "-"))
        elif value is not None and value is not False:
            if isinstance(value, (tuple, list, np.ndarray)):
                value = ",".join(str(float(number)) for number in value)
            text = os.fspath(value) if isinstance(value, os.PathLike) else str(value)
            if "\0" in text:
                raise ValueError(f"{name} has a zero byte")
            words.append(f"{option}={text}")
    return words


def read_exr(data: bytes) -> NDArray[np.float32]:
    """The red, green and blue of an OpenEXR file as the program writes it: one part, in scanlines
    of float32, not compressed or by ZIP."""
    try:
        return _read_exr(data)
    except (IndexError, KeyError, ValueError, struct.error, zlib.error):
        raise Error("not an OpenEXR file as the program writes it", "format") from None


def _read_exr(data: bytes) -> NDArray[np.float32]:
    if data[:8] != struct.pack("<II", 20000630, 2):
        raise Error("not an OpenEXR file of one part in scanlines", "format", 0)
    at = 8
    attributes = {}
    while data[at]:
        name, kind = (data[at:].split(b"\0", 2)[part] for part in (0, 1))
        at += len(name) + len(kind) + 2
        (length,) = struct.unpack_from("<I", data, at)
        attributes[name.decode()] = data[at + 4:at + 4 + length]
        at += 4 + length
    at += 1
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    channels = _channels(attributes["channels"])
    rows = {0: 1, 2: 1, 3: 16}.get(attributes["compression"][0])
    if rows is None:
        raise Error("a compression other than ZIP", "format", at)
    planes = np.empty((height, len(channels), width), np.float32)
    for (offset,) in struct.iter_unpack("<Q", data[at:at + 8 * -(-height // rows)]):
        row, length = struct.unpack_from("<iI", data, offset)
        part = planes[row - top:row - top + rows]
        packed = data[offset + 8:offset + 8 + length]
        part[...] = _unpacked(packed, part.nbytes).reshape(part.shape)
    return np.stack([planes[:, channels.index(name)] for name in "RGB"], axis=-1)


def _channels(data: bytes) -> list[str]:
    """Names of the channels, in the order of their planes."""
    names = []
    while data[0]:
        name, rest = data.split(b"\0", 1)
        if rest[:4] != struct.pack("<I", 2):
            raise Error(f"channel {name.decode()} is not of float32", "format")
        names.append(name.decode())
        data = rest[16:]
    return names


def _unpacked(packed: bytes, size: int) -> NDArray[np.float32]:
    """A chunk; one that compression would not shrink is stored as it is."""
    if len(packed) == size:
        return np.frombuffer(packed, "<f4")
    coded = np.frombuffer(zlib.decompress(packed), np.uint8)
    # ZIP stores differences between bytes, those at even places before those at odd ones.
    coded = np.cumsum(coded.astype(np.int64) - np.r_[0, np.full(size - 1, 128)]).astype(np.uint8)
    bytes_ = np.empty(size, np.uint8)
    bytes_[0::2], bytes_[1::2] = coded[:(size + 1) // 2], coded[(size + 1) // 2:]
    return bytes_.view("<f4")
