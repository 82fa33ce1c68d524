"""bemshape repair, remesh, wrap and split, as a user calls them."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

BEMSHAPE = os.environ["BEMSHAPE"]
CORNERS = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
SIDES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
SHEET = [[0, 1, 3, 2]]


class MeshRepair(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="bem_repair_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def write(self, name, faces, vertices=CORNERS):
        lines = ["v %r %r %r" % tuple(v) for v in vertices]
        lines += ["f " + " ".join(str(k + 1) for k in face) for face in faces]
        (self.folder / name).write_text("\n".join(lines) + "\n")

    def shape(self, *arguments, code=0):
        done = subprocess.run([BEMSHAPE, *map(str, arguments)], cwd=self.folder, text=True, capture_output=True, timeout=60)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stdout, "")
        return done.stderr

    def counts(self, name):
        text = (self.folder / name).read_text()
        return text.count("v "), text.count("f ")

    def test_a_closed_mesh_stays_as_it_is(self):
        self.write("cube.obj", SIDES)
        self.assertIn("nothing to repair", self.shape("repair", "cube.obj", "-o", "out.obj"))
        self.assertEqual(self.counts("out.obj"), (8, 12))

    def test_a_closed_mesh_that_points_inward_is_turned(self):
        self.write("inward.obj", [face[::-1] for face in SIDES])
        said = self.shape("repair", "inward.obj", "-o", "out.obj")
        self.assertIn("inward.obj: turned 12 triangles outward\n", said)
        self.assertNotIn("nothing to repair", said)
        self.assertIn("nothing to repair", self.shape("repair", "out.obj", "-o", "again.obj"))
        self.assertEqual((self.folder / "out.obj").read_text(), (self.folder / "again.obj").read_text())

    def test_options_out_of_range_are_named(self):
        self.write("cube.obj", SIDES)
        for options, text in [(["--alpha", 1e-9], "a wrap with --alpha 1e-09 would have about 4e+18 triangles; the least useful"),
                              (["--offset", 1], "--offset must be in (0, 0.5]"),
                              (["--nodes", "many"], '--nodes: "many" is not a number')]:
            self.assertIn(text, self.shape("wrap", "cube.obj", "-o", "out.obj", *options, code=2))

    def test_other_formats_than_obj_are_not_pretended(self):
        self.write("cube.obj", SIDES)
        for command in (["repair", "cube.obj", "-o", "out.stl"], ["split", "cube.obj", "-o", "part-%d.ply"],
                        ["box", "-o", "out.off"]):
            self.assertIn("bemshape writes OBJ files", self.shape(*command, code=2))
        self.assertIn("nodes", self.shape("remesh", "cube.obj", "-o", "out.obj", "--nodes", 0, code=2))
        self.assertEqual(os.listdir(self.folder), ["cube.obj"])

    def test_a_mesh_is_repaired_and_its_steps_are_told(self):
        self.write("cube.obj", [side[::-1] if i == 2 else side for i, side in enumerate(SIDES)] + SIDES[:1])
        said = self.shape("repair", "cube.obj", "-o", "out.obj")
        self.assertIn("dropped 2 triangles", said)
        self.assertIn("turned 2 triangles over", said)
        self.assertEqual(self.counts("out.obj"), (8, 12))
        self.assertIn("nothing to repair", self.shape("repair", "out.obj", "-o", "again.obj"))

    def test_large_holes_are_filled_when_asked_for(self):
        self.write("open.obj", SIDES[:5])
        self.assertIn("a thickness of 0.0346 m", self.shape("repair", "open.obj", "-o", "shell.obj"))
        self.assertIn("filled 1 hole of 4 edges", self.shape("repair", "open.obj", "-o", "full.obj", "--fill-holes", "all"))
        self.assertEqual(self.counts("full.obj")[0], 8)

    def test_sheets_have_the_thickness_asked_for(self):
        self.write("sheet.obj", SHEET)
        said = self.shape("repair", "sheet.obj", "-o", "plate.obj", "--thickness", "0.1")
        self.assertIn("sheet without an inside: it was given a thickness of 0.141 m", said)

    def test_remesh_and_wrap(self):
        self.shape("box", "--size", 2, 1, 1, "-o", "box.obj")
        self.shape("remesh", "box.obj", "-o", "fine.obj", "--nodes", 300)
        self.assertTrue(270 <= self.counts("fine.obj")[0] <= 330)
        self.assertIn("wrapped it at a distance of 0.0245 m, bridging gaps up to 0.245 m",
                      self.shape("wrap", "box.obj", "-o", "wrap.obj", "--alpha", 0.1, "--offset", 0.01))

    def test_what_is_refused(self):
        self.write("sheet.obj", SHEET)
        said = self.shape("remesh", "sheet.obj", "-o", "out.obj", "--nodes", 100, code=3)
        self.assertIn('mend it with "bemshape repair sheet.obj -o repaired.obj"', said)
        self.assertIn("--alpha must be in (0, 1]", self.shape("wrap", "sheet.obj", "-o", "out.obj", "--alpha", 2, code=2))
        self.assertIn("-o would overwrite", self.shape("repair", "sheet.obj", "-o", "sheet.obj", code=2))
        self.write("line.obj", [[0, 1, 2]], [(0, 0, 0), (1, 0, 0), (2, 0, 0)])
        self.assertIn("cannot be repaired: no triangle has an area", self.shape("repair", "line.obj", "-o", "out.obj", code=3))
        self.assertFalse((self.folder / "out.obj").exists())

    def test_open_meshes_are_split(self):
        self.write("two.obj", SHEET + [[8, 9, 10]], CORNERS + [(5, 0, 0), (6, 0, 0), (5, 1, 0)])
        self.assertIn("its connected parts are written", self.shape("split", "two.obj", "-o", "part-%d.obj"))
        self.assertEqual([self.counts(f"part-{i}.obj") for i in range(2)], [(4, 2), (3, 1)])


if __name__ == "__main__":
    unittest.main()
