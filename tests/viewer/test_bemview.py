"""bemview as users call it: what it writes, and what it refuses."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import h5py

from trajectories import write_layout_1, write_layout_2


class Bemview(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="bem_view_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        write_layout_2(self.folder / "t.h5")

    def view(self, *arguments, code=0):
        done = subprocess.run([os.environ["BEMVIEW"], *map(str, arguments)], cwd=self.folder, text=True, capture_output=True, timeout=60)
        self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}\n{done.stderr}")
        self.assertEqual(done.stdout, "")
        return done

    def refused(self, *arguments, code, parts):
        """One error line, and nothing written."""
        before = sorted(path.name for path in self.folder.iterdir())
        lines = self.view(*arguments, code=code).stderr.splitlines()
        self.assertEqual([line.startswith("error: ") for line in lines], [True], lines)
        for part in parts:
            self.assertIn(part, lines[0])
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), before)

    def description(self, name="v.html"):
        text = (self.folder / name).read_text(encoding="utf-8")
        return json.loads(re.search(r'id="description">(.*?)</script>', text, re.S).group(1))

    def test_a_page(self):
        self.assertIn("v.html: ", self.view("t.h5", "-o", "v.html").stderr)
        found = self.description()
        self.assertEqual(found["title"], self.folder.name)
        self.assertEqual(found["frames"], 81)
        self.assertEqual([body["name"] for body in found["bodies"]], ["right", "left"])
        self.assertEqual([o["name"] for o in found["obstacles"]], ["slab", "floor"])
        self.assertEqual([field["name"] for field in found["fields"]], ["displacement", "speed", "tractions", "von_mises"])
        self.assertEqual(found["fields"][3]["units"], "Pa")
        self.assertEqual({s["name"] for s in found["series"]}, {"kinetic energy", "momentum", "height", "largest displacement"})
        self.assertIn("default-src 'none'", (self.folder / "v.html").read_text(encoding="utf-8"))

    def test_the_same_trajectory_gives_the_same_page(self):
        self.view("t.h5", "-o", "a.html", "-q")
        self.view("t.h5", "-o", "b.html", "-q")
        self.assertEqual((self.folder / "a.html").read_bytes(), (self.folder / "b.html").read_bytes())

    def test_a_trajectory_of_layout_1(self):
        write_layout_1(self.folder / "old.h5")
        self.view("old.h5", "-o", "v.html", "-q")
        found = self.description()
        self.assertEqual([body["name"] for body in found["bodies"]], ["cube"])
        self.assertEqual([field["name"] for field in found["fields"]], ["displacement", "speed"])
        self.assertEqual(found["obstacles"], [])

    def test_choices(self):
        self.view("t.h5", "-o", "v.html", "--every", 4, "--bodies", "left", "--fields", "von_mises", "--title", "A </script> & é")
        found = self.description()
        self.assertEqual(found["title"], "A </script> & é")
        self.assertEqual(found["frames"], 21)
        self.assertEqual([body["name"] for body in found["bodies"]], ["left"])
        self.assertEqual([field["name"] for field in found["fields"]], ["von_mises"])
        self.view("t.h5", "-o", "v.html", "--fps", 25, "--force")
        self.assertEqual(self.description()["frames"], 21)

    def test_a_simulated_surface_beside_a_render_mesh(self):
        """It would be in the way: it is shown if it is asked for."""
        with h5py.File(self.folder / "t.h5", "r+") as file:
            file["bodies/left"].attrs["surface"] = "simulation"
        for choice, expected in [([], ["right"]), (["--bodies", "left"], ["left"])]:
            self.view("t.h5", "-o", "v.html", "--force", *choice)
            self.assertEqual([body["name"] for body in self.description()["bodies"]], expected)

    def test_what_is_refused(self):
        self.refused("t.h5", code=2, parts=["--output"])
        self.refused("t.h5", "-o", "t.h5", code=2, parts=["is an input"])
        self.refused("t.h5", "-o", ".", code=2, parts=["directory"])
        self.refused("t.h5", "-o", "v.html", "--every", 0, code=2, parts=["--every"])
        self.refused("t.h5", "-o", "v.html", "--fps", -1, code=2, parts=["--fps"])
        self.refused("t.h5", "-o", "v.html", "--bodies", "middle", code=2, parts=['no body "middle"', '"right", "left"'])
        self.refused("t.h5", "-o", "v.html", "--fields", "speeds", code=2, parts=['no field "speeds"', '"von_mises"'])
        self.refused("t.h5", "-o", "v.html", "--feilds", "speed", code=2, parts=["--fields"])
        self.refused("none.h5", "-o", "v.html", code=4, parts=["none.h5"])
        self.refused("t.h5", "-o", "none/v.html", code=6, parts=["none"])

    def test_an_existing_page_stays(self):
        (self.folder / "v.html").write_text("mine")
        self.refused("t.h5", "-o", "v.html", code=2, parts=["v.html", "--force"])
        self.assertEqual((self.folder / "v.html").read_text(), "mine")
        self.view("t.h5", "-o", "v.html", "--force")
        self.assertGreater((self.folder / "v.html").stat().st_size, 100000)

    def test_files_that_are_no_trajectories(self):
        (self.folder / "text.h5").write_text("nothing")
        self.refused("text.h5", "-o", "v.html", code=4, parts=["text.h5"])
        with h5py.File(self.folder / "empty.h5", "w", libver="latest"):
            pass
        self.refused("empty.h5", "-o", "v.html", code=4, parts=["empty.h5", "/time"])
        for place, change in [("/bodies/left/faces", lambda f: f["bodies/left/faces"].__setitem__((0, 0), 8)),
                              ("/bodies/left/positions", lambda f: f["bodies/left/positions"].__setitem__((80, 0, 0), float("nan"))),
                              ("/contacts/points", lambda f: f["contacts/counts"].__setitem__(80, 10**6)),
                              ("/bodies/left/von_mises", lambda f: f["bodies/left/von_mises"].__setitem__((3, 3), float("inf")))]:
            write_layout_2(self.folder / "t.h5")
            with h5py.File(self.folder / "t.h5", "r+") as file:
                change(file)
            with self.subTest(place=place):
                self.refused("t.h5", "-o", "v.html", code=4, parts=["t.h5", place])


if __name__ == "__main__":
    unittest.main()
