# SPDX-License-Identifier: MIT
"""conan_create.py RECIPE WORK: runs a recipe as Conan would, with stand-ins for its modules, and leaves its package in
WORK/package. Kernels are built plainly, to be quick."""
import importlib.util
import os
import shutil
import subprocess
import sys
import types
from pathlib import Path

recipe_path, work = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()


class Values(dict):
    __getattr__ = dict.__getitem__


class Toolchain:
    values = {}

    def __init__(self, recipe):
        self.cache_variables = {}

    def generate(self):
        Toolchain.values = self.cache_variables


class CMake:
    def __init__(self, recipe):
        self.recipe = recipe

    def configure(self):
        on = {True: "ON", False: "OFF"}
        values = {"CMAKE_BUILD_TYPE": "Release", "CMAKE_INSTALL_PREFIX": work / "package", "CMAKE_INSTALL_LIBDIR": "lib", "LAMPION_UNROLL": "OFF",
                  **{key: on[value] for key, value in Toolchain.values.items()}}
        subprocess.run(["cmake", "-G", "Ninja", "-S", self.recipe.source_folder, "-B", self.recipe.build_folder, *(f"-D{key}={value}" for key, value in values.items())], check=True)

    def build(self):
        subprocess.run(["cmake", "--build", self.recipe.build_folder], check=True)

    def install(self):
        subprocess.run(["cmake", "--install", self.recipe.build_folder], check=True)


def copy(recipe, pattern, src, dst):
    """Conan's patterns match whole paths: a star matches folders, too."""
    found = [path for path in Path(src).glob(pattern.replace("/*", "/**/*")) if path.is_file()]
    assert found, f"no file is {pattern}"
    for path in found:
        to = Path(dst) / path.relative_to(src)
        to.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, to)


def rmdir(recipe, path):
    shutil.rmtree(path)


names = {"conan": {"ConanFile": object}, "conan.tools": {},
         "conan.tools.cmake": {"CMake": CMake, "CMakeDeps": lambda recipe: types.SimpleNamespace(generate=lambda: None),
                               "CMakeToolchain": Toolchain, "cmake_layout": lambda recipe: None},
         "conan.tools.files": {"copy": copy, "load": lambda recipe, path: Path(path).read_text(), "rmdir": rmdir}}
for name, members in names.items():
    module = sys.modules[name] = types.ModuleType(name)
    vars(module).update(members)

spec = importlib.util.spec_from_file_location("conanfile", recipe_path)
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
recipe = module.Lampion()
recipe.recipe_folder = str(recipe_path.parent)
recipe.export_sources_folder = recipe.source_folder = str(work / "sources")
recipe.build_folder, recipe.package_folder = str(work / "build"), str(work / "package")
recipe.options = Values(recipe.default_options, simd=False)
recipe.settings = Values(os="Linux")
recipe.cpp_info = types.SimpleNamespace()
recipe.set_version()
for step in ("export_sources", "layout", "generate", "build", "package", "package_info"):
    getattr(recipe, step)()
print(f"{recipe.name}/{recipe.version}", *(f"-l{name}" for name in recipe.cpp_info.libs + recipe.cpp_info.system_libs))
