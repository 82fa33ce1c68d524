"""scripts/study: its closed forms and measures, the input of CalculiX, and its tables."""
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from common import meshes  # noqa: E402
from study import calculix, measures, time_schemes  # noqa: E402
from study.closed_forms import Beam, Rod, Sphere, Tumbling  # noqa: E402
from study.problems import PROBLEMS  # noqa: E402
from study.settings import SCHEMES, Setting  # noqa: E402


class ClosedForms(unittest.TestCase):
    def test_the_rod(self):
        rod = Rod()
        quarters = np.arange(9) * rod.PERIOD / 4
        np.testing.assert_allclose(rod.end(quarters, True), [0, 1e-3, 2e-3, 1e-3, 0, 1e-3, 2e-3, 1e-3, 0], atol=1e-15)
        np.testing.assert_allclose(rod.end(quarters[:4], False), [0, 1e-3, 2e-3, 5e-3], atol=1e-15)

    def test_the_pressed_sphere(self):
        times = [0.13, 0.5, 0.9, 1.45, 1.99, 2.3, 3.1]
        known = {(1e6, 0.3): [0.242976, 0.917510, 1.491308, 1.608270, 0.355846, 0.301200, 1.225881],
                 (3e5, 0.45): [0.327977, 1.076048, 1.506755, 1.302635, 0.054932, 0.579311, 1.550496]}
        for material, values in known.items():
            sphere = Sphere(*material)
            t = np.array(times) * sphere.RADIUS / sphere.c1
            np.testing.assert_allclose(sphere.pressed(t) / sphere.static, values, atol=4e-5)
        self.assertAlmostEqual(1 / Sphere().breathing_period(), 50.2841, 3)

    def test_lambs_modes(self):
        sphere = Sphere()
        unit = sphere.RADIUS / sphere.c2
        self.assertAlmostEqual(sphere.quadrupole() * unit, 2.64622, 5)
        self.assertAlmostEqual(sphere.quadrupole(1) * unit, 5.00696, 5)

    def test_the_beam_is_near_beam_theory(self):
        beam = Beam()
        self.assertAlmostEqual(beam.timoshenko(), 1.501e-3, 6)
        self.assertLess(abs(beam.static() / beam.timoshenko() - 1), 0.03)
        self.assertLess(abs(1 / beam.period() / 5.054 - 1), 0.02)
        self.assertEqual(beam.tip(np.zeros(1))[0], 0)

    def test_a_tumbling_box_keeps_its_momentum_and_flips(self):
        box = Tumbling()
        x, y, z = box.SIZE
        inertia = np.diag([y * y + z * z, x * x + z * z, x * x + y * y])
        times = np.linspace(0, 4, 401)
        r = box.attitudes(times)
        np.testing.assert_allclose(r[-1].T @ r[-1], np.eye(3), atol=1e-9)
        spin = np.einsum("nij,nkj->nik", np.diff(r, axis=0) / 0.01, (r[1:] + r[:-1]) / 2)
        omega = np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], axis=1)
        middle = (r[1:] + r[:-1]) / 2
        momentum = np.einsum("nij,jk,nlk,nl->ni", middle, inertia, middle, omega)
        np.testing.assert_allclose(momentum, np.tile(inertia @ box.SPIN, (400, 1)), atol=2e-3)
        self.assertLess(r[:, 1, 1].min(), -0.5)  # turned over


class TimeSchemes(unittest.TestCase):
    """Against the tables of the library's verification, and each other."""

    def test_rod_and_sphere_exact_in_space(self):
        rod, sphere = Rod(), Sphere()
        for scheme, error in (("bdf1", 0.269), ("theta:0.75", 0.131), ("bdf2", 0.119), ("radau2", 0.015), ("radau3", 0.0053)):
            steps = 100 / 3  # 4 ms
            times = np.arange(67) * rod.PERIOD / steps
            found = time_schemes.response(time_schemes.rod_end(True), scheme, rod.PERIOD / steps, 66)
            off = measures.rms((found - rod.end(times, True) / rod.STATIC)[1:])
            self.assertAlmostEqual(off, error, delta=0.05 * error)
        alone = [time_schemes.error(time_schemes.sphere_surface(sphere), lambda t: sphere.pressed(t) / sphere.static, "radau2",
                                    sphere.breathing_period(), steps) for steps in (18, 36)]
        self.assertAlmostEqual(alone[0], 0.0216, 3)
        self.assertLess(alone[1], 0.65 * alone[0])

    def test_factors_of_vibrations(self):
        for scheme, order in (("bdf1", 1), ("bdf2", 2), ("theta:0.5", 1), ("radau2", 3), ("radau3", 5)):
            off = [abs(time_schemes.ringing(1, scheme, dt) - np.exp(1j * dt)) for dt in (0.1, 0.05)]
            self.assertAlmostEqual(math.log2(off[0] / off[1]), order + 1, delta=0.3, msg=scheme)

    def test_a_rod_leaves_a_wall_with_its_speed_when_steps_are_short(self):
        rebounds = [time_schemes.rebound("radau2", steps) for steps in (20, 40, 80)]
        self.assertEqual(rebounds, sorted(rebounds))
        self.assertAlmostEqual(rebounds[-1], 0.98, 2)


class Measures(unittest.TestCase):
    def test_frequency_and_decay(self):
        z = 0.97 * np.exp(0.5j)
        values = np.real((1 + 0.2j) * z**np.arange(40)) + 0.1
        self.assertAlmostEqual(abs(measures.factor_of_ringing(values) - z), 0, 9)

    def test_angles(self):
        def turn(a):
            return np.array([[math.cos(a), -math.sin(a), 0], [math.sin(a), math.cos(a), 0], [0, 0, 1]])
        a, b = np.stack([turn(0.3), turn(1)]), np.stack([turn(0.3 + 1e-9), turn(-1)])
        np.testing.assert_allclose(measures.angle_between(a, b), [1e-9, 2], rtol=1e-6)

    def test_growth_order_and_front(self):
        n = np.arange(401)
        self.assertAlmostEqual(measures.growth_per_period(1 - 1.01**(n / 40) * np.cos(2 * np.pi * n / 40), 1, 40), 1.01, 2)
        self.assertAlmostEqual(measures.order([1, 2, 4], [3, 12, 48]), 2)
        self.assertEqual(measures.pareto([(3, 0.1), (1, 0.5), (2, 0.6), (4, 0.2)]), [(1, 0.5), (3, 0.1)])

    def test_geodesic_spheres_are_closed_and_have_the_volume_of_the_sphere(self):
        for f in (1, 3):
            vertices, triangles = meshes.geodesic_sphere(f, 0.5)
            self.assertEqual((len(vertices), len(triangles)), (10 * f * f + 2, 20 * f * f))
            edges = {(t[i], t[(i + 1) % 3]) for t in triangles for i in range(3)}
            self.assertEqual({(b, a) for a, b in edges}, edges)
            corners = vertices[triangles]
            volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
            self.assertAlmostEqual(volume, math.pi / 6, 12)


class CalculiX(unittest.TestCase):
    def test_elements_fill_the_box(self):
        for element, count, per in (("C3D20R", 32, 20), ("C3D8I", 12, 8), ("C3D10", 45, 10)):
            nodes, elements = calculix.block((2, 1, 1), (2, 1, 1), element)
            self.assertEqual(len(nodes), count)
            self.assertEqual({len(e) for e in elements}, {per})
            self.assertEqual({n for e in elements for n in e}, set(nodes))
            corners, volume = calculix.corner_count(element), 0
            for e in elements:
                a, b, d, h = (np.array(nodes[e[k]]) for k in ((0, 1, 3, 4) if corners == 8 else (0, 1, 2, 3)))
                volume += np.dot(np.cross(b - a, d - a), h - a) / (1 if corners == 8 else 6)
                self.assertGreater(np.dot(np.cross(b - a, d - a), h - a), 0)
                for k, (i, j) in enumerate(calculix.EDGES[corners], corners):
                    if per in (10, 20):
                        np.testing.assert_allclose(nodes[e[k]], (np.array(nodes[e[i]]) + nodes[e[j]]) / 2)
            self.assertAlmostEqual(volume, 2)
            end = calculix.faces_at(nodes, elements, element, 2)
            self.assertEqual([f for _, f in end if corners == 8], [4] if corners == 8 else [])
            self.assertEqual(len(end), 1 if corners == 8 else 2)

    def test_no_line_has_more_than_sixteen_entries(self):
        content, nodes = calculix.dynamic_input("beam", "C3D20R", (5, 1, 1), 0.01, 0.1)
        self.assertIn("*DYNAMIC, DIRECT, ALPHA=-0.05\n0.01, 0.1\n", content)
        self.assertEqual(nodes, 68)
        self.assertTrue(all(line.count(",") <= 16 and len(line) <= 132 for line in content.splitlines()))

    def test_what_dat_files_say(self):
        text = ("\n displacements (vx,vy,vz) for set END and time  0.5000000E-01\n\n"
                "        57  1.0E-03  0.0E+00 -2.0E-03\n        58  3.0E-03  0.0E+00 -4.0E-03\n\n"
                " displacements (vx,vy,vz) for set END and time  0.1000000E+00\n\n        57 0.0 0.0 -1.0\n")
        found = calculix.displacements(text)
        self.assertEqual([t for t, _ in found], [0.05, 0.1])
        np.testing.assert_allclose(found[0][1], [2e-3, 0, -3e-3])
        text = ("      1   0.1E+04   0.3E+02   0.5E+01   0.0E+00\n\n     P A R T I C I P A T I O N   F A C T O R S\n\n"
                "      1   0.1E+01   0.2E+01   0.3E+01   0.4E+01  -0.5E+01  -0.6E+01\n\n     E F F E C T I V E   M O D A L\n")
        self.assertEqual(calculix.participations(text), [(5.0, [1.0, 2.0, 3.0])])


class Tables(unittest.TestCase):
    def test_keys_name_what_differs_from_the_default(self):
        self.assertEqual(Setting(2, 40).key(), "mesh 2 40 steps radau2")
        self.assertEqual(Setting(2, 40, "bdf1", codec_tol=1e-2, history=8).key(),
                         "mesh 2 40 steps bdf1 codec_tol 0.01 history 8")
        self.assertEqual(Setting(2, 40, discretisation="collocation").key(), "mesh 2 40 steps radau2 collocation")
        for name, problem in PROBLEMS.items():
            settings = problem.plan.settings(SCHEMES)
            self.assertEqual(len({s.key() for s in settings}), len(settings), name)

    def test_the_documents_have_their_places_and_pictures(self):
        document = "".join(path.read_text() for path in (ROOT / "docs/accuracy").glob("*.md"))
        for name in ("headline", "targets", "rod-fixed", "rod-fixed schemes", "sphere", "sphere schemes", "sphere-0 schemes",
                     "sphere-45 schemes", "beam", "beam schemes", "beam-free schemes", "tumble schemes", "slide", "meshes",
                     "energy", "codec", "quadrature", "corners", "history", "window", "phases", "calculix", "impact"):
            self.assertEqual(document.count(f"<!-- study {name} -->"), 1, name)
            self.assertEqual(document.count(f"<!-- end of study {name} -->"), 1, name)
        pictures = list((ROOT / "docs/images/study").glob("*.svg"))
        self.assertGreaterEqual(len(pictures), 6)
        for picture in pictures:
            self.assertLess(picture.stat().st_size, 80e3, picture.name)
            self.assertIn(f"images/study/{picture.name}", document)


class Study(unittest.TestCase):
    def run_script(self, *arguments, programs=os.environ.get("BEM_BIN", "")):
        return subprocess.run([sys.executable, ROOT / "scripts/study.py", *arguments], text=True, capture_output=True,
                              env={**os.environ, "BEM_BIN": programs})

    def test_wrong_usage_and_failures(self):
        for wrong in (["everything"], ["--small", "--update-docs"]):
            self.assertEqual(self.run_script(*wrong).returncode, 2, wrong)
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "bemshape").symlink_to("/bin/false")
            done = self.run_script("rod", "--small", "--out", f"{folder}/out", programs=folder)
            self.assertEqual(done.returncode, 1)
            self.assertIn("bemshape", done.stderr)


if __name__ == "__main__":
    unittest.main()
