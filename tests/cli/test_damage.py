"""Damaged scenes, materials and archives are refused by name: never a crash, a hang or a guess."""
import json
import os
import random
import subprocess
import unittest

import h5py

from cli_case import BEMPRECOMP, CliCase

BEMSIM = os.environ["BEMSIM"]
LIMIT = 20  # seconds that no run here may take
CHARACTERS = [bytes([c]) for c in b'{}[]",:.-+eE0123456789 \n\\/tfnaxyz_#\0\x80\xc3\xff']

# A scene with every key that bemsim simulates.
SCENE = {
    "version": 1, "time_step": 0.01, "duration": 0.2, "gravity": [0, -9.81, 0],
    "bodies": [
        {"name": "ball", "archive": "a.bem", "position": [0.2, 1, -3],
         "rotation": {"axis": [0, 1, 1], "angle_deg": 40}, "velocity": [1.5, 0.5, 0],
         "angular_velocity": [0, 0, 4], "frame": "moving", "gravity": True, "friction": 0.4,
         "tractions": [{"select": "all", "pressure": 1000}]},
        {"name": "held", "archive": "a.bem", "frame": "static", "gravity": False,
         "fixed": [{"vertices": [0, 1, 2]}, {"box": {"min": [-1, -1, -1], "max": [-0.05, 1, 1]}}],
         "handles": [{"select": {"box": {"min": [0.08, -1, -1], "max": [1, 1, 1]}},
                      "motion": [{"time": 0, "translate": [0, 0, 0.1],
                                  "rotate": {"axis": [1, 0, 0], "angle_deg": 5}, "about": [0, 0, 1]},
                                 {"time": 1.5, "translate": [0, 0, 0]}],
                      "release_time": 0.1}],
         "tractions": [{"select": {"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}, "normal": [1, 0, 0],
                                   "normal_tolerance_deg": 60},
                        "traction": [900, 0, 0], "profile": [[0, 1], [0.1, 3]], "follow": True},
                       {"select": {"triangles": [7, 8]}, "traction": [0, 5, 0]}]}],
    "contact": {"enabled": False},
    "output": {"formats": ["hdf5", "obj"], "every": 2, "fields": ["positions", "tractions"]}}


def damaged(text, rng):
    """`text` with one character replaced, deleted or inserted."""
    at = rng.randrange(len(text))
    kind = rng.randrange(3)
    return text[:at] + (b"" if kind == 1 else rng.choice(CHARACTERS)) + text[at + (kind != 2):]


class DamageCase(CliCase):
    def setUp(self):
        super().setUp()
        self.precompute(output="a.bem")

    def run_any(self, *command):
        return subprocess.run(list(map(str, command)), cwd=self.folder, capture_output=True, timeout=LIMIT)

    def assert_refused(self, done, code, *parts):
        """Exit code `code`, nothing on stdout, and one line on stderr with all parts."""
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stdout, b"")
        self.assertTrue(done.stderr.startswith(b"error: "), done.stderr)
        self.assertEqual(done.stderr.count(b"\n"), 1, done.stderr)
        for part in parts:
            self.assertIn(part.encode(), done.stderr)


class Scenes(DamageCase):
    def fits(self, text):
        """What decides between exit codes 0 and 4 in a scene that is not refused with 3."""
        scene = json.loads(text)
        return [scene["time_step"], [os.path.normpath(body["archive"]) for body in scene["bodies"]]]

    def test_scenes(self):
        """Exit code 4, and only that, where the name of an archive or the time step has become
        another valid one; 3 for everything else that is wrong."""
        rng = random.Random(20260701)
        text = json.dumps(SCENE, indent=1).encode()
        codes = {0: 0, 3: 0, 4: 0}
        for i in range(200):
            scene = damaged(text, rng)
            (self.folder / "scene.json").write_bytes(scene)
            done = self.run_any(BEMSIM, "scene.json", "--check")
            with self.subTest(number=i, scene=scene):
                self.assertIn(done.returncode, codes, done.stderr)
                codes[done.returncode] += 1
                if done.returncode != 0:
                    self.assert_refused(done, done.returncode, "scene.json")
                if done.returncode != 3:
                    self.assertEqual(self.fits(scene) == self.fits(text), done.returncode == 0, done.stderr)
        self.assertGreater(codes[0], 10)
        self.assertGreater(codes[3], 100)

    def test_names_of_archives(self):
        """A wrong name is a missing archive (4) whatever it is made of; no name at all is an
        invalid scene (3)."""
        for name, code in [("A.bem", 4), ("a.bem/", 4), ("a.bem/b", 4), (".", 4), ("a\x01.bem", 4),
                           ("b" * 5000, 4), ("a\nb.bem", 4), ("\u00e4\u001b[2J", 4), ("scene.json", 4), ("", 3), (7, 3), (None, 3), ("a\0b", 3)]:
            with self.subTest(name=str(name)[:20]):
                scene = {**SCENE, "bodies": [{"name": "ball", "archive": name}]}
                (self.folder / "scene.json").write_text(json.dumps(scene))
                self.assert_refused(self.run_any(BEMSIM, "scene.json", "--check"), code, "/bodies/0/archive")


class Materials(DamageCase):
    def test_materials(self):
        rng = random.Random(20260702)
        text = json.dumps({"name": "rubber", "density": 1000, "poisson_ratio": 0.3, "youngs_modulus": 2.5e5,
                           "time_step": 0.01}).encode()
        codes = {0: 0, 3: 0}
        for i in range(50):
            material = damaged(text, rng)
            (self.folder / "m.json").write_bytes(material)
            done = self.run_any(BEMPRECOMP, "sphere.obj", "m.json", "--dt", "0.01", "--history", "3", "--window", "1",
                                "--scheme", "bdf1", "-o", "m.bem", "--force", "-q")
            with self.subTest(number=i, material=material):
                self.assertIn(done.returncode, codes, done.stderr)
                codes[done.returncode] += 1
                if done.returncode == 3:
                    self.assert_refused(done, 3, "m.json:")
        self.assertGreater(codes[0], 3)
        self.assertGreater(codes[3], 25)


class Archives(DamageCase):
    def setUp(self):
        super().setUp()
        self.good = (self.folder / "a.bem").read_bytes()
        (self.folder / "scene.json").write_text(json.dumps({
            "version": 1, "time_step": 0.01, "duration": 0.1, "bodies": [{"name": "ball", "archive": "bad.bem"}]}))

    def check_refused(self, *parts):
        for option in ("--info", "--verify"):
            self.assert_refused(self.run_any(BEMPRECOMP, option, "bad.bem"), 4, "bad.bem", *parts)
        self.check_refused_in_scene("--check", parts=parts)

    def check_refused_in_scene(self, *options, parts=()):
        self.assert_refused(self.run_any(BEMSIM, "scene.json", *options), 4, "scene.json:", "/bodies/0/archive",
                            "bad.bem", *parts)

    def check_bytes(self, content, *parts):
        (self.folder / "bad.bem").write_bytes(content)
        self.check_refused(*parts)

    def test_every_command(self):
        (self.folder / "bad.bem").write_bytes(self.good[:-5])
        for arguments in (["--info", "bad.bem", "--json"], ["--diff", "a.bem", "bad.bem"], ["--diff", "bad.bem", "a.bem"]):
            self.assert_refused(self.run_any(BEMPRECOMP, *arguments), 4, "bad.bem", "damaged")
        self.check_refused_in_scene("-o", "out", parts=["damaged"])
        self.assertFalse((self.folder / "out").exists())

    def test_truncated(self):
        size = len(self.good)
        for length in [1, 30, 4095, 4096, 4097, 5000, size // 3, size - 4096, size - 1]:
            with self.subTest(length=length):
                self.check_bytes(self.good[:length])
        self.check_bytes(self.good[:size // 2], "damaged")
        self.check_bytes(self.good + b"\0", "damaged")

    def sections(self):
        """Some place in every part of the file: the text in front, HDF5's own data, all datasets."""
        places = {"text": 3, "version": self.good.index(b"version: 2") + 9, "padding": 4000, "signature": 4097,
                  "superblock": 4110, "last byte": len(self.good) - 1}
        with h5py.File(self.folder / "a.bem") as archive:
            def visit(name, item):
                if isinstance(item, h5py.Dataset):
                    places[name] = item.id.get_offset() + item.id.get_storage_size() // 2
            archive.visititems(visit)
        # one of each kind of large matrix is enough
        return {name: place for name, place in places.items() if "lag_" not in name or "lag_001" in name}

    def test_flipped_bits(self):
        sections = self.sections()
        self.assertGreater(len(sections), 15)
        rng = random.Random(7)
        for name, place in sections.items():
            with self.subTest(section=name):
                self.assertLess(place, len(self.good))
                flipped = bytearray(self.good)
                flipped[place] ^= 1 << rng.randrange(8)
                self.check_bytes(bytes(flipped))

    def test_foreign(self):
        with h5py.File(self.folder / "foreign.h5", "w") as file:
            file["matrices/h/lag_001"] = [1, 2, 3]
        for content, part in [(b"", "empty"), (b"hello\n", "not an archive"), (b"\0" * 10000, "not an archive"),
                              (random.Random(3).randbytes(20000), "not an archive"),
                              (self.good[4096:], "HDF5"), ((self.folder / "foreign.h5").read_bytes(), "not an archive"),
                              (self.good.replace(b"format version: 2\n", b"format version: 9\n"), "version 9")]:
            with self.subTest(part=part):
                self.check_bytes(content, part)

    def test_no_file(self):
        self.check_refused("no such")
        (self.folder / "bad.bem").mkdir()
        self.check_refused("directory")
        (self.folder / "bad.bem").rmdir()
        (self.folder / "bad.bem").symlink_to("bad.bem")
        self.check_refused()


if __name__ == "__main__":
    unittest.main()
