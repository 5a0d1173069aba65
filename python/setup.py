# SPDX-License-Identifier: MIT
"""Packs the folder lampion beside this file, in which wheel.sh has put the shared library, too."""
import re
from pathlib import Path

from setuptools import Distribution, setup

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # before setuptools 70.1
    from wheel.bdist_wheel import bdist_wheel


class Platform(bdist_wheel):
    """Any Python 3, but one platform, for which the library was compiled."""

    def get_tag(self):
        return ("py3", "none", super().get_tag()[2])


class WithLibrary(Distribution):
    def has_ext_modules(self):
        return True


numbers = dict(re.findall(r"'LMP_VERSION_(\w+)': (\d+)", Path("lampion/_native.py").read_text()))
setup(
    name="lampion",
    version="{MAJOR}.{MINOR}.{PATCH}".format(**numbers),
    description="Lighting by glowing spheres through spherical harmonics, for NumPy",
    license="MIT",
    python_requires=">=3.9",
    install_requires=["cffi", "numpy>=1.21"],
    packages=["lampion"],
    package_data={"lampion": ["py.typed", "liblampion.so.*"]},
    cmdclass={"bdist_wheel": Platform},
    distclass=WithLibrary,
)
