"""scripts/refine_mesh.py: closed meshes of the size asked for, and what it refuses."""
import collections
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "refine_mesh.py"
sys.path.insert(0, str(SCRIPT.parent))
import refine_mesh  # noqa: E402

CUBE = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
CUBE_FACES = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
              [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]


def volume(vertices, faces):
    total = 0
    for a, b, c in ([vertices[i] for i in f] for f in faces):
        total += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                  + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    return total


class RefineMesh(unittest.TestCase):
    def test_the_surface_stays_closed_and_where_it_is(self):
        for count in (8, 9, 20, 147):
            vertices, faces = refine_mesh.refined(CUBE, CUBE_FACES, count)
            self.assertEqual(len(vertices), count)
            self.assertEqual(len(faces), 2 * count - 4)
            edges = collections.Counter((f[k], f[(k + 1) % 3]) for f in faces for k in range(3))
            self.assertTrue(all(n == 1 and edges[(b, a)] == 1 for (a, b), n in edges.items()))
            self.assertAlmostEqual(volume(vertices, faces), 1, 12)
            self.assertTrue(all(any(x in (0, 1) for x in v) for v in vertices))

    def test_the_longest_edges_are_halved_first(self):
        vertices, faces = refine_mesh.refined(CUBE, CUBE_FACES, 14)
        longest = max(math.dist(vertices[f[k]], vertices[f[k - 1]]) for f in faces for k in range(3))
        self.assertAlmostEqual(longest, 1, 12)  # the six diagonals are gone
        self.assertIn((0.0, 0.5, 0.5), vertices)

    def run_script(self, obj, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            source, target = pathlib.Path(folder) / "in.obj", pathlib.Path(folder) / "out.obj"
            source.write_text(obj)
            done = subprocess.run([sys.executable, SCRIPT, source, target, *arguments], text=True, capture_output=True)
            return done, target.read_text() if target.exists() else None

    def test_from_file_to_file(self):
        cube = "".join(f"v {x} {y} {z}\n" for x, y, z in CUBE) + "".join(
            f"f {a + 1}/1 {b + 1}/1 {c + 1}/1\n" for a, b, c in CUBE_FACES)
        done, text = self.run_script(cube, "10")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(text.count("v "), 10)
        self.assertEqual(text.count("f "), 16)
        self.assertEqual(self.run_script(cube, "10")[1], text)
        for wrong, count, code, reason in (("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", "5", 3, "not closed"),
                                           (cube, "7", 3, "more than 7"), (cube, "many", 2, "usage"),
                                           ("v 0 0 0\n", "5", 3, "triangles")):
            done, text = self.run_script(wrong, count)
            self.assertEqual(done.returncode, code)
            self.assertIn(reason, done.stderr)
            self.assertTrue(done.stderr.startswith("error: "))
            self.assertIsNone(text)


if __name__ == "__main__":
    unittest.main()
