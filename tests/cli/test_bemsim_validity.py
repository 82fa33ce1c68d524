"""What bemsim says of bodies that are deformed by more than linear elasticity can describe."""
import json
import unittest

import numpy as np

from simulation_case import DT, SimulationCase, models, volume

LEFT, RIGHT = ({"box": {"min": [-1, -1, -1], "max": [-0.05, 1, 1]}}, {"box": {"min": [0.05, -1, -1], "max": [1, 1, 1]}})


def turning(side, degrees):
    return {"select": side, "motion": [{"time": 0}, {"time": 0.2, "rotate": {"axis": [1, 0, 0], "angle_deg": degrees}}]}


class Validity(SimulationCase):
    def run_ball(self, expect=0, frame="moving", steps=20, **body):
        self.scene["bodies"] = [{"name": "ball", "archive": str(models / "ball.bem"), "frame": frame, **body}]
        self.scene.pop("gravity", None)
        self.scene["duration"] = steps * DT
        stats = self.folder / "stats.json"
        done = self.simulate("--stats", stats, "--force", expect=expect, scene=self.scene)
        return done, json.loads(stats.read_text())

    def volumes(self):
        with self.trajectory() as file:
            x, faces = file["bodies/ball/positions"][:], file["bodies/ball/faces"][:]
        return np.array([volume(frame, faces) for frame in x])

    def test_small_deformations(self):
        done, stats = self.run_ball(handles=[turning(LEFT, -5), turning(RIGHT, 5)])
        self.assertNotIn("linear elasticity", done.stderr)
        validity = stats["bodies"][0]["validity"]
        ratios = self.volumes() / self.volumes()[0]
        np.testing.assert_allclose(validity["volume_ratio"], [ratios.min(), ratios.max()], rtol=1e-9)
        self.assertFalse(validity["inverted"])
        self.assertGreater(validity["largest_rotation_deg"], 2)
        self.assertLess(validity["largest_rotation_deg"], 20)
        self.assertLess(validity["area_ratio"][0], 1)

    def test_swelling(self):
        """Opposite turns in a static frame: the middle stays where it is, and what is between swells."""
        done, stats = self.run_ball(frame="static", handles=[turning(LEFT, -80), turning(RIGHT, 80)])
        warnings = [line for line in done.stderr.splitlines() if line.startswith("warning:") and "linear elas" in line]
        self.assertEqual(len(warnings), 1, done.stderr)
        for part in ('"ball"', "degrees", "t = ", "triangle ", '"frame": "moving"', "welds"):
            self.assertIn(part, warnings[0])
        validity = stats["bodies"][0]["validity"]
        self.assertGreater(validity["largest_rotation_deg"], 70)
        self.assertEqual([text for text in stats["warnings"] if "linear elasticity" in text],
                         [warnings[0].removeprefix("warning: ")])
        self.assertFalse(validity["inverted"])

    def test_inversion(self):
        """A handle that is pushed through the fixed side of the body turns it inside out."""
        push = {"select": RIGHT, "motion": [{"time": 0}, {"time": 0.2, "translate": [-0.4, 0, 0]}]}
        for frame in ("moving", "static"):
            with self.subTest(frame):
                done, stats = self.run_ball(expect=5, frame=frame, fixed=[LEFT], handles=[push])
                error, = [line for line in done.stderr.splitlines() if line.startswith("error: ")]
                for part in ('body "ball" is turned inside out at t = ', "welds"):
                    self.assertIn(part, error)
                self.assertIn("warning: the body", done.stderr)
                self.assertEqual(stats["outcome"], "failed")
                self.assertTrue(stats["bodies"][0]["validity"]["inverted"])
                self.assertTrue((self.volumes() > 0).all())


if __name__ == "__main__":
    unittest.main()
