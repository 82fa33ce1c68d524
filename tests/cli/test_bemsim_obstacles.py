"""Obstacles of every kind, what is in each other at the start, and what nothing can satisfy."""
import json
import unittest

import numpy as np

from simulation_case import SimulationCase, models, program

CUBE = ([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)],
        [(0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7), (0, 1, 5), (0, 5, 4), (1, 2, 6), (1, 6, 5), (2, 3, 7), (2, 7, 6),
         (3, 0, 4), (3, 4, 7)])
SHEET = ([(-1, 0, -1), (-1, 0, 1), (1, 0, 1), (1, 0, -1)], [(0, 1, 2), (0, 2, 3)])  # faces up


def turned(mesh):
    return mesh[0], [(a, c, b) for a, b, c in mesh[1]]


class ObstacleCase(SimulationCase):
    def obj(self, name, mesh):
        lines = [f"v {x} {y} {z}" for x, y, z in mesh[0]] + ["f " + " ".join(str(i + 1) for i in f) for f in mesh[1]]
        (self.folder / name).write_text("\n".join(lines) + "\n")

    def drop(self, mesh, steps=60, height=0.7, side=1, **placement):
        """Lowest place of a ball of radius 0.1 m that falls onto the mesh, or rises to it (side -1)."""
        self.obj("o.obj", mesh)
        self.scene.update(
            duration=steps * self.scene["time_step"], gravity=[0, -9.81 * side, 0], contact={},
            bodies=[{"name": "b", "archive": str(models / "ball.bem"), "position": [0.03, side * height, 0.02]}],
            obstacles=[{"name": "o", "mesh": "o.obj", **placement}])
        self.messages = self.simulate("--force").stderr
        with self.trajectory() as f:
            return (side * f["bodies/b/positions"][:, :, 1]).min()


class Obstacles(ObstacleCase):
    def test_closed_ones_are_solid_whichever_way_they_face(self):
        flat = ([(x, 0.25 * y + 0.25, z) for x, y, z in CUBE[0]], CUBE[1])
        self.assertAlmostEqual(self.drop(flat), 0.5, delta=1e-4)
        self.assertNotIn("warning", self.messages)
        self.assertAlmostEqual(self.drop(turned(flat)), 0.5, delta=1e-4)
        self.assertIn("warning", self.messages)
        self.assertIn("turned outward", self.messages)

    def test_open_ones_hold_from_both_sides(self):
        for mesh in (SHEET, turned(SHEET)):
            for side in (1, -1):
                with self.subTest(side=side, first=mesh[1][0]):
                    self.assertAlmostEqual(self.drop(mesh, height=0.2, side=side), 0, delta=1e-4)
                    self.assertNotIn("warning", self.messages)

    def test_one_that_turns_too_far_in_a_step_is_warned_of(self):
        for degrees, warned in [(60, False), (360, True)]:
            self.drop(SHEET, steps=1, motion=[
                {"time": 0}, {"time": self.scene["time_step"], "rotate": {"axis": [0, 1, 0], "angle_deg": degrees}}])
            self.assertEqual("360 degrees in a time step" in self.messages, warned)

    def test_a_body_may_start_on_a_sheet(self):
        self.assertAlmostEqual(self.drop(turned(SHEET), height=0.1), 0, delta=1e-4)

    def test_sheets_that_meet_in_an_edge(self):
        fin = (SHEET[0] + [(0, 0, -1), (0, 0, 1), (0, 0.3, 0)],
               [(0, 1, 5), (0, 5, 4), (4, 5, 2), (4, 2, 3), (4, 5, 6)])
        self.assertGreater(self.drop(fin, height=0.5), -1e-4)
        with self.trajectory() as f:  # it starts right of the fin, and stays there
            self.assertGreater(f["bodies/b/positions"][-1, :, 0].mean(), 0.02)

    def test_scale_and_rotation(self):
        plate = ([(x, y, z) for x, y, z in CUBE[0]], CUBE[1])
        self.assertAlmostEqual(self.drop(plate, scale=0.3), 0.3, delta=1e-4)
        self.assertAlmostEqual(self.drop(plate, scale=[1, 0.2, 1], position=[0, 0.1, 0]), 0.3, delta=1e-4)
        self.assertAlmostEqual(self.drop(plate, scale=[0.2, 1, 1], rotation={"axis": [0, 0, 1], "angle_deg": 90}),
                               0.2, delta=1e-4)
        for wrong in (0, -1, [1, 1], [1, 0, 1], "big"):
            with self.subTest(wrong):
                self.scene["obstacles"][0]["scale"] = wrong
                self.assert_error(self.simulate(expect=3), "/obstacles/0/scale", "expected")

    def test_the_plan_says_where_things_are(self):
        self.drop(SHEET, steps=1, scale=0.5, position=[0, -1, 0])
        out = program("bemsim", self.scene_file, "--check").stdout
        self.assertIn("sheet of 2 triangles that holds on both sides", out)
        self.assertIn("(-0.5, -1, -0.5) to (0.5, -1, 0.5) m", out)
        self.assertIn("mesh coordinates (-0.1, -0.1, -0.1) to (0.1, 0.1, 0.1) m", out)
        self.assertIn("placed at        (-0.07, 0.6, -0.08) to", out)
        info = program("bemprecomp", "--info", models / "ball.bem").stdout
        self.assertIn("(-0.1, -0.1, -0.1) to (0.1, 0.1, 0.1) m", info)
        self.scene["obstacles"][0]["mesh"] = "none.obj"
        self.assert_error(self.simulate("--force", expect=3), "/obstacles/0/mesh", "none.obj")


class Overlaps(ObstacleCase):
    def bar(self):
        if not (models / "bar.bem").exists():
            program("bemshape", "box", "--size", 0.6, 0.1, 0.1, "--divisions", 6, 1, 1, "-o", models / "bar.obj")
            program("bemprecomp", models / "bar.obj", models / "rubber.json", "--model", "rigid", "-o",
                    models / "bar.bem", "-q")
        return str(models / "bar.bem")

    def overlaps(self, bodies, obstacles=()):
        self.scene.update(duration=0.01, gravity=[0, 0, 0], contact={}, obstacles=list(obstacles),
                          bodies=[{"archive": self.bar(), **b} for b in bodies])
        return self.simulate("--force").stderr

    def test_whatever_they_look_like(self):
        upright = {"axis": [0, 0, 1], "angle_deg": 90}
        cases = {"crossing": [{"name": "a"}, {"name": "b", "rotation": upright, "position": [0.02, 0.01, 0.03]}],
                 "flush": [{"name": "a"}, {"name": "b", "rotation": upright}],
                 "the same place": [{"name": "a"}, {"name": "b"}],
                 "one within": [{"name": "a"}, {"name": "b", "archive": str(models / "ball.bem")}]}
        for name, bodies in cases.items():
            with self.subTest(name):
                found = self.overlaps(bodies)
                self.assertIn('warning: "a" and "b" overlap at the start, by 0.', found)

    def test_with_obstacles(self):
        self.obj("wall.obj", ([(0.01, -1, -1), (0.01, 1, -1), (0.01, 0, 2)], [(0, 1, 2)]))
        found = self.overlaps([{"name": "a"}], [{"name": "wall", "mesh": "wall.obj"},
                                                {"name": "twin", "mesh": str(models / "bar.obj")}])
        self.assertIn('"a" and "wall" overlap at the start, by 0.', found)
        self.assertIn('"a" and "twin" overlap at the start, by 0.', found)

    def test_what_touches_does_not(self):
        found = self.overlaps([{"name": "a"}, {"name": "b", "position": [0, 0.1, 0]},
                               {"name": "c", "position": [0.6, 0.05, 0]}])
        self.assertNotIn("overlap", found)


class Welds(ObstacleCase):
    def weld(self, shift=0.0, divisions=2, **joint):
        for name, n in (("left", 2), ("right", divisions)):
            program("bemshape", "box", "--size", 0.2, 0.2, 0.2, "--divisions", 2, n, n, "-o", self.folder / f"{name}.obj")
            program("bemprecomp", self.folder / f"{name}.obj", models / "rubber.json", "--model", "rigid", "-o",
                    self.folder / f"{name}.bem", "-q", "--force")
        self.scene.update(duration=0.01, gravity=[0, 0, 0], joints=[
            {"type": "weld", "a": {"body": "left"}, "b": {"body": "right"}, **joint}],
            bodies=[{"name": "left", "archive": "left.bem"},
                    {"name": "right", "archive": "right.bem", "position": [0.2 + shift, 0, 0]}])
        return self.simulate("--force").stderr

    def test_they_say_what_they_join(self):
        found = self.weld()
        self.assertIn('weld of "left" and "right" joins 9 vertices', found)
        self.assertNotIn("warning", found)

    def test_vertices_that_nearly_match(self):
        found = self.weld(shift=1e-5, tolerance=1.5e-5)
        self.assertNotIn("warning", found)
        self.scene_file.write_text(json.dumps(self.scene).replace("1.5e-05", "1e-06"))
        done = program("bemsim", self.scene_file, "-o", self.out, "--force", expect=3)
        self.assert_error(done, "/joints/0", "18 vertices miss a partner by up to 1e-05 m", "raise the tolerance")

    def test_an_interface_that_matches_in_part(self):
        found = self.weld(divisions=4)
        self.assertIn("joins 9 vertices; 16 vertices of one surface lie on the other where it has no vertex", found)


class Impossible(ObstacleCase):
    def squeeze(self, steps):
        """A rigid ball of radius 0.1 m between plates whose gap closes from 0.2 to 0.1 m in a second."""
        program("bemprecomp", models / "ball.obj", models / "rubber.json", "--model", "rigid", "-o",
                self.folder / "rigid.bem", "-q", "--force")
        self.obj("plate.obj", ([(0.1 * x, y, z) for x, y, z in CUBE[0]], CUBE[1]))

        def plate(name, side):
            return {"name": name, "mesh": "plate.obj", "position": [side * 0.2, 0, 0],
                    "motion": [{"time": 0}, {"time": 1, "translate": [-side * 0.05, 0, 0]}]}
        self.scene.update(duration=steps * self.scene["time_step"], gravity=[0, 0, 0], contact={},
                          bodies=[{"name": "b", "archive": "rigid.bem"}],
                          obstacles=[plate("left", -1), plate("right", 1)])
        done = self.simulate("--force", "--threads", 1, "--stats", self.folder / "stats.json")
        return done.stderr, json.loads((self.folder / "stats.json").read_text())["constraints"]

    def test_a_squeeze_that_nothing_satisfies_is_told_as_it_is(self):
        messages, constraints = self.squeeze(60)
        with self.trajectory() as f:
            x = f["bodies/b/positions"][:, :, 0]
            gap = 0.1 - 0.05 * f["time"][:]
        depth = np.maximum(x.max(1) - gap, -gap - x.min(1))
        self.assertGreater(depth[-1], 0.028)  # 0.03 on either side
        self.assertLess(np.abs(x.mean(1)).max(), 0.002)  # it stays in the middle
        self.assertAlmostEqual(constraints["largest_penetration"], depth.max(), delta=1e-5)
        self.assertGreater(constraints["steps_with_contact"], 57)
        self.assertGreater(constraints["not_met"]["infeasible"], 50)
        self.assertLess(constraints["solver_newton_steps"]["mean"], 2000)
        self.assertIn("squeezed", messages)

    def test_handles_that_twist_a_body_too_far(self):
        self.scene.update(duration=0.1, gravity=[0, 0, 0], bodies=[{"name": "bar", "archive": str(models / "ball.bem"),
            "handles": [{"select": {"box": {"min": [-1, -1, -1], "max": [-0.05, 1, 1]}},
                         "motion": [{"time": 0}, {"time": 1, "rotate": {"axis": [1, 0, 0], "angle_deg": -180}}]},
                        {"select": {"box": {"min": [0.05, -1, -1], "max": [1, 1, 1]}},
                         "motion": [{"time": 0}, {"time": 1, "rotate": {"axis": [1, 0, 0], "angle_deg": 180}}]}]}])
        self.assertNotIn("turn against each other", self.check().stderr)
        self.scene["duration"] = 1.2
        text = self.check().stderr
        self.assertIn("/bodies/0", text)
        self.assertIn("by 360 degrees; from about 180 degrees on, at t = 0.5", text)
        self.assertIn("welds", text)
        handles = self.scene["bodies"][0]["handles"]
        handles[0]["motion"][1].update(time=1e6, rotate={"axis": [1, 0, 0], "angle_deg": 3.6e11})  # far ahead
        self.assertIn("turn against each other", self.check().stderr)
        handles[1]["motion"] = handles[0]["motion"]  # a shaft that is driven at both ends
        self.assertNotIn("turn against each other", self.check().stderr)
        handles[0]["motion"] = [{"time": 0}, {"time": 1, "rotate": {"axis": [1, 0, 0], "angle_deg": -180}}]
        handles[1]["motion"] = [{"time": 0}, {"time": 1, "rotate": {"axis": [1, 0, 0], "angle_deg": 180}}]
        handles[0]["release_time"] = 0.45
        self.assertNotIn("turn against each other", self.check().stderr)


if __name__ == "__main__":
    unittest.main()
