# SPDX-License-Identifier: MIT
"""Lampion: lighting by glowing spheres through spherical harmonics, for NumPy.

The modules are named as the headers of the C library, and their functions as those of C without
prefix: `lampion.sphere.project` is lmp_sphere_project_n. Arrays of float32 are passed without
copies, arguments broadcast, and what the library requires of its caller is checked: a bad argument
raises TypeError or ValueError. The values of large arrays of points alone are not looked at; of NaN
comes NaN.

The global interpreter lock is released while the library works, so threads shade in parallel.
Objects may be shared among threads unless a method changes them.
"""
from . import (brdf, cpu, field, light, lobe, material, preintegrated, probe, sh, shade, sphere,
               transfer)
from ._core import Error, constants, lib
from ._render import render


def version() -> str:
    """The version of the shared library."""
    number = lib.lmp_version()
    return f"{number >> 16}.{number >> 8 & 255}.{number & 255}"


__version__ = (f"{constants.VERSION_MAJOR}.{constants.VERSION_MINOR}."
               f"{constants.VERSION_PATCH}")
__all__ = ["Error", "brdf", "constants", "cpu", "field", "light", "lobe", "material",
           "preintegrated", "probe", "render", "sh", "shade", "sphere", "transfer", "version"]

# Completion offers what a user may call, not what a module imports.
for _module in (brdf, cpu, field, light, lobe, material, preintegrated, probe, sh, shade, sphere,
                transfer):
    setattr(_module, "__dir__", lambda names=_module.__all__: names)


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
