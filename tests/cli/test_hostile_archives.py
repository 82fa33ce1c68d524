"""Archives that were made to do harm, with digests that are right: exit code 4, soon and in little memory."""
import json
import os
import random
import shutil
import subprocess
import unittest

import h5py
import numpy as np

from cli_case import BEMPRECOMP, CliCase
from resigned import limit_memory, sign_archive

BEMSIM = os.environ["BEMSIM"]
LIMIT = 20  # seconds that no run here may take
DYNAMIC = ["--dt", "0.01", "--scheme", "bdf1", "--history", "2", "--window", "0.9"]
KINDS = {"lowrank": DYNAMIC, "none": [*DYNAMIC, "--codec", "none"], "haar": [*DYNAMIC, "--codec", "haar"],
         "energies": [*DYNAMIC, "--energies"],
         "iterative": [*DYNAMIC, "--inverse", "iterative", "--codec", "none"], "static": ["--model", "static"],
         "rigid": ["--model", "rigid"]}


def replaced(file, name, **how):
    """Deletes a dataset and makes another in its place."""
    del file[name]
    return file.create_dataset(name, **how)


def created(file, name, shape, prepare):
    """A dataset of the old type with unusual properties of storage."""
    dtype = file[name].dtype
    del file[name]
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    prepare(properties)
    h5py.h5d.create(file.id, name.encode(), h5py.h5t.py_create(dtype), h5py.h5s.create_simple(shape), properties)


def external_link(file, name):
    del file[name]
    file[name] = h5py.ExternalLink("good.bem", name)


def soft_link(file, name):
    del file[name]
    file[name] = h5py.SoftLink("/mesh/vertices")


def second_link(file, name):
    file[name + "_again"] = file[name]


def virtual(file, name):
    shape, dtype = file[name].shape, file[name].dtype
    del file[name]
    layout = h5py.VirtualLayout(shape, dtype)
    layout[...] = h5py.VirtualSource("good.bem", name, shape)
    file.create_virtual_dataset(name, layout)


def external_storage(file, name):
    size = file[name].size * file[name].dtype.itemsize
    created(file, name, file[name].shape, lambda p: p.set_external(b"secret", 0, size))


def chunk_bomb(file, name):
    """Promises 10^11 rows without storing any: they read as the fill value."""
    dataset = file[name]
    replaced(file, name, shape=(10**11,) + dataset.shape[1:], dtype=dataset.dtype, chunks=(1000,) + dataset.shape[1:])


def late_bomb(file, name):
    """The same in one piece, for which nothing is allocated."""
    shape = (10**11,) + file[name].shape[1:]
    created(file, name, shape, lambda p: p.set_alloc_time(h5py.h5d.ALLOC_TIME_LATE))


def named_type(file, name):
    file[name + "_type"] = np.dtype("f8")


STRUCTURE = {
    "deleted": lambda f, n: f.__delitem__(n),
    "a group": lambda f, n: (f.__delitem__(n), f.create_group(n)),
    "external link": external_link, "soft link": soft_link, "second link": second_link,
    "virtual": virtual, "external storage": external_storage, "chunk bomb": chunk_bomb,
    "late bomb": late_bomb, "named type": named_type,
    "gzip": lambda f, n: replaced(f, n, data=f[n][...], chunks=True, compression="gzip"),
    "chunks": lambda f, n: replaced(f, n, data=f[n][...], chunks=True),
    "half precision": lambda f, n: replaced(f, n, shape=f[n].shape, dtype="f2"),
    "another width": lambda f, n: replaced(f, n, shape=f[n].shape, dtype="u8" if f[n].dtype == "f8" else "f8"),
    "big endian": lambda f, n: replaced(f, n, data=f[n][...].astype(f[n].dtype.newbyteorder(">"))
                                        if f[n].dtype.itemsize > 1 else f[n][...].astype(">u2")),
    "compound": lambda f, n: replaced(f, n, shape=f[n].shape, dtype=np.dtype([("a", "f8"), ("b", "i4")])),
    "variable length": lambda f, n: replaced(f, n, shape=f[n].shape, dtype=h5py.vlen_dtype("f8")),
    "text": lambda f, n: replaced(f, n, shape=f[n].shape, dtype=h5py.string_dtype()),
    "null": lambda f, n: replaced(f, n, data=h5py.Empty("f8")),
    "scalar": lambda f, n: replaced(f, n, data=np.zeros((), f[n].dtype)),
    "one extent more": lambda f, n: replaced(f, n, shape=f[n].shape + (1,), dtype=f[n].dtype),
    "one row more": lambda f, n: replaced(f, n, data=np.concatenate([f[n][...], f[n][:1]])),
    "no rows": lambda f, n: replaced(f, n, shape=(0,) + f[n].shape[1:], dtype=f[n].dtype),
}

ATTRIBUTES = {
    "deleted": lambda a, n: a.__delitem__(n),
    "text": lambda a, n: a.__setitem__(n, "text"),
    "long text": lambda a, n: a.__setitem__(n, "x" * 200000) if n == "name" else a.__setitem__(n, "x" * 60000),
    "array": lambda a, n: a.__setitem__(n, np.array([1.0, 2.0])),
    "empty": lambda a, n: a.create(n, h5py.Empty("f8")),
    "compound": lambda a, n: a.__setitem__(n, np.array([(1, 2.0)], dtype=[("a", "i4"), ("b", "f8")])[0]),
    "quadruple precision": lambda a, n: a.__setitem__(n, np.longdouble(1.5)),
    "infinite": lambda a, n: a.__setitem__(n, np.float64("inf")),
    "undefined": lambda a, n: a.__setitem__(n, np.float64("nan")),
    "negative": lambda a, n: a.__setitem__(n, np.int64(-1)),
    "too large": lambda a, n: a.__setitem__(n, np.int64(2**62)),
}
NUMBERS = [("scheme", "history_length"), ("scheme", "dt"), ("scheme", "window"), ("scheme", "quadrature_tolerance"),
           ("material", "density"), ("material", "poisson_ratio"), ("body", "volume"), ("body", "extent"),
           ("report", "growth"), ("matrices/h", "quantum"), ("matrices/h", "matrices")]
BIG = {"dt", "quadrature_tolerance", "density", "growth", "quantum"}  # may be large as far as they go alone


def numbers_changed(file):
    """Names and changes of numbers in datasets, each of which makes the archive wrong."""
    def put(name, index, value):
        return name, lambda: file[name].__setitem__(index, value)
    yield put("mesh/vertices", (0, 0), np.nan)
    yield put("mesh/vertices", (0, 0), 7)  # not where its node is
    yield put("mesh/faces", (0, 0), -1)
    yield put("mesh/faces", (0, 0), 2**31 - 1)
    yield put("mesh/faces", 0, file["mesh/faces"][1])  # a triangle twice: not closed
    yield put("body/nodes", (0, 2), np.inf)
    yield put("body/nodes", 0, file["body/nodes"][1])
    yield put("body/triangles", 0, file["body/triangles"][0][::-1])  # inward
    yield put("body/node_of_vertex", 0, -1)
    yield put("body/node_of_vertex", 0, 1000000)
    yield put("body/triangle_order", 0, file["body/triangle_order"][1])
    yield put("body/centre_of_mass", 0, np.nan)
    yield put("body/inertia", (0, 0), -1)
    if "matrices" not in file:
        return
    yield put("matrices/balance/load", (0, 0), np.inf)
    first = "matrices/body_force/component_0/real"
    yield put(first, (0, 0), np.nan)
    if "matrices/h/lag_001" in file:
        yield put("matrices/h/lag_001/component_0", (1, 1), np.nan)
    if "matrices/h/slabs" in file:
        yield put("matrices/h/slabs", (0, 1), 2**31 - 1)
        yield put("matrices/h/slabs", (0, 2), -1)
        for column, value in ((0, -1), (1, 10**6), (2, 3), (3, 1), (4, 2), (5, 70000), (16, 2**31 - 1)):
            yield put("matrices/h/blocks", (0, column), value)
        for column, value in ((0, -1), (2, 70000), (5, 2**31 - 1)):
            yield put("matrices/h/couplings", (0, column), value)
    if "matrices/h/gaps" in file:
        yield put("matrices/h/gaps", 0, 255)
        yield put("matrices/h/rows", (0, 0), -1)
        yield put("matrices/h/rows", (0, 1), 2**31 - 1)


class HostileArchives(CliCase):
    def setUp(self):
        super().setUp()
        self.sphere(0)
        (self.folder / "secret").write_text("what is in other files " * 1000)

    def make(self, kind):
        self.run_tool("sphere.obj", "rubber.json", "-o", "good.bem", "--force", "-q", *KINDS[kind])

    def changed(self, change):
        """A signed copy of the good archive, changed by `change`."""
        shutil.copy(self.folder / "good.bem", self.folder / "bad.bem")
        with h5py.File(self.folder / "bad.bem", "r+") as file:
            change(file)
        sign_archive(self.folder / "bad.bem")

    def run_limited(self, *command):
        return subprocess.run(list(map(str, command)), cwd=self.folder, capture_output=True, text=True, timeout=LIMIT,
                              preexec_fn=limit_memory)

    def assert_refused(self, *command):
        done = self.run_limited(*command)
        self.assertEqual(done.returncode, 4, f"{command}: {done.stdout} {done.stderr}")
        self.assert_error(done, "bad.bem")
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def assert_change_refused(self, change):
        self.changed(change)
        self.assert_refused(BEMPRECOMP, "--verify", "bad.bem")

    def datasets(self, kind):
        self.make(kind)
        names = []
        with h5py.File(self.folder / "good.bem") as file:
            file.visititems(
                lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) and item.size > 0 else None)
        return names

    def test_a_signed_copy_is_good(self):
        self.make("lowrank")
        self.changed(lambda file: None)
        self.assertEqual(self.run_limited(BEMPRECOMP, "--verify", "bad.bem").returncode, 0)

    def test_structure(self):
        """Every kind of change in some dataset, and every dataset with some kind of change."""
        rng = random.Random(1)
        for kind in KINDS:
            names = self.datasets(kind)
            most = len(names) if kind in ("lowrank", "none") else 8
            cases = [(rng.choice(list(STRUCTURE)), name) for name in rng.sample(names, min(most, len(names)))]
            if kind == "none":
                cases += [(change, rng.choice(names)) for change in STRUCTURE]
            for change, name in cases:
                with self.subTest(kind=kind, change=change, name=name):
                    self.assert_change_refused(lambda file: STRUCTURE[change](file, name))

    def test_attributes(self):
        self.make("lowrank")
        rng = random.Random(2)
        for place, name in NUMBERS:
            changes = [change for change in ATTRIBUTES if change != "too large" or name not in BIG]
            for change in changes if name == "window" else rng.sample(changes, 4):
                apply = ATTRIBUTES[change]
                with self.subTest(place=place, name=name, change=change):
                    self.assert_change_refused(lambda file: apply(file[place].attrs, name))

    def test_contradictions(self):
        """Numbers that are possible, but not together: they would take forever."""
        self.make("lowrank")
        for place, name, factor in [("material", "shear_modulus", 1e-3), ("material", "density", 1e4), ("scheme", "dt", 0.1)]:
            with self.subTest(name=name):
                self.assert_change_refused(lambda file: file[place].attrs.__setitem__(name, file[place].attrs[name] * factor))

    def test_numbers(self):
        for kind in KINDS:
            self.make(kind)
            with h5py.File(self.folder / "good.bem") as file:
                count = len(list(numbers_changed(file)))
            for i in range(count):
                def change(file):
                    name, apply = list(numbers_changed(file))[i]
                    apply()
                with self.subTest(kind=kind, number=i):
                    self.assert_change_refused(change)

    def test_groups(self):
        self.make("none")
        for what, change in {
                "a loop": lambda f: f["mesh"].__setitem__("loop", f["/"]),
                "deep": lambda f: f.create_group("/".join("abcdefghijkl")),
                "a dataset": lambda f: (f.__delitem__("matrices"), f.create_dataset("matrices", data=[1.0])),
                "a link": lambda f: (f.__delitem__("matrices"), f.__setitem__("matrices", h5py.SoftLink("/mesh"))),
                "an unknown filter": lambda f: f.create_dataset("new", data=np.arange(9), chunks=True, shuffle=True),
        }.items():
            with self.subTest(what=what):
                self.assert_change_refused(change)

    def test_scenes(self):
        """bemsim says the same, before it writes anything."""
        self.make("lowrank")
        (self.folder / "scene.json").write_text(json.dumps(
            {"version": 1, "time_step": 0.01, "duration": 0.05, "bodies": [{"name": "a", "archive": "bad.bem"}]}))
        for change in ("external storage", "chunk bomb", "soft link", "another width", "virtual"):
            self.changed(lambda file: STRUCTURE[change](file, "mesh/vertices"))
            with self.subTest(change=change):
                self.assert_refused(BEMSIM, "scene.json", "-o", "out")
                self.assertFalse((self.folder / "out").exists())

    def test_absurd_matrices(self):
        """Numbers that are finite, but of no body: the simulation says so, whichever way it goes."""
        (self.folder / "scene.json").write_text(json.dumps(
            {"version": 1, "time_step": 0.01, "duration": 0.05, "gravity": [0, 0, -9.81], "contact": {},
             "obstacles": [{"name": "floor", "plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}],
             "bodies": [{"name": "a", "archive": "bad.bem", "position": [0, 0, 0.0999], "velocity": [0, 0, -1]},
                        {"name": "b", "archive": "bad.bem", "position": [1, 0, 1], "fixed": [{"vertices": [0, 1]}],
                         "tractions": [{"select": "all", "traction": [1, 0, 0]}]}]}))
        for kind in ("none", "iterative"):
            self.make(kind)
            for value in (1e30, -1e30, 0, 1e-30):
                def change(file):
                    file["matrices"].visititems(
                        lambda _, item: item.__setitem__(..., value) if isinstance(item, h5py.Dataset) else None)
                self.changed(change)
                done = self.run_limited(BEMSIM, "scene.json", "-o", "out", "--force", "-q")
                with self.subTest(kind=kind, value=value):
                    self.assertIn(done.returncode, (0, 4, 5), done.stderr)


if __name__ == "__main__":
    unittest.main()
