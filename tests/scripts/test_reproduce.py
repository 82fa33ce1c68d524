"""scripts/paper: what it measures, the scenes that it makes, and its tables."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np
from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from common.machine import OtherLoad  # noqa: E402
from common.markdown import with_sections  # noqa: E402
from common.programs import Failed  # noqa: E402
from paper import figures, fish, measures, tables  # noqa: E402
from paper.catalogue import BODIES, FIGURES, PAPER, SCENES  # noqa: E402
from paper.workspace import Workspace  # noqa: E402
from refine_mesh import refined  # noqa: E402

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
CUBE_FACES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                       [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def motion(self, positions, times=None, faces=CUBE_FACES, name="body"):
        with h5py.File(self.folder / "run.h5", "w") as file:
            file["time"] = np.arange(len(positions)) * 0.1 if times is None else times
            file[f"bodies/{name}/positions"], file[f"bodies/{name}/faces"] = positions, faces
        return measures.Motion(self.folder / "run.h5")


class Measures(Folder):
    def test_volume_changes(self):
        motion = self.motion(np.stack([CUBE + 3, CUBE * [1, 1, 1.25] - 1]))
        np.testing.assert_allclose(measures.volume_changes(motion), [0, 0.25], atol=1e-12)

    def test_the_cross_sections_of_a_squeezed_bar(self):
        vertices, faces = (np.array(x) for x in refined(CUBE, CUBE_FACES, 14))
        vertices -= 0.5
        squeezed = vertices * [1, 0.5, 1]
        motion = self.motion(np.stack([vertices, squeezed, vertices]), faces=faces)
        narrowest, widest = measures.section_range(motion)
        self.assertAlmostEqual(narrowest, 0.5, 12)
        self.assertAlmostEqual(widest, 1, 12)

    def test_secondary_motion_of_a_swing_and_of_rest(self):
        times = np.arange(0, 2, 0.001)
        swing = 0.02 + np.where(times > 0.5, 0.003 * np.sin(2 * np.pi * (times - 0.5) / 0.2), 0)
        found = measures.secondary_motion(times, swing, 0.5)
        self.assertAlmostEqual(found["amplitude"], 0.003, 6)
        self.assertAlmostEqual(found["period"], 0.2, 2)
        self.assertEqual(measures.secondary_motion(times, 0 * times, 0.5), {"amplitude": 0.0, "period": None})

    def test_differences_are_shares_of_the_motion(self):
        exact = self.motion(np.stack([CUBE, CUBE + [2, 0, 0]]))
        other = self.motion(np.stack([CUBE, CUBE + [2, 0, 0.1]]))
        found = measures.differences(other, exact)
        self.assertAlmostEqual(found["rms"], 0.05, 12)
        self.assertAlmostEqual(found["largest"], 0.1 / np.sqrt(2), 12)


class Catalogue(Folder):
    def test_all_rows_of_table_1_have_a_scene_with_the_papers_parameters(self):
        self.assertEqual(len(PAPER), 13)
        self.assertEqual(PAPER.keys() - {scene.row for scene in SCENES.values()}, set())
        for name, scene in SCENES.items():
            made = json.loads(Workspace(self.folder, ".").scene_file(name).read_text())
            self.assertEqual(made["time_step"], BODIES[scene.body].dt)
            self.assertEqual({b["archive"] for b in made["bodies"]}, {f"{scene.body}.bem"})
            if scene.row in PAPER:
                self.assertEqual(PAPER[scene.row].history, BODIES[scene.body].history)

    def test_scenes_differ_as_their_changes_say(self):
        def bodies(name, small=False):
            made = json.loads(Workspace(self.folder, ".", small).scene_file(name).read_text())
            return made["bodies"]

        self.assertEqual([bodies(f"fig8-bunny-{f}")[0]["friction"] for f in (0.2, 0.4, 0.6)], [0.2, 0.4, 0.6])
        self.assertEqual([bodies(f"fig5-beam-{f}")[0]["frame"] for f in ("moving", "static")], ["moving", "static"])
        self.assertEqual((len(bodies("fig1-fish")), len(bodies("fig1-fish", True))), (25, 5))


class Fish(Folder):
    def test_paint_is_projected_from_the_side(self):
        mesh, painted, image = (self.folder / name for name in ("fish.obj", "painted.obj", "fish.png"))
        mesh.write_text("v 0 0 0\nv 2 1 0\nv 2 -1 0.5\nv 0 3 1\nf 1 2 3\nf 1 4 2\n")
        fish.paint(mesh, painted, image)
        lines = painted.read_text().splitlines()
        self.assertEqual([line for line in lines if line.startswith("vt")],
                         [f"vt {u:.6f} {v:.6f}" for u, v in ((0.001, 0.001), (0.999, 0.001), (0.999, 0.5), (0.001, 0.999))])
        self.assertEqual(lines[-1], "f 1/1 4/4 2/2")
        with Image.open(image) as picture:
            self.assertEqual(picture.size, (fish.WIDTH, fish.WIDTH // 2))
            opacity = np.asarray(picture)[..., 3]
        self.assertEqual(opacity[fish.WIDTH // 4, fish.WIDTH // 2], 0)  # the flank has the colour of the body
        self.assertGreater(opacity[-2, fish.WIDTH // 2], 200)  # the belly has not


class Runs(Folder):
    """With a program that only notes that it was called."""

    def setUp(self):
        super().setUp()
        for name in ("bemshape", "bemprecomp", "bemrecode"):
            script = self.folder / name
            script.write_text(f"""#!/bin/sh
echo "{name} $*" >>"{self.folder}/calls"
while [ $# -gt 0 ]; do [ "$1" != -o ] || printf 'v 0 0 0\\n' >"$2"; shift; done
""")
            script.chmod(0o755)
        self.workspace = Workspace(self.folder / "out", self.folder, small=True)

    def calls(self):
        path = self.folder / "calls"
        lines = path.read_text().splitlines() if path.exists() else []
        path.unlink(missing_ok=True)
        return [line for line in lines if "--info" not in line and "bemshape" not in line]

    def test_archives_are_made_once_for_the_same_inputs(self):
        self.workspace.archive("bumpy-cube-haar-8")
        first = self.calls()
        self.assertEqual([line.split()[0] for line in first], ["bemprecomp", "bemrecode"])
        self.assertIn("--codec haar --compression-ratio 8", first[1])
        self.assertIn("--discretisation collocation", first[0])
        self.workspace.archive("bumpy-cube-haar-8")
        self.assertEqual(self.calls(), [])
        self.workspace.scheme = "radau2"  # another archive, which is compressed at once
        self.workspace.archive("bumpy-cube-haar-8")
        calls = self.calls()
        self.assertEqual([line.split()[0] for line in calls], ["bemprecomp"])
        self.assertIn("--codec haar --compression-ratio 8", calls[0])
        self.workspace.discretisation = "galerkin"  # another one
        self.workspace.archive("bumpy-cube-haar-8")
        self.assertIn("--discretisation galerkin", self.calls()[0])

    def test_a_program_that_fails_ends_the_run(self):
        (self.folder / "bemprecomp").write_text("#!/bin/sh\nexit 6\n")
        with self.assertRaises(Failed) as caught:
            self.workspace.archive("fish")
        self.assertEqual(caught.exception.code, 6)


    def test_what_others_use_of_the_machine_leaves_out_our_own_programs(self):
        others = OtherLoad()
        self.workspace.run("/bin/sh", "-c", "i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done")
        ours = others._now()[2] - others.start[2]
        self.assertGreater(ours, 0.05)
        self.assertLess(others.cores(), (os.cpu_count() or 1) - 0.5 * ours / (others._now()[0] - others.start[0]))


class Tables(Folder):
    def workspace(self, load):
        workspace = Workspace(self.folder, ".")
        for name, scene in SCENES.items():
            phases = {p: {"mean_seconds": 0.0125} for p in tables.PHASES}  # of which the processor worked for 0.01
            workspace.save(f"{name}.stats", {"phases": phases, "threads": 1, "outcome": "complete", "steps": 9,
                                             "wall_seconds": 10.0, "cpu_seconds": 8.0,
                                             "cores_of_others": load, "time_step": 0.01,
                                             "bodies": [{"vertices": 7}]})
            workspace.save(f"{scene.body}.info", {"bytes": 2e9, "scheme": {"history_length": 4}})
        return workspace

    def test_table_1_puts_ours_beside_the_papers(self):
        text = tables.table1(self.workspace(0.05))
        self.assertNotIn("Other programs", text)
        row = next(line for line in text.splitlines() if line.startswith("| torus |"))
        self.assertIn("| 7 | 0.01 | 4 / 32 | 2 / 6.3 | 0.01 / 0.237 | 0.01 / – |", row)
        self.assertTrue(row.endswith("| 0.04 / 0.261 | 7 |"), row)
        self.assertEqual(text.count("\n| "), 2 + len(SCENES))

    def test_the_defaults_stand_beside_the_papers_choices(self):
        workspace, defaults = self.workspace(0.0), Workspace(self.folder / "defaults", ".")
        for part in ("stats", "info"):
            name = "fig4-torus.stats" if part == "stats" else "torus.info"
            defaults.save(name, workspace.load(name))
        lines = tables.table1(workspace, defaults).splitlines()
        self.assertTrue(next(line for line in lines if line.startswith("| torus |")).endswith("| 7 | 2 | 0.04 |"))
        self.assertTrue(next(line for line in lines if line.startswith("| fish |")).endswith("| – | – |"))

    def test_a_run_that_ended_early_says_so(self):
        workspace = self.workspace(0.0)
        workspace.save("fig4-torus.stats", {**workspace.load("fig4-torus.stats"), "outcome": "failed"})
        self.assertIn("| torus (failed after 9 steps) |", tables.table1(workspace))

    def test_a_busy_machine_makes_times_preliminary(self):
        self.assertIn("Other programs", tables.table1(self.workspace(1.4)))

    def test_the_document_has_room_for_every_part(self):
        document = (ROOT / "docs/paper.md").read_text()
        found = {name: f"text of {name}" for name in ["table1", *FIGURES]}
        once = with_sections(document, found)
        self.assertEqual(with_sections(once, found), once)
        for name in found:
            self.assertIn(f"<!-- {name} -->\ntext of {name}\n<!-- end of {name} -->", once)
        with self.assertRaises(ValueError):
            with_sections("nothing", found)

    def test_every_figure_has_a_table_and_a_picture(self):
        for figure in FIGURES:
            for module, kind in ((tables, "table"), (figures, "numbers"), (figures, "draw")):
                self.assertTrue(hasattr(module, f"{kind}_{figure}"))


class CommandLine(unittest.TestCase):
    def run_script(self, *arguments):
        return subprocess.run([str(ROOT / "scripts/reproduce.sh"), *arguments], text=True, capture_output=True,
                              env={"BEM_BIN": "/nowhere", "PATH": "/usr/bin:/bin"})

    def test_help_and_wrong_usage(self):
        done = self.run_script("--help")
        self.assertEqual(done.returncode, 0)
        for name in SCENES:
            self.assertIn(name, done.stdout)
        for wrong in (["fig7"], ["--threads", "0"], ["--small", "--update-docs"],
                      ["--discretisation", "galerkin", "--update-docs"], ["--discretisation", "finite-elements"]):
            self.assertEqual(self.run_script(*wrong).returncode, 2, wrong)

    def test_without_the_programs_it_says_so(self):
        done = self.run_script("fig5", "--small")
        self.assertEqual(done.returncode, 1)
        self.assertIn("/nowhere/bemshape", done.stderr)


if __name__ == "__main__":
    unittest.main()
