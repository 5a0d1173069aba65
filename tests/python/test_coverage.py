# SPDX-License-Identifier: MIT
"""Every function of the public headers is called by the package, or excluded for a reason; what
was generated from the headers has their numbers."""
import inspect
import os
import re
import unittest
from pathlib import Path

import lampion

batch = "the batch takes its place, of one element or of many"
excluded = {
    "lmp_sh_eval": batch,
    "lmp_sh_eval_gradient": batch,
    "lmp_sh_dot": batch,
    "lmp_sphere_project_zonal": batch,
    "lmp_sphere_project": batch,
    "lmp_light_project": batch,
    "lmp_light_project_channels": "out= has any strides",
    "lmp_shade": batch,
    "lmp_shade_environment": batch,
}


def declared():
    names = set()
    for path in Path(os.environ["LAMPION_HEADERS"]).glob("*.h"):
        code = re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.S)
        code = re.sub(r"^ *#.*$", "", code, flags=re.M)
        names.update(re.findall(r"LMP_API\b[^;(]*?\b(lmp_\w+)\(", code))
    return names


everything = "".join(path.read_text() for path in Path(lampion.__file__).parent.glob("*.py"))


def called():
    code = "".join(path.read_text() for path in Path(lampion.__file__).parent.glob("*.py")
                   if path.name != "_native.py")
    return set(re.findall(r"\blib\.(lmp_\w+)", code))


class Coverage(unittest.TestCase):
    def test_every_function_is_wrapped_or_excluded(self):
        names = declared()
        self.assertGreater(len(names), 150)
        self.assertEqual(names - called() - excluded.keys(), set())

    def test_modules_offer_what_is_theirs(self):
        for name in lampion.__all__:
            module = getattr(lampion, name)
            if not inspect.ismodule(module):
                continue
            self.assertEqual(dir(module), sorted(module.__all__))
            for member in module.__all__:
                made_in = getattr(getattr(module, member), "__module__", module.__name__)
                self.assertEqual(made_in, module.__name__, f"{name}.{member}")
            documented = re.findall(r"^(?:def|class) ([a-z]\w*|[A-Z]\w*)",
                                    Path(module.__file__).read_text(), re.M)
            for member in set(documented) - set(module.__all__):
                self.assertTrue(re.search(rf"\bimport .*\b{member}\b|\b_?{name}\.{member}\b",
                                          everything), f"{name}.{member} is neither public nor used")
        self.assertIn("version", dir(lampion))
        self.assertNotIn("lib", dir(lampion))

    def test_what_is_excluded_exists_and_is_not_called(self):
        self.assertEqual(excluded.keys() - declared(), set())
        self.assertEqual(excluded.keys() & called(), set())

    def test_modules_build_on_the_modules_that_their_headers_include(self):
        headers = Path(os.environ["LAMPION_HEADERS"])

        def below(name):
            direct = re.findall(r"#include <lampion/(\w+)\.h>", (headers / f"{name}.h").read_text())
            return set(direct).union(*map(below, direct))

        for path in Path(lampion.__file__).parent.glob("[a-z]*.py"):
            code = path.read_text()
            used = re.findall(r"^from \.([a-z]\w*) import", code, re.M)
            for names in re.findall(r"^from \. import (.*)$", code, re.M):
                used += re.findall(r"\b[a-z]\w*", re.sub(r" as \w+", "", names))
            with self.subTest(path.stem):
                self.assertEqual(set(used) - below(path.stem), set())

    def test_constants_are_those_of_the_headers(self):
        text = "".join(path.read_text() for path in Path(os.environ["LAMPION_HEADERS"]).glob("*.h"))
        plain = re.findall(r"^#define LMP_(\w+) +(\d[\d.]*(?:e-?\d+)?)[fu]?$", text, re.M)
        self.assertGreater(len(plain), 30)
        for name, digits in plain:
            self.assertEqual(getattr(lampion.constants, name), float(digits), name)

    def test_versions_agree(self):
        self.assertEqual(lampion.version(), lampion.__version__)

    def test_every_public_name_has_a_docstring(self):
        bare = []
        for module in (lampion.sh, lampion.sphere, lampion.light, lampion.lobe, lampion.probe,
                       lampion.brdf, lampion.preintegrated, lampion.material, lampion.shade,
                       lampion.field, lampion.transfer, lampion.cpu):
            for name, value in vars(module).items():
                ours = getattr(value, "__module__", None) == module.__name__
                if not ours or name.startswith("_"):
                    continue
                members = vars(value).items() if isinstance(value, type) else []
                things = [(name, value)] + [(f"{name}.{key}", inner) for key, inner in members
                                            if not key.startswith("_") and callable(inner)]
                bare += [f"{module.__name__}.{key}" for key, thing in things if not thing.__doc__]
        self.assertEqual(bare, [])
