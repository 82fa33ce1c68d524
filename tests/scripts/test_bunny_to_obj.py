"""scripts/bunny_to_obj.py: what it writes and what it refuses."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "bunny_to_obj.py"
POSITIONS = "exports.positions=[[0,0,0],[1.5,0,0],[0,1,0],[0,0,1]]"
TETRAHEDRON = POSITIONS + "\nexports.cells=[[0,2,1],[0,1,3],[1,2,3],[0,3,2]]\n"
OPEN = POSITIONS + "\nexports.cells=[[0,2,1],[0,1,3],[1,2,3]]\n"


class BunnyToObj(unittest.TestCase):
    def convert(self, source):
        with tempfile.TemporaryDirectory() as folder:
            script, obj = pathlib.Path(folder) / "index.js", pathlib.Path(folder) / "out.obj"
            script.write_text(source)
            done = subprocess.run([sys.executable, SCRIPT, script, obj], capture_output=True, text=True)
            return done, obj.read_text() if obj.exists() else None

    def test_writes_positions_and_one_based_faces(self):
        done, obj = self.convert(TETRAHEDRON)
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = obj.splitlines()
        self.assertEqual([x for x in lines if x.startswith("v")][1], "v 1.5 0.0 0.0")
        self.assertEqual([x for x in lines if x.startswith("f")], ["f 1 3 2", "f 1 2 4", "f 2 3 4", "f 1 4 3"])

    def test_refuses_what_is_not_a_closed_mesh(self):
        for source, reason in ((OPEN, "not closed"), (POSITIONS, "no exports.cells"), ("", "no exports")):
            done, obj = self.convert(source)
            self.assertEqual(done.returncode, 3)
            self.assertIn(reason, done.stderr)
            self.assertTrue(done.stderr.startswith("error: "))
            self.assertIsNone(obj)


if __name__ == "__main__":
    unittest.main()
