"""The default discretisation with every scheme, material, codec and kind of storage, held to closed forms and to itself."""
import json
import shutil
import unittest

import numpy as np

from simulation_case import SimulationCase, program, read_obj

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

    def plucked(self, load, steps, dt):
        """Positions of a beam of 1 m that is held at one face, in its moving frame, after a load at the other end."""
        program("bemshape", "box", "--size", 1, 0.2, 0.2, "--divisions", 5, 1, 1, "-o", self.folder / "bar.obj")
        (self.folder / "rubber.json").write_text(
            json.dumps({"name": "rubber", "density": 1000, "shear_modulus": 1e6, "poisson_ratio": 0.3}))
        program("bemprecomp", self.folder / "bar.obj", self.folder / "rubber.json", "-o", self.folder / "beam.bem",
                "--force", "--quiet", "--dt", dt)
        body = {"name": "bar", "archive": "beam.bem",
                "fixed": [{"box": {"min": [-1, -1, -1], "max": [-0.499, 1, 1]}}],
                "tractions": [{"select": {"box": {"min": [0.29, -1, -1], "max": [1, 1, 1]}},
                               "traction": [3 * load, 2 * load, load], "profile": [[0, 1], [0.1, 1], [0.101, 0]]}]}
        (x,), _ = self.run_of(body, steps=steps, dt=dt)
        return x

    def test_large_vibrations_of_held_bodies_stay_bounded(self):
        """The work of the force that holds a body is that on its frame and that on its deformation."""
        x = self.plucked(700, 2800, 0.005)
        swing = np.linalg.norm(x - x[0], axis=2).max(axis=1)
        self.assertGreater(swing[:700].max(), 0.2)
        self.assertLess(swing[-700:].max(), 1.02 * swing[:700].max())

    def test_small_vibrations_of_held_bodies_do_not_grow(self):
        """Slow ones lose what the scheme takes of them, however long they last."""
        dt, window = 0.01, 1500
        x = self.plucked(1, 8000, dt)
        tip = x[:, np.argmax(x[0, :, 0])] - x[0, np.argmax(x[0, :, 0])]

        def slow(from_step):
            spectrum = np.fft.rfft(tip[from_step:from_step + window] * np.hanning(window)[:, None], axis=0)
            frequency = np.fft.rfftfreq(window, dt)
            return np.linalg.norm(spectrum[(frequency > 1) & (frequency < 3)])

        left = slow(6400) / slow(100)
        self.assertLess(left, 1.0005)
        self.assertGreater(left, 0.9)

    def test_thin_rims_do_not_grow(self):
        """A lens of 1 m and 20 mm: its resistance to being squeezed is what pairs of its triangles differ by."""
        rim = [(0.5 * np.cos(t), 0.5 * np.sin(t), 0) for t in np.arange(8) * np.pi / 4]
        faces = [(8, k, (k + 1) % 8) for k in range(8)] + [(9, (k + 1) % 8, k) for k in range(8)]
        (self.folder / "bar.obj").write_text(
            "".join(f"v {x} {y} {z}\n" for x, y, z in [*rim, (0, 0, 0.01), (0, 0, -0.01)]) +
            "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces))
        (self.folder / "rubber.json").write_text(
            json.dumps({"name": "rubber", "density": 1000, "shear_modulus": 1e6, "poisson_ratio": 0.3}))
        program("bemprecomp", self.folder / "bar.obj", self.folder / "rubber.json", "-o", self.folder / "lens.bem",
                "--quiet", "--dt", 0.0055, "--scheme", "radau3", "--measure-growth", "--loads", "none")
        info = json.loads(program("bemprecomp", "--info", self.folder / "lens.bem", "--json").stdout)
        self.assertLess(info["report"]["growth"], 1.0003)

    def test_bodies_with_cavities_are_left_to_collocation(self):
        for name, radius in (("outer", 0.5), ("inner", 0.25)):
            program("bemshape", "icosphere", "--subdivisions", 1, "--radius", radius, "-o", self.folder / f"{name}.obj")
        outer, inner = (read_obj(self.folder / f"{name}.obj") for name in ("outer", "inner"))
        faces = np.concatenate([outer[1], inner[1][:, ::-1] + len(outer[0])])
        (self.folder / "bar.obj").write_text(
            "".join("v %g %g %g\n" % tuple(v) for v in np.concatenate([outer[0], inner[0]])) +
            "".join("f %d %d %d\n" % tuple(f + 1) for f in faces))
        (self.folder / "rubber.json").write_text(
            json.dumps({"name": "rubber", "density": 1000, "shear_modulus": 1e6, "poisson_ratio": 0.3}))
        common = (self.folder / "bar.obj", self.folder / "rubber.json", "-o", self.folder / "shell.bem", "--dt", 0.0137,
                  "--scheme", "bdf1", "--quiet")
        done = program("bemprecomp", *common, "--discretisation", "galerkin", expect=3)
        self.assertIn("bar.obj: the body has a cavity inside", done.stderr)
        self.assertIn("use --discretisation collocation", done.stderr)
        self.assertFalse((self.folder / "shell.bem").exists())
        done = program("bemprecomp", *common)
        self.assertIn("--discretisation collocation is used instead of galerkin", done.stderr)
        info = json.loads(program("bemprecomp", "--info", self.folder / "shell.bem", "--json").stdout)
        self.assertEqual(info["scheme"]["discretisation"], "collocation")
        self.assertNotIn("galerkin", info["provenance"]["options"])
        self.assertIn("--corner-angle-deg none", info["provenance"]["options"])

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
