# SPDX-License-Identifier: MIT
"""lampion.render: the program's images as arrays, and its errors as exceptions."""
import os
import struct
import tempfile
import zlib
from pathlib import Path
from unittest import mock

import numpy as np

import lampion
from lampion._render import read_exr
from oracle import Case


def written(image, compression):
    """An OpenEXR file by the rules of its format, with channels that nobody asked for."""
    height, width, _ = image.shape
    channels = {"A": np.ones((height, width), "f4"), "B": image[..., 2], "G": image[..., 1],
                "R": image[..., 0]}
    box = struct.pack("<4i", -2, 5, width - 3, height + 4)
    names = b"".join(name.encode() + b"\0" + struct.pack("<IIII", 2, 0, 1, 1)
                     for name in channels)
    head = struct.pack("<II", 20000630, 2)
    for name, kind, value in (("channels", "chlist", names + b"\0"),
                              ("compression", "compression", bytes([compression])),
                              ("dataWindow", "box2i", box), ("lineOrder", "lineOrder", b"\0")):
        head += f"{name}\0{kind}\0".encode() + struct.pack("<I", len(value)) + value
    head += b"\0"
    rows = 16 if compression else 1
    chunks = []
    for first in range(0, height, rows):
        data = b"".join(plane[row].astype("<f4").tobytes()
                        for row in range(first, min(first + rows, height))
                        for plane in channels.values())
        if compression:
            split = data[0::2] + data[1::2]
            packed = zlib.compress(bytes([split[0]]) + bytes(
                (b - a + 128) % 256 for a, b in zip(split, split[1:])))
            data = packed if len(packed) < len(data) else data
        chunks.append(struct.pack("<iI", first + 5, len(data)) + data)
    at = len(head) + 8 * len(chunks)
    starts = np.cumsum([at] + [len(chunk) for chunk in chunks])[:-1]
    return head + starts.astype("<u8").tobytes() + b"".join(chunks)


class Render(Case):
    def test_an_image(self):
        image = lampion.render("builtin:ball", size=(48, 40), bands=4, method="zonal")
        self.assertEqual((image.shape, image.dtype), ((40, 48, 3), np.float32))
        self.assertTrue(np.isfinite(image).all())
        self.assertGreater(image.max(), 0)
        same = lampion.render(Path("builtin:ball"), size=[48, 40], bands=4, method="zonal",
                              random_lights=None, strict=False)
        self.same(same, image)
        dark = lampion.render("builtin:ball", size=(48, 40), random_lights=0, hide_lights=True,
                              bands=4, background=(0, 0, 0.25), shadows=False,
                              eye=(0, 500, 0), target=np.array([0, 900, 0]))
        self.near(dark, [0, 0, 0.25], 0)  # nothing but the background

    def test_false_turns_off(self):
        made = [lampion.render("builtin:ball", size=(16, 16), **options) for options in
                ({}, {"shadows": False}, {"no_shadows": True}, {"shadow_filter": False},
                 {"no_shadow_filter": True})]
        self.same(made[1], made[2])
        self.same(made[3], made[4])
        self.assertGreater(np.abs(made[1] - made[0]).max(), 0)
        self.assertGreater(np.abs(made[3] - made[0]).max(), 0)

    def test_what_is_stored_is_what_is_read(self):
        random = np.random.default_rng(1)
        smooth = np.linspace(0, 1, 21 * 9 * 3).reshape(21, 9, 3)  # 16 rows and a rest of 5
        for image in (smooth.astype(np.float32), np.exp(random.normal(size=(21, 9, 3)) * 20)
                      .astype(np.float32), random.normal(size=(1, 1, 3)).astype(np.float32)):
            for compression in (0, 3):
                self.same(read_exr(written(image, compression)), image)

    def test_errors_are_one_line(self):
        for options, words in (({"bands": 4000}, "out of range"), ({"no_such": 1}, "no-such"),
                               ({"bands": "four"}, "bands")):
            with self.assertRaises(lampion.Error) as caught:
                lampion.render("builtin:ball", **options)
            self.assertIn(words, str(caught.exception))
            self.assertNotIn("\n", str(caught.exception))
            self.assertEqual(caught.exception.result, "program")
        self.refused("nowhere.gltf", lampion.render, "nowhere.gltf", kind=lampion.Error)

    def test_no_option_comes_in_by_another_way(self):
        with tempfile.TemporaryDirectory() as folder:
            target = os.path.join(folder, "written.png")
            self.refused("", lampion.render, "--output=" + target, kind=lampion.Error)
            self.refused("", lampion.render, "-o" + target, kind=lampion.Error)
            self.refused("", lampion.render, "builtin:ball", method=f"zonal --output={target}",
                         kind=lampion.Error)
            self.refused("not an option", lampion.render, "builtin:ball", output=target)
            self.refused("not the name", lampion.render, "builtin:ball", **{"bands=3 -o": 1})
            self.refused("zero byte", lampion.render, "builtin:ball", method="zonal\0")
            self.assertEqual(os.listdir(folder), [])
        self.refused("-nowhere.gltf: ", lampion.render, "-nowhere.gltf", kind=lampion.Error)
        for size in ((0, 5), 5, (1, 2, 3), None):
            self.refused("size", lampion.render, "builtin:ball", size=size)
        self.refused("size", lampion.render, "builtin:ball", size=("4 --help", 5))

    def test_without_the_program(self):
        with mock.patch.dict(os.environ, {"LAMPION_PROGRAM": "", "PATH": "/nonexistent"}):
            self.refused("is not on PATH", lampion.render, "builtin:ball", kind=lampion.Error)

    def test_other_files_are_refused(self):
        for data in (b"", b"no image at all", b"v/1\x01\x02\0\0\0"):
            self.refused("", read_exr, data, kind=(lampion.Error, ValueError))
