# SPDX-License-Identifier: MIT
"""Which instruction set the batch functions use (lampion/cpu.h). Every set gives the same bits."""
from __future__ import annotations

from . import _core
from ._core import ffi, lib

__all__ = ["flags", "limit", "name"]


def flags() -> int:
    """Bits of the sets that this machine has: 1 scalar, 2 SSE2 or NEON, 4 AVX2, 8 AVX-512."""
    return lib.lmp_cpu_flags()


def limit(mask: int) -> int:
    """Limit the whole process to the sets in `mask`, and return the bit of the one now in use;
    15 restores the best."""
    return lib.lmp_cpu_limit(_core.integer("mask", mask, 0, 2**32 - 1))


def name() -> str:
    """The set in use: ``"scalar"``, ``"sse2"``, ``"neon"``, ``"avx2"`` or ``"avx512"``."""
    return ffi.string(lib.lmp_cpu_name()).decode()
