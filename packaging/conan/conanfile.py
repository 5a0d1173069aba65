# SPDX-License-Identifier: MIT
"""The library for Conan 2, from the folder that this recipe is in: conan create packaging/conan."""
import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir

SOURCES = ("CMakeLists.txt", "CHANGELOG.md", "LICENSE", "cmake/*", "examples/*", "include/*", "ruler/*", "shaders/*", "src/*")


class Lampion(ConanFile):
    name = "lampion"
    description = "Real-time lighting by glowing spheres through spherical harmonics"
    topics = ("spherical-harmonics", "lighting", "graphics", "rendering")
    license = "MIT"
    package_type = "library"
    settings = "os", "compiler", "build_type", "arch"
    options = {"shared": [True, False], "fPIC": [True, False], "simd": [True, False]}
    default_options = {"shared": False, "fPIC": True, "simd": True}
    implements = ["auto_shared_fpic"]
    languages = "C"

    def _tree(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        numbers = re.findall(r"#define LMP_VERSION_M[A-Z]* +(\d+)|#define LMP_VERSION_PATCH +(\d+)",
                             load(self, os.path.join(self._tree(), "include", "lampion", "base.h")))
        self.version = ".".join(major or patch for major, patch in numbers)

    def export_sources(self):
        for pattern in SOURCES:
            copy(self, pattern, self._tree(), self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables.update({"LAMPION_PROGRAM": False, "LAMPION_TESTS": False, "LAMPION_SIMD": bool(self.options.simd)})
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()
        for folder in ("lib/cmake", "lib/pkgconfig"):  # Conan writes its own
            rmdir(self, os.path.join(self.package_folder, folder))

    def package_info(self):
        self.cpp_info.libs = ["lampion"]
        if self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["m"]
