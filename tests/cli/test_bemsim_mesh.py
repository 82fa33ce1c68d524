"""bemsim with bodies that are given by mesh and material: the cache, changed inputs, automatic time steps."""
import json
import os
import re
import shutil
import signal
import subprocess
import time
import unittest

import h5py

from simulation_case import SimulationCase, models, program


class MeshCase(SimulationCase):
    def setUp(self):
        super().setUp()
        shutil.copy(models / "ball.obj", self.folder)
        self.material = {"name": "rubber", "density": 1000, "shear_modulus": 40000, "poisson_ratio": 0.45}
        self.body = {"name": "ball", "mesh": "ball.obj", "material": self.material, "precompute": {"scheme": "bdf1"}}
        self.scene = {"version": 1, "time_step": 0.01, "duration": 0.05, "gravity": [0, -9.81, 0], "bodies": [self.body]}

    def cached(self):
        folder = self.folder / "cache"
        return sorted(path.name for path in folder.glob("*.bem")) if folder.exists() else []

    def written_scene(self):
        self.scene_file.write_text(json.dumps(self.scene, indent=1))
        return self.scene_file

    def run_scene(self, *arguments, expect=0):
        return program("bemsim", self.written_scene(), "-o", self.folder / "out", "--force", "--cache", self.folder / "cache",
                           *arguments, expect=expect)


class Cache(MeshCase):
    def test_an_archive_is_computed_once(self):
        first = self.run_scene()
        self.assertIn("ball.obj: computing the matrices of 42 nodes", first.stderr)
        self.assertEqual(len(self.cached()), 1)
        self.assertNotIn("computing", self.run_scene().stderr)
        self.scene["bodies"].append({**self.body, "name": "second", "position": [1, 0, 0]})
        self.assertNotIn("computing", self.run_scene().stderr)

    def test_changed_inputs_are_computed_again(self):
        changes = [lambda: self.material.update(density=1001),
                   lambda: self.body.update(mesh_scale=1.5),
                   lambda: self.body["precompute"].update(codec_tol=1e-3),
                   lambda: self.scene.update(time_step=0.02),
                   lambda: self.scene.update(contact={})]
        self.run_scene("--steps", 1)
        for count, change in enumerate(changes, 2):
            change()
            self.run_scene("--steps", 1)
            self.assertEqual(len(self.cached()), count)
        mesh = (self.folder / "ball.obj").read_text()
        (self.folder / "ball.obj").write_text("# a comment\n" + mesh)
        self.run_scene("--steps", 1)
        self.assertEqual(len(self.cached()), len(changes) + 1)
        (self.folder / "ball.obj").write_text(mesh.replace("v 0.1 ", "v 0.11 ", 1) + "v 3 3 3\n")
        self.run_scene("--steps", 1)
        self.assertEqual(len(self.cached()), len(changes) + 2)

    def test_the_motion_is_that_of_an_archive_made_by_hand(self):
        self.run_scene()
        (self.folder / "rubber.json").write_text(json.dumps(self.material))
        program("bemprecomp", self.folder / "ball.obj", self.folder / "rubber.json", "-o", self.folder / "a.bem", "--dt", 0.01,
                     "--scheme", "bdf1", "--loads", "none")
        with h5py.File(self.folder / "out/trajectory.h5") as file:
            positions = file["bodies/ball/positions"][:]
        self.scene["bodies"] = [{"name": "ball", "archive": "a.bem"}]
        self.run_scene()
        with h5py.File(self.folder / "out/trajectory.h5") as file:
            self.assertTrue((file["bodies/ball/positions"][:] == positions).all())

    def test_parallel_runs_compute_an_archive_once(self):
        scene = self.written_scene()
        runs = [subprocess.Popen([os.environ["BEMSIM"], scene, "-o", self.folder / f"out{i}", "--cache", self.folder / "cache",
                                  "--threads", "1"], stderr=subprocess.PIPE, text=True) for i in range(6)]
        texts = [run.communicate(timeout=60)[1] for run in runs]
        self.assertEqual([run.returncode for run in runs], [0] * 6)
        self.assertEqual(sum("computing" in text for text in texts), 1)
        self.assertEqual(len(self.cached()), 1)

    def test_a_killed_computation_leaves_nothing_half(self):
        program("bemshape", "icosphere", "--subdivisions", 3, "--radius", "0.1", "-o", self.folder / "ball.obj")
        self.body["precompute"] = {}
        run = subprocess.Popen([os.environ["BEMSIM"], self.written_scene(), "-o", self.folder / "out", "--cache",
                                self.folder / "cache"], stderr=subprocess.PIPE, text=True)
        self.assertIn("computing", run.stderr.readline())
        time.sleep(0.3)
        run.send_signal(signal.SIGKILL)
        run.communicate()
        self.assertEqual(self.cached(), [])

    def test_a_damaged_archive_is_computed_again(self):
        self.run_scene()
        path = self.folder / "cache" / self.cached()[0]
        whole = path.read_bytes()
        path.write_bytes(whole[:-100])
        self.assertRegex(self.run_scene().stderr, "warning: .*computed again")
        self.assertEqual(path.read_bytes(), whole)

    def test_prepare_only_computes(self):
        done = program("bemsim", self.written_scene(), "--prepare", "--cache", self.folder / "cache")
        self.assertIn("computing", done.stderr)
        self.assertEqual(len(self.cached()), 1)
        self.assertFalse((self.folder / "out").exists())

    def test_check_computes_nothing(self):
        self.body["place"] = {"center": [1, 0, 0]}
        self.scene["obstacles"] = [{"name": "floor", "plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}}]
        done = program("bemsim", self.written_scene(), "--check", "--cache", self.folder / "cache")
        self.assertIn("ball.obj: the matrices are not computed yet: 42 nodes", done.stderr)
        self.assertEqual(self.cached(), [])
        self.assertIn("warning: ", done.stderr)
        self.assertIn("obstacles touch nothing in a scene without contact", done.stderr)
        place = re.search('body "ball"\n(  mesh coordinates .*\n  placed at +.0.9.*\n)', done.stdout)
        self.assertTrue(place, done.stdout)
        self.run_scene()
        done = program("bemsim", self.written_scene(), "--check", "--cache", self.folder / "cache")
        self.assertIn("mesh ball.obj (bdf1", done.stdout)
        self.assertIn(place[1], done.stdout)

    def test_check_tells_of_meshes_in_millimetres(self):
        lines = [line.split() for line in (self.folder / "ball.obj").open()]
        (self.folder / "ball.obj").write_text("".join(
            " ".join([w[0], *(str(1000 * float(x)) for x in w[1:])] if w and w[0] == "v" else w) + "\n" for w in lines))
        check = lambda: program("bemsim", self.written_scene(), "--check", "--cache", self.folder / "cache").stderr
        self.scene["time_step"] = 1
        self.assertIn('info: ball.obj: the body is 200 m large; a mesh in millimetres needs "mesh_scale": 0.001\n',
                      check().replace(f"{self.folder}/", ""))
        self.body["mesh_scale"] = 0.001
        self.assertNotIn("millimetres", check())

    def test_info_and_clean(self):
        self.run_scene()
        info = program("bemsim", "--cache-info", "--cache", self.folder / "cache").stdout
        self.assertIn("ball-", info)
        self.assertIn("1 archive, ", info)
        program("bemsim", "--cache-clean", "30d", "--cache", self.folder / "cache")
        self.assertEqual(len(self.cached()), 1)
        mine = self.folder / "cache/ball.bem"  # no name that the cache has given
        mine.write_bytes((self.folder / "cache" / self.cached()[0]).read_bytes())
        self.assertIn("removed 1 archive", program("bemsim", "--cache-clean", "0", "--cache", self.folder / "cache").stdout)
        self.assertTrue(mine.exists())
        for limit in ("much", "10", "infGB", "-1GB"):
            self.assert_error(program("bemsim", f"--cache-clean={limit}", expect=2), "--cache-clean takes a size with its unit")

    def test_the_environment_names_the_cache(self):
        environment = {**os.environ, "BEM_CACHE": str(self.folder / "cache")}
        subprocess.run([os.environ["BEMSIM"], self.written_scene(), "--prepare"], env=environment, check=True,
                       capture_output=True)
        self.assertEqual(len(self.cached()), 1)


class Inputs(MeshCase):
    def test_only_what_the_scene_needs_is_computed(self):
        self.run_scene()
        self.assertEqual(self.loads(), "none")
        shutil.rmtree(self.folder / "cache")
        self.body["fixed"] = [{"box": {"min": [-1, -1, -1], "max": [-0.05, 1, 1]}}]
        self.run_scene()
        self.assertEqual(self.loads(), "some")
        shutil.rmtree(self.folder / "cache")
        self.scene["contact"] = {}
        self.run_scene()
        self.assertEqual(self.loads(), "all")

    def loads(self):
        [name] = self.cached()
        return json.loads(program("bemprecomp", "--info", self.folder / "cache" / name, "--json").stdout)["matrices"]["loads"]

    def test_mistakes_name_their_place(self):
        self.body["precompute"] = {"codec_tol": 5}
        self.assert_error(self.run_scene(expect=3), "/bodies/0/precompute/codec_tol", '"codec_tol" must be from 1e-06 to 0.1')
        self.body["precompute"] = {"codectol": 1e-3}
        self.assert_error(self.run_scene(expect=3), "/bodies/0/precompute/codectol", 'did you mean "codec_tol"?')
        self.body["precompute"] = {"dt": 1e-3}
        self.assert_error(self.run_scene(expect=3), "/bodies/0/precompute", 'the scene has the "time_step"')
        self.body["precompute"] = {}
        self.body["mesh"] = "missing.obj"
        self.assert_error(self.run_scene(expect=3), "/bodies/0/mesh", "missing.obj")
        self.body.update(mesh="ball.obj", material="missing.json")
        self.assert_error(self.run_scene(expect=3), "/bodies/0/material", "missing.json")
        del self.body["material"]
        self.assert_error(self.run_scene(expect=3), "/bodies/0", '"material"')
        del self.body["mesh"]
        self.assert_error(self.run_scene(expect=3), "/bodies/0", "archive, mesh")

    def test_an_archive_is_compared_with_mesh_and_material(self):
        archive = {"name": "ball", "archive": str(models / "ball.bem"), "mesh": "ball.obj", "material": self.material}
        self.scene["bodies"] = [archive]
        self.run_scene()
        archive["mesh_scale"] = 2
        self.assert_error(self.run_scene(expect=4), "/bodies/0/archive", "has another mesh")
        del archive["mesh_scale"]
        self.material["density"] = 900
        self.assert_error(self.run_scene(expect=4), "has another density: 1000 instead of 900")
        archive["precompute"] = {}
        self.assert_error(self.run_scene(expect=3), '"precompute"', "no effect")


class Repair(MeshCase):
    """Meshes that are no closed surface of one solid."""
    CUBE = """mtllib skin.mtl
v 0 0 0\nv .2 0 0\nv .2 .2 0\nv 0 .2 0\nv 0 0 .2\nv .2 0 .2\nv .2 .2 .2\nv 0 .2 .2
vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1
usemtl skin
g sides
f 1/1 2/2 6/3 5/4\nf 2/1 3/2 7/3 6/4\nf 3/1 4/2 8/3 7/4\nf 4/1 1/2 5/3 8/4
g ends
f 4/1 3/2 2/3 1/4\nf 5/1 6/2 7/3 8/4
"""

    def setUp(self):
        super().setUp()
        self.body["mesh"] = "cube.obj"
        self.scene["output"] = {"formats": ["hdf5", "obj"]}
        (self.folder / "skin.mtl").write_text("newmtl skin\n")
        self.write_mesh(self.CUBE)

    def write_mesh(self, text):
        (self.folder / "cube.obj").write_text(text)

    def frame(self):
        return (self.folder / "out/obj/ball_000005.obj").read_text()

    def lines(self, text, *words):
        return [line for line in text.splitlines() if line.split(" ")[0] in words]

    def test_a_mesh_comes_back_with_its_faces_and_texture(self):
        self.run_scene()
        for word in ("f", "vt", "usemtl", "g"):
            self.assertEqual(self.lines(self.frame(), word), self.lines(self.CUBE, word))
        heights = [float(line.split()[2]) for line in self.lines(self.frame(), "v")]
        self.assertAlmostEqual(min(heights), -9.81 * 0.05 ** 2 / 2, 4)
        with h5py.File(self.folder / "out/trajectory.h5") as file:
            self.assertEqual(file["bodies/ball/faces"].shape, (12, 3))

    def test_off_refuses_and_names_the_cure(self):
        self.body["precompute"]["repair"] = "off"
        self.write_mesh(self.CUBE.replace("\nf 5/1 6/2 7/3 8/4", ""))
        self.assert_error(self.run_scene(expect=3), "/bodies/0/mesh", "cube.obj", '"repair": "auto" would mend it')

    def test_holes_are_filled(self):
        self.write_mesh(self.CUBE.replace("\nf 5/1 6/2 7/3 8/4", ""))
        self.body["precompute"]["fill_holes"] = "all"
        self.assertIn("filled 1 hole", self.run_scene().stderr)
        self.assertEqual(len(self.lines(self.frame(), "f")), 5)
        self.assertNotIn("filled", self.run_scene().stderr)

    def test_sheets_are_warned_of(self):
        self.write_mesh("v 0 0 0\nv .2 0 0\nv .2 .2 0\nv 0 .2 0\nf 1 2 3 4\n")
        self.body["mesh_scale"] = 0.5  # which lengths in messages have, too
        self.body["precompute"]["nodes"] = 40
        self.body["mesh_scale"] = 0.5  # in which lengths are told
        self.assertRegex(self.run_scene().stderr,
                         "warning: .*cube.obj: the mesh is a sheet without an inside: .*thickness of 0.00283 m")
        self.assertEqual(self.lines(self.frame(), "f"), ["f 1 2 3 4"])

    def test_a_mistake_has_one_place(self):
        self.body["fixed"] = [{"vertices": [42000]}]
        error = self.run_scene(expect=3).stderr
        self.assertIn("/bodies/0/fixed/0: vertex 42000", error)
        self.assertEqual(error.count("/bodies/0"), 1, error)

    def test_nodes(self):
        self.body["precompute"]["nodes"] = 100
        done = self.run_scene()
        nodes = int(done.stderr.split("computing the matrices of ")[1].split()[0])
        self.assertTrue(90 <= nodes <= 115, nodes)
        self.assertEqual(self.lines(self.frame(), "f"), self.lines(self.CUBE, "f"))
        with h5py.File(self.folder / "out/trajectory.h5") as file:
            self.assertEqual(file["bodies/ball/positions"].shape[1], 8)

    def test_groups_of_the_mesh(self):
        self.body["fixed"] = [{"group": "ends"}]
        self.run_scene()
        self.body["fixed"] = [{"group": "end"}]
        self.assert_error(self.run_scene(expect=3), "/bodies/0/fixed/0", "ends")
        self.body["fixed"] = [{"group": "ends"}]
        self.body["precompute"]["nodes"] = 100
        done = self.run_scene(expect=3)
        self.assertRegex(done.stderr, "error: .*/bodies/0/fixed/0: .* have no numbers")
        self.assertNotIn("computing", done.stderr)

    def test_resume_with_the_own_mesh(self):
        self.run_scene("--checkpoint-every", 2)
        whole = self.frame()
        self.run_scene("--checkpoint-every", 2, "--steps", 2)
        scene = self.written_scene()
        program("bemsim", scene, "-o", self.folder / "out", "--resume", "--checkpoint-every", 2, "--cache", self.folder / "cache")
        self.assertEqual(self.frame(), whole)


class TimeStep(MeshCase):
    def test_automatic(self):
        self.scene["time_step"] = "auto"
        self.assertRegex(self.run_scene().stderr, "the time step is 0.0.* s, in at least eight of which a shear wave crosses the body\n")
        del self.scene["time_step"]
        self.run_scene("--fps", 50)
        with h5py.File(self.folder / "out/trajectory.h5") as file:
            times = file["time"][:]
        for frame, at in enumerate(times):
            self.assertAlmostEqual(at, frame / 50, places=12)

    def test_that_of_an_archive(self):
        self.scene["time_step"] = "auto"
        self.scene["bodies"].append({"name": "made", "archive": str(models / "ball.bem"), "position": [1, 0, 0]})
        self.body["precompute"] = {}
        self.assertIn("the time step is that of", self.run_scene().stderr)


if __name__ == "__main__":
    unittest.main()
