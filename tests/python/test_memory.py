# SPDX-License-Identifier: MIT
"""Objects free what they own, also after errors; many threads read at once."""
import copy
import gc
import pickle
import threading

import numpy as np

from lampion import Error, brdf, field, light, preintegrated, sh, sphere, transfer
from oracle import Case

lights = light.sphere([[0, 3, 0]], 0.5, [1, 2, 3])


def resident():
    """Bytes of this process's own memory."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * 4096


class Copies(Case):
    def test_what_has_bytes_is_copied_and_pickled(self):
        grid = field.Field(3, nodes=4)
        grid.update(lights)
        table = brdf.Table(brdf.create_lambert(0.5), 2, views=2)
        for thing in (grid, table, preintegrated.Lobe(3), preintegrated.Brdf(table)):
            for other in (copy.copy(thing), copy.deepcopy(thing),
                          pickle.loads(pickle.dumps(thing))):
                self.assertIs(type(other), type(thing))
                self.assertEqual(other.write(), thing.write())
        other = copy.copy(grid)
        other.update(light.join(lights, lights))
        self.assertEqual((grid.describe().light_count, other.describe().light_count), (1, 2))

    def test_others_say_that_they_are_not(self):
        for thing in (sh.Product(3), brdf.create_lambert(0.5)):
            for way in (copy.copy, copy.deepcopy, pickle.dumps):
                with self.assertRaisesRegex(TypeError, "can be neither copied nor pickled"):
                    way(thing)

    def test_an_error_passes_between_processes(self):
        try:
            field.Field.read(b"no field")
        except Error as error:
            other = pickle.loads(pickle.dumps(error))
            self.assertEqual((str(other), other.result, other.offset),
                             (str(error), error.result, error.offset))
        self.assertEqual(str(copy.copy(Error("text", "memory"))), "text")

    def test_repr_tells_what_an_object_is(self):
        grid = field.Field(3, nodes=4, light_max=8)
        grid.update(lights)
        for words in ("<lampion.field.Field: bands=3", "nodes=(4, 4, 4)", "light_count=1"):
            self.assertIn(words, repr(grid))
        self.assertEqual(repr(sh.Product(3)), "<lampion.sh.Product>")


class Memory(Case):
    def grows(self, make, times):
        """How many bytes a call leaves behind, from the second half of the calls."""
        for _ in range(times // 2):
            make()
        gc.collect()
        before = resident()
        for _ in range(times // 2):
            make()
        gc.collect()
        return (resident() - before) / (times // 2)

    def test_objects_are_freed(self):
        def stop(done):
            if done == 1:  # too late: the object is there
                raise KeyboardInterrupt

        lambert = brdf.create_lambert(0.5)
        table = brdf.Table(lambert, 1, views=2)
        data = table.write()
        makers = {
            "brdf": (lambda: brdf.create_ggx(0.5, 0.5), 10000),
            "product": (lambda: sh.Product(2), 10000),
            "table": (lambda: brdf.Table.read(data).coefficients(), 10000),
            "field": (lambda: field.Field(1, nodes=(2, 2, 2), light_max=1).update(lights), 10000),
            "transfer": (lambda: transfer.Transfer([[0, 0, 0]], [[0, 1, 0]], 0, 1, [[0]]), 10000),
            "call": (lambda: light.project(2, lights, [[0, 0, 0]]), 10000),
            "error": (lambda: self.refused("", brdf.Table.read, data[:30], kind=Error), 10000),
            "lobe": (lambda: preintegrated.Lobe(1), 40),
            "stopped": (lambda: self.refused("", preintegrated.Lobe, 1, progress=stop,
                                             kind=KeyboardInterrupt), 40)}
        for name, (make, times) in makers.items():
            with self.subTest(name):
                # the smallest of these objects takes more than a hundred bytes
                self.assertLess(self.grows(make, times), 60 if times > 100 else 5000)

    def test_threads(self):
        grid = field.Field(3, nodes=(4, 4, 4), origin=(-2, -2, -2))
        grid.update(lights)
        points = np.random.default_rng(1).uniform(-2, 2, (2000, 3)).astype(np.float32)
        expected = grid.eval(points), sphere.project(5, [0, 0, 9], 1, points)
        failures = []

        def work():
            for _ in range(20):
                found = grid.eval(points), sphere.project(5, [0, 0, 9], 1, points)
                if not all(np.array_equal(a, b) for a, b in zip(found, expected)):
                    failures.append(found)

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])

    def test_the_lock_is_released(self):
        # another thread goes on while the library works
        points = np.zeros((40000, 3), np.float32)
        counted, done = [0], threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1

        thread = threading.Thread(target=count)
        thread.start()
        sphere.project(40, [0, 0, 9], 1, points[:2000])
        before = counted[0]
        sphere.sum(40, np.random.default_rng(1).normal(size=(50, 3)), 0.1, [1, 1, 1],
                   points[:2000])
        after = counted[0]
        done.set()
        thread.join()
        self.assertGreater(after, before)
