"""The default discretisation with every scheme, material, codec and kind of storage, held to closed forms and to itself."""
import json
import shutil
import unittest

import numpy as np

from simulation_case import SimulationCase, program

LENGTH, WIDTH, SHEAR, DENSITY, LOAD = 0.4, 0.2, 1e5, 1000, 200
END = {"box": {"min": [-0.201, -1, -1], "max": [-0.199, 1, 1]}}
OTHER_END = {"box": {"min": [0.199, -1, -1], "max": [0.201, 1, 1]}}
DT = 0.004
EXACT = ("--codec", "none", "--precision", "float64")


def young(poisson):
    return 2 * SHEAR * (1 + poisson)


def period(poisson):
    """Of the slowest motion along a bar that is held at one end."""
    return 4 * LENGTH / (young(poisson) / DENSITY) ** 0.5


class Galerkin(SimulationCase):
    def setUp(self):
        super().setUp()
        self.scene = {"version": 1, "time_step": DT, "duration": 0.1, "bodies": []}
        program("bemshape", "box", "--size", LENGTH, WIDTH, WIDTH, "--divisions", 2, 1, 1, "-o", self.folder / "bar.obj")

    def archive(self, name, *options, poisson=0.0, dt=DT):
        """An archive of the bar; nothing may be warned of."""
        material = {"name": "rubber", "density": DENSITY, "shear_modulus": SHEAR, "poisson_ratio": poisson}
        (self.folder / "rubber.json").write_text(json.dumps(material))
        step = [] if "static" in options else ["--dt", dt]
        done = program("bemprecomp", self.folder / "bar.obj", self.folder / "rubber.json", "-o", self.folder / name,
                       "--force", "--quiet", *step, *options)
        self.assertEqual(done.stderr, "", options)
        info = json.loads(program("bemprecomp", "--info", self.folder / name, "--json").stdout)
        self.assertEqual(info["scheme"]["discretisation"], "galerkin")
        self.assertNotIn("growth", info["report"])
        if "static" not in options:
            self.assertEqual(info["scheme"]["window"], 1)
        program("bemprecomp", "--verify", self.folder / name)
        return info

    def run_of(self, *bodies, steps, dt=DT, **more):
        """Positions by body after every step, and the statistics; nothing may be warned of."""
        scene = {**self.scene, "time_step": dt, "duration": steps * dt, "bodies": list(bodies), **more}
        done = self.simulate("--quiet", "--stats", self.folder / "stats.json", scene=scene)
        self.assertEqual(done.stderr, "")
        with self.trajectory() as file:
            found = [np.array(file[f"bodies/{body['name']}/positions"]) for body in bodies]
        shutil.rmtree(self.out)
        stats = json.loads((self.folder / "stats.json").read_text())
        self.assertLess(stats["momentum"]["relative_defect"], 1e-11)
        return found, stats

    def held(self, archive, **more):
        return {"name": "bar", "archive": archive, "frame": "static", "fixed": [END],
                "tractions": [{"select": OTHER_END, "traction": [LOAD, 0, 0]}], **more}

    def pulled(self, archive, steps, dt=DT, poisson=0.0, **more):
        """How far the end that is pulled from the start on is after each step, over p L/E."""
        (x,), _ = self.run_of(self.held(archive, **more), steps=steps, dt=dt)
        along = x[:, x[0, :, 0] > 0.199, 0] - LENGTH / 2
        return along.mean(axis=1) * young(poisson) / (LOAD * LENGTH)

    def test_bodies_that_hang_do_not_drift_in_their_frames(self):
        """Thousands of steps under a load, whatever the codec leaves of forces and torques."""
        program("bemshape", "box", "--size", 0.2, 0.05, 0.05, "--divisions", 4, 2, 2, "-o", self.folder / "bar.obj")
        for codec in (("lowrank", "--codec-tol", "1e-3"), ("haar", "--codec-tol", "1e-2")):
            self.archive("link.bem", "--codec", *codec, poisson=0.3, dt=0.002)
            joints = [{"type": "point", "a": {"body": "link", "point": p}} for p in ([-0.1, 0, 0], [0.1, 0, 0], [0, 0.025, 0])]
            (x,), _ = self.run_of({"name": "link", "archive": "link.bem"}, steps=3000, dt=0.002, joints=joints,
                                  gravity=[0, -0.9, 0.3], output={"every": 50})
            swing = np.abs(x - x[0]).max(axis=(1, 2))  # it rocks on its hinges
            self.assertGreater(swing[:30].max(), 3e-4)
            self.assertLess(swing.max(), 1.3 * swing[:30].max(), codec)

    def test_long_steps_of_slender_bodies_do_not_grow(self):
        """A step of ten times what a shear wave takes along it is short for the bending of a bar of 40 by 1: what
        codecs leave of stiff motions must not exceed them."""
        program("bemshape", "box", "--size", 40, 1, 1, "--divisions", 20, 1, 1, "-o", self.folder / "bar.obj")
        (self.folder / "rubber.json").write_text(
            json.dumps({"name": "rubber", "density": 1000, "shear_modulus": 1e5, "poisson_ratio": 0.3}))
        for inverse, tolerance in (("dense", 1e-4), ("dense", 1e-3), ("iterative", 1e-4)):
            program("bemprecomp", self.folder / "bar.obj", self.folder / "rubber.json", "-o", self.folder / "long.bem",
                    "--force", "--quiet", "--dt", 40, "--inverse", inverse, "--codec-tol", tolerance, "--measure-growth")
            info = json.loads(program("bemprecomp", "--info", self.folder / "long.bem", "--json").stdout)
            self.assertLess(info["report"]["growth"], 1.0003, (inverse, tolerance))

    def test_schemes_and_materials(self):
        """A load that sets in suddenly: vibrations between 0 and 2 about the static stretch, which decay or stay."""
        cases = [("radau2", 0, ()), ("radau3", 0, ()), ("bdf1", 0, ()), ("bdf2", 0, ()), ("theta:0.75", 0, ()),
                 ("radau2", 0.3, ()), ("radau2", 0.5, ()), ("radau3", 0.5, ()), ("bdf2", 0.5, ()),
                 ("radau2", 0, ("--damping", "kelvin_voigt:0.005")), ("bdf1", 0.3, ("--damping", "kelvin_voigt:0.005")),
                 ("radau2", 0.3, ("--codec", "none")), ("radau2", 0.3, ("--corner-angle-deg", "none"))]
        left = {}
        for scheme, poisson, options in cases:
            with self.subTest(scheme=scheme, poisson=poisson, options=options):
                self.archive("bar.bem", "--scheme", scheme, *options, poisson=poisson)
                once = round(period(poisson) / DT)
                way = self.pulled("bar.bem", 3 * once, poisson=poisson)
                # a held end does not thin: with nu > 0 the bar is stiffer than p L/E says
                self.assertAlmostEqual(way[once:].mean(), 1 - 0.25 * poisson, delta=0.06)
                self.assertTrue(1 < way.max() < 2.1, way.max())
                first, last = np.ptp(way[1:once + 1]), np.ptp(way[-once:])
                self.assertLess(last, 1.02 * first)
                left[scheme, poisson, options] = last / first
        damping = ("--damping", "kelvin_voigt:0.005")
        for less, more in ((("bdf1", 0, ()), ("theta:0.75", 0, ())), (("theta:0.75", 0, ()), ("bdf2", 0, ())),
                           (("radau2", 0, damping), ("radau2", 0, ()))):
            self.assertLess(left[less], left[more] - 0.02, (less, more))

    def test_static_bodies(self):
        """At once where they belong, for any time step."""
        for poisson in (0, 0.3, 0.5):
            self.archive("static.bem", "--model", "static", poisson=poisson)
            for dt in (0.01, 0.07):
                way = self.pulled("static.bem", 3, dt, poisson)
                self.assertLess(np.ptp(way[1:]), 1e-6)
                self.assertAlmostEqual(way[1], 1 - 0.25 * poisson, delta=0.05)

    def test_rotation_stretches(self):
        """A bar that turns is longer by rho w^2 L^3/24 E on each side."""
        speed = 2
        stretch = DENSITY * speed**2 * LENGTH**3 / (24 * young(0))
        self.archive("static.bem", "--model", "static")
        self.archive("dynamic.bem")
        for archive, steps in (("static.bem", 3), ("dynamic.bem", round(4 * period(0) / DT))):
            found = []
            for centrifugal in (True, False):
                body = {"name": "bar", "archive": archive, "angular_velocity": [0, 0, speed], "centrifugal": centrifugal}
                (x,), _ = self.run_of(body, steps=steps)
                ends = [x[:, side * x[0, :, 0] > 0.199].mean(axis=1) for side in (-1, 1)]
                found.append(np.linalg.norm(ends[1] - ends[0], axis=1)[1:].mean() - LENGTH)
            self.assertLess(abs(found[1]), 1e-6 * LENGTH)
            self.assertAlmostEqual(found[0] / (2 * stretch), 1, delta=0.08)

    def test_both_frames(self):
        """A held body moves in its own frame as in that of the world; a free one falls."""
        self.archive("bar.bem", poisson=0.3)
        once = round(period(0.3) / DT)
        ways = [self.pulled("bar.bem", 2 * once, poisson=0.3, frame=frame) for frame in ("static", "moving")]
        self.assertLess(np.abs(ways[0] - ways[1]).max(), 0.02)
        free = {"name": "bar", "archive": "bar.bem", "angular_velocity": [1, 2, 3], "velocity": [1, 0, 0]}
        (x,), _ = self.run_of(free, steps=50, gravity=[0, 0, -9.81])
        time = 50 * DT
        centre = x.mean(axis=1)
        np.testing.assert_allclose(centre[-1] - centre[0], [time, 0, -9.81 * time**2 / 2], atol=1e-5)

    def test_storage(self):
        """Codecs, the iterative inverse and chosen loads: the motion of the uncompressed archive."""
        with open(self.folder / "ends.json", "w", encoding="utf-8") as file:
            json.dump([END, OTHER_END], file)
        self.archive("exact.bem", *EXACT, poisson=0.3)
        steps = 2 * round(period(0.3) / DT)
        exact = self.pulled("exact.bem", steps, poisson=0.3, frame="moving")
        cases = [(("--codec", "none"), 1e-4), (("--codec-tol", "1e-4"), 1e-3), (("--codec-tol", "1e-2"), 0.05),
                 (("--codec", "haar", "--codec-tol", "1e-4"), 2e-3), ((*EXACT, "--inverse", "iterative"), 1e-5),
                 (("--inverse", "iterative"), 1e-3), (("--loads", "ends.json"), 1e-3),
                 (("--loads", "ends.json", "--inverse", "iterative"), 1e-3)]
        for options, bound in cases:
            with self.subTest(options=options):
                info = self.archive("bar.bem", *(str(self.folder / o) if o == "ends.json" else o for o in options),
                                    poisson=0.3)
                self.assertEqual(info["matrices"]["inverse"], "iterative" if "iterative" in options else "dense")
                way = self.pulled("bar.bem", steps, poisson=0.3, frame="moving")
                self.assertLess(np.abs(way - exact).max(), bound)

    def test_bodies_that_share_an_archive_or_do_not(self):
        """Each moves as alone; one of the other discretisation may touch and hold them."""
        self.archive("bar.bem", poisson=0.3)
        alone = self.held("bar.bem", position=[0, 0, 1], frame="moving")
        other = {**alone, "name": "other", "position": [0, 1, 1]}
        (single,), _ = self.run_of(alone, steps=20)
        (x, y), _ = self.run_of(alone, other, steps=20)
        np.testing.assert_allclose(x, single, rtol=0, atol=1e-12)
        np.testing.assert_allclose(y - [0, 1, 0], single, rtol=0, atol=1e-9)

        program("bemprecomp", self.folder / "bar.obj", self.folder / "rubber.json", "-o", self.folder / "paper.bem",
                "--dt", DT, "--discretisation", "collocation", "--quiet")
        bodies = [{"name": "low", "archive": "paper.bem", "position": [0, 0, 0.1], "friction": 0.4},
                  {"name": "high", "archive": "bar.bem", "position": [0.1, 0.02, 0.31], "velocity": [0, 0, -0.5]},
                  {"name": "hung", "archive": "bar.bem", "position": [1, 0, 1]},
                  {"name": "hanging", "archive": "paper.bem", "position": [1.4, 0, 1]}]
        floor = {"name": "floor", "plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}
        joints = [{"type": "point", "a": {"body": "hung", "point": [0.8, 0, 1]}},
                  {"type": "weld", "a": {"body": "hung"}, "b": {"body": "hanging"}}]
        found, stats = self.run_of(*bodies, steps=60, gravity=[0, 0, -9.81], contact={}, obstacles=[floor], joints=joints)
        self.assertGreater(stats["constraints"]["steps_with_contact"], 10)
        self.assertLess(max(np.abs(x - x[0]).max() for x in found), 0.5)
        self.assertGreater(min(x[:, :, 2].min() for x in found), -1e-4)


if __name__ == "__main__":
    unittest.main()
