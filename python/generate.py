# SPDX-License-Identifier: MIT
"""Writes the module lampion._native from the public headers, which stay the one home of every
prototype, structure and constant:

    python3 generate.py INCLUDE/lampion OUTPUT

cffi's ABI mode needs no compiler, so what is written serves every architecture: cffi computes the
layout of structures where it is loaded. Macros that are numbers become the dictionary CONSTANTS.
"""
import re
import sys
from pathlib import Path

from cffi import FFI


def read(folder: Path) -> str:
    """The code of all headers, each after those that it includes, without comments and C++."""
    codes = {}
    for path in folder.glob("*.h"):
        code = re.sub(r"/\*.*?\*/", "", path.read_text(encoding="utf-8"), flags=re.S)
        code = code.replace("\\\n", " ")
        code = re.sub(r"^#ifdef __cplusplus\n.*?^#(?:else|endif).*?$", "", code, flags=re.S | re.M)
        codes[path.name] = code
    ordered: list[str] = []

    def add(name: str) -> None:
        if name in ordered:
            return
        for needed in re.findall(r"#include <lampion/(.*)>", codes[name]):
            add(needed)
        ordered.append(name)

    add("lampion.h")
    return "\n".join(codes[name] for name in ordered)


def enumerators(code: str) -> dict[str, int]:
    """The values of all enumerators."""
    values: dict[str, int] = {}
    for body in re.findall(r"typedef enum \w+ \{(.*?)\}", code, flags=re.S):
        value = -1
        for name, _, given in re.findall(r"(\w+)(\s*=\s*(\w+))?", body):
            value = int(given, 0) if given else value + 1
            values[name] = value
    return values


def constants(code: str) -> dict[str, float]:
    """The macros without parameters that are numbers, in terms of others or of enumerators."""
    known = {**enumerators(code), "UINT32_MAX": 2**32 - 1}
    found = {}
    for name, text in re.findall(r"^#define (LMP_\w+)[ \t]+(\S.*)$", code, flags=re.M):
        text = text.replace("(size_t)", "")
        text = re.sub(r"\b([\d.]+(?:e[+-]?\d+)?)[fu]\b", r"\1", text)
        if set(re.findall(r"\b[A-Za-z_]\w*", text)) <= known.keys():
            # C's division of integers is not Python's; the headers have none.
            found[name] = known[name] = eval(text, {"__builtins__": {}}, known)
    return found


def declarations(code: str, known: dict[str, float]) -> str:
    """What cffi's parser takes: types and prototypes, with the lengths of arrays as numbers."""
    code = re.sub(r"^static inline .*?^\}$", "", code, flags=re.S | re.M)
    code = re.sub(r"^#.*$|^\}$", "", code, flags=re.M)
    code = re.sub(r"\bLMP_(API|EXPERIMENTAL)\b", "", code)
    return re.sub(r"\[(LMP_\w+)\]", lambda match: f"[{known[match[1]]}]", code)


def main() -> None:
    code = read(Path(sys.argv[1]))
    known = constants(code)
    builder = FFI()
    builder.cdef(declarations(code, known))
    builder.set_source("lampion._native", None)
    builder.emit_python_code(sys.argv[2])
    with open(sys.argv[2], "a", encoding="utf-8") as file:
        file.write("\nCONSTANTS = {\n")
        file.writelines(f"    {name!r}: {value!r},\n" for name, value in known.items())
        file.write("}\n")


if __name__ == "__main__":
    main()
