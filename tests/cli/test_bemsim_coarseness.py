"""What --stats and --info say of how coarse meshes are."""
import json
import unittest

import numpy as np

from simulation_case import DT, SimulationCase, falling_ball, held_ball, models, program, read_obj


class Coarseness(SimulationCase):
    def archive(self, name, *options, subdivisions=1):
        program("bemshape", "icosphere", "--subdivisions", subdivisions, "--radius", "0.1", "-o", self.folder / f"{name}.obj")
        program("bemprecomp", self.folder / f"{name}.obj", models / "rubber.json", "-o", self.folder / f"{name}.bem",
                "--dt", DT, "--quiet", *options)
        return self.folder / f"{name}.bem"

    def stats_of(self, *bodies, steps=10, options=()):
        self.scene.update(bodies=list(bodies), duration=steps * DT)
        self.scene.pop("gravity", None)
        stats = self.folder / "stats.json"
        self.simulate("--stats", stats, "--force", *options, scene=self.scene)
        return [body.get("coarseness") for body in json.loads(stats.read_text())["bodies"]]

    def info(self, archive):
        return json.loads(program("bemprecomp", "--info", archive, "--json").stdout)["body"]

    def check_place(self, found, mesh):
        vertices, faces = read_obj(mesh)
        a, b = found["where"]["edge"]
        self.assertTrue(any({a, b} < set(face) for face in faces.tolist()))
        np.testing.assert_allclose(found["where"]["mesh_point"], (vertices[a] + vertices[b]) / 2, atol=1e-12)
        self.assertEqual(found["nodes"], len(vertices))
        self.assertGreater(found["nodes_to_halve"], len(vertices))
        self.assertLessEqual(found["nodes_to_halve"], 4 * len(vertices))
        self.assertLessEqual(found["triangles_to_halve"], len(faces))

    def test_held_ball(self):
        found, = self.stats_of(held_ball(), steps=300)  # the last ones are looked at now and then
        self.check_place(found, models / "ball.obj")
        self.assertGreater(found["reconstructed_part"], 0.01)
        self.assertLess(found["reconstructed_part"], 0.5)
        self.assertGreater(found["where"]["share"], found["reconstructed_part"])
        self.assertGreater(found["where"]["time"], 0)
        with self.trajectory() as file:
            x = file["bodies/held/positions"][:]
        largest = np.linalg.norm(x - x[0], axis=2).max()
        self.assertGreater(found["largest_deformation"], 0.1 * largest)
        self.assertLess(found["largest_deformation"], largest)

    def test_both_discretisations_and_finer_meshes(self):
        """A surface load that varies smoothly; four times the nodes leave out about a quarter."""
        parts = {}
        for method in ("collocation", "galerkin"):
            for subdivisions in (1, 2):
                archive = self.archive("ball", "--discretisation", method, "--force", "--model", "static",
                                       subdivisions=subdivisions)
                body = {**held_ball(), "archive": str(archive), "fixed": [], "frame": "moving",
                        "tractions": [{"select": {"box": {"min": [0, -1, -1], "max": [1, 1, 1]}}, "traction": [900, 0, 0]}]}
                found, = self.stats_of(body)
                self.check_place(found, self.folder / "ball.obj")
                parts[method, subdivisions] = found["reconstructed_part"]
        for method in ("collocation", "galerkin"):
            self.assertGreater(parts[method, 1] / parts[method, 2], 2)
        self.assertLess(abs(parts["collocation", 2] / parts["galerkin", 2] - 1), 0.2)

    def cantilever(self, method, size, divisions, traction):
        """Mean deflection of the end of a bar that is held at the other one, and the part."""
        program("bemshape", "box", "--size", *size, "--divisions", *divisions, "-o", self.folder / "bar.obj")
        material = {"name": "m", "density": 1000, "shear_modulus": 1e5, "poisson_ratio": 0.3}
        (self.folder / "m.json").write_text(json.dumps(material))
        program("bemprecomp", self.folder / "bar.obj", self.folder / "m.json", "-o", self.folder / "bar.bem", "--quiet",
                "--model", "static", "--discretisation", method, "--force")
        found, = self.stats_of({
            "name": "bar", "archive": str(self.folder / "bar.bem"), "frame": "static",
            "fixed": [{"box": {"min": [-1, -1, -1], "max": [-0.4999, 1, 1]}}],
            "tractions": [{"select": {"box": {"min": [0.4999, -1, -1], "max": [1, 1, 1]}}, "traction": [0, 0, traction]}]},
            steps=1)
        with self.trajectory() as file:
            x = file["bodies/bar/positions"][:]
        return (x[1] - x[0])[x[0][:, 0] > 0.4999, 2].mean(), found["reconstructed_part"]

    def test_cantilevers(self):
        """The table of docs/scene-format.md: the part tells of the error, but not of all errors."""
        right = 3.8995e-3  # galerkin with n = 4
        for method, errors, parts in (("galerkin", [-0.044, -0.007, -0.002], [0.099, 0.0264, 0.0118]),
                                      ("collocation", [-0.311, -0.054, -0.021], [0.097, 0.025, 0.0113])):
            found = [self.cantilever(method, (1, 0.2, 0.2), (5 * n, n, n), 10) for n in (1, 2, 3)]
            np.testing.assert_allclose([part for _, part in found], parts, rtol=0.02)
            np.testing.assert_allclose([w / right - 1 for w, _ in found], errors, atol=1e-3)
        (thin, part), (true, _) = (self.cantilever(method, (1, 1, 0.05), (10, 10, 1), 0.1)
                                   for method in ("collocation", "galerkin"))
        self.assertAlmostEqual(part, 0.020, delta=1e-3)
        self.assertAlmostEqual(thin / true, 0.305, delta=0.01)

    def test_bodies_without_deformation(self):
        rigid = self.archive("rigid", "--model", "rigid")
        self.assertNotIn("mesh_coarseness", self.info(rigid))
        self.assertNotIn("coarseness:", program("bemprecomp", "--info", rigid).stdout)
        resting, none = self.stats_of({"name": "resting", "archive": str(models / "ball.bem")},
                                      {"name": "rigid", "archive": str(rigid), "position": [1, 0, 0]})
        self.assertIsNone(none)
        self.assertEqual(resting["reconstructed_part"], 0)
        self.assertNotIn("where", resting)

    def test_resumed(self):
        whole = self.stats_of(held_ball(), falling_ball())
        self.stats_of(held_ball(), falling_ball(), steps=4, options=["--checkpoint-every", 4])
        self.scene["duration"] = 10 * DT
        stats = self.folder / "resumed.json"
        self.simulate("--stats", stats, "--resume", scene=self.scene)
        self.assertEqual([body["coarseness"] for body in json.loads(stats.read_text())["bodies"]], whole)

    def test_info(self):
        coarse = self.info(models / "ball.bem")["mesh_coarseness"]
        self.assertGreater(coarse, 0.05)
        self.assertLess(coarse, 0.5)
        stats = self.folder / "precomputed.json"
        fine = self.archive("fine", "--model", "static", "--stats", stats, subdivisions=2)
        self.assertAlmostEqual(coarse / self.info(fine)["mesh_coarseness"], 4, delta=0.3)
        self.assertAlmostEqual(json.loads(stats.read_text())["body"]["mesh_coarseness"],
                               self.info(fine)["mesh_coarseness"], 12)
        line = [text for text in program("bemprecomp", "--info", models / "ball.bem").stdout.splitlines()
                if text.startswith("coarseness:")]
        self.assertEqual(len(line), 1)
        self.assertIn(f"{100 * coarse:.2g} %", line[0])


if __name__ == "__main__":
    unittest.main()
