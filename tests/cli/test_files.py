"""Files of a run do not destroy each other, nor those of other runs."""
import fcntl
import json
import os
import shutil
import subprocess
import unittest

from simulation_case import DT, LIMIT, SimulationCase, models, program

PLATE = "v -1 -5 -1\nv -1 -5 1\nv 1 -5 1\nv 1 -5 -1\nv 0 -6 0\n" + "".join(
    f"f {a} {b} {c}\n" for a, b, c in [(1, 2, 3), (1, 3, 4), (2, 1, 5), (3, 2, 5), (4, 3, 5), (1, 4, 5)])


class Files(SimulationCase):
    def setUp(self):
        super().setUp()
        shutil.copy(models / "ball.bem", self.folder / "copy.bem")
        (self.folder / "plate.obj").write_text(PLATE)
        self.scene["bodies"][0]["archive"] = "copy.bem"
        self.scene["obstacles"] = [{"name": "plate", "mesh": "plate.obj"}]
        self.scene["contact"] = {}
        self.scene_file.write_text(json.dumps(self.scene, indent=1))

    def contents(self):
        return {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}

    def refused(self, *arguments, tool="bemsim", expect=2, parts=()):
        """Nothing is changed and nothing is new."""
        before = self.contents()
        self.assert_error(program(tool, *arguments, expect=expect), *parts)
        self.assertEqual(self.contents(), before)

    def other_names(self, path):
        """The same file by other spellings and links."""
        link, hard = self.folder / "link", self.folder / "hard"
        for name in (link, hard):
            name.unlink(missing_ok=True)
        link.symlink_to(path)
        os.link(path, hard)
        return [path, self.folder / "." / "none" / ".." / path.name, link, hard]

    def test_outputs_of_bemsim_are_no_inputs(self):
        for name in ("scene.json", "copy.bem", "plate.obj"):
            for path in self.other_names(self.folder / name):
                for option in ("--stats", "--log-file"):
                    with self.subTest(path=path, option=option):
                        self.refused(self.scene_file, "-o", self.out, option, path, parts=["is an input"])

    def test_outputs_of_bemsim_are_different(self):
        new, dangling = self.folder / "new", self.folder / "dangling"
        dangling.symlink_to("new")
        for other in (new, dangling, self.folder / "x" / ".." / "new"):
            self.refused(self.scene_file, "-o", self.out, "--stats", new, "--log-file", other, parts=["two outputs"])
        for name in ("trajectory.h5", "checkpoint.bin", "obj/a_000000.obj", "pc2/ball.obj", "vtp/trajectory.pvd", "trajectory.usda", ""):
            for option in ("--stats", "--log-file"):
                self.refused(self.scene_file, "-o", self.out, option, self.out / name, parts=["a run writes"])
        self.simulate("--steps", 1, "--stats", self.out / "stats.json", "--log-file", "/dev/null")

    def test_output_folder_holds_an_input(self):
        """--force would remove it."""
        self.simulate("--steps", 1, "--format", "obj")
        mesh = self.out / "obj" / "ball_000000.obj"
        os.link(mesh, self.folder / "hard.obj")
        (self.folder / "soft.obj").symlink_to(mesh)
        for path in ("out/obj/ball_000000.obj", "hard.obj", "soft.obj"):
            self.scene["obstacles"][0]["mesh"] = path
            self.scene_file.write_text(json.dumps(self.scene))
            self.refused(self.scene_file, "-o", self.out, "--force", parts=["a run writes"])

    def test_a_broken_scene_and_a_log(self):
        """What the scene would name is unknown, so only a log replaces what is there."""
        self.scene_file.write_text("{")
        program("bemsim", self.scene_file, "-o", self.out, "--log-file", self.folder / "copy.bem", expect=3)
        self.assertEqual((self.folder / "copy.bem").read_bytes(), (models / "ball.bem").read_bytes())
        for _ in range(2):
            program("bemsim", self.scene_file, "-o", self.out, "--log-file", self.folder / "log", expect=3)
            self.assertRegex((self.folder / "log").read_text(), r"\Aerror: .*scene\.json")

    def test_outputs_of_bemprecomp(self):
        mesh, material = self.folder / "ball.obj", self.folder / "rubber.json"
        shutil.copy(models / "ball.obj", mesh)
        shutil.copy(models / "rubber.json", material)
        command = [mesh, material, "--model", "rigid"]
        for path in (*self.other_names(mesh), material):
            for option in ("--stats", "--log-file"):
                self.refused(*command, "-o", self.folder / "a.bem", option, path, tool="bemprecomp", parts=["is an input"])
            self.refused(*command, "-o", path, "--force", tool="bemprecomp", parts=["is an input"])
        new = self.folder / "a.bem"
        self.refused(*command, "-o", new, "--stats", new, tool="bemprecomp", parts=["two outputs"])
        self.refused("--verify", self.folder / "copy.bem", "--log-file", self.folder / "copy.bem", tool="bemprecomp")

    def test_one_run_at_a_time(self):
        self.simulate("--steps", 1)
        folder = os.open(self.out, os.O_RDONLY)
        fcntl.flock(folder, fcntl.LOCK_EX)
        for option in ("--force", "--resume"):
            self.refused(self.scene_file, "-o", self.out, option, parts=["another process"])
        os.close(folder)
        self.simulate("--steps", 1, "--force")

    def test_two_runs_with_one_archive(self):
        """The first to be complete wins; the other says so, and --force replaces."""
        out = self.folder / "x.bem"
        command = [os.environ["BEMPRECOMP"], models / "ball.obj", models / "rubber.json", "--dt", str(DT), "-q", "-o", out]
        runs = [subprocess.Popen([*command, *options], stderr=subprocess.PIPE, text=True)
                for options in (["--history", "9"], ["--history", "10"], ["--history", "11"])]
        errors = [run.communicate(timeout=LIMIT)[1] for run in runs]
        codes = [run.returncode for run in runs]
        self.assertEqual(sorted(codes), [0, 2, 2], errors)
        for code, error in zip(codes, errors):
            self.assertRegex(error, r"\A(error: .*x\.bem: exists .*--force.*\n)?\Z")
        program("bemprecomp", "--verify", out)
        info = json.loads(program("bemprecomp", "--info", out, "--json").stdout)
        self.assertIn(f"--history {9 + codes.index(0)} ", json.dumps(info))
        self.assertFalse([path.name for path in self.folder.iterdir() if "partial" in path.name])
        program("bemprecomp", models / "ball.obj", models / "rubber.json", "--model", "rigid", "-o", out, "--force")


class Damage(SimulationCase):
    """What a power cut may do to output that a checkpoint counts on."""

    def place_of_positions(self):
        with self.trajectory() as file:
            return file["bodies/ball/positions"].id.get_chunk_info(1).byte_offset

    def test_changed_output_is_noticed(self):
        formats = ("--format", "hdf5,obj,vtp,pc2")
        self.simulate(*formats, "--checkpoint-every", 2, "--steps", 4)
        for name in ("trajectory.h5", "obj/ball_000002.obj", "vtp/ball_000001.vtp", "vtp/trajectory.pvd",
                     "pc2/ball.pc2", "pc2/ball.obj"):
            path = self.out / name
            good = path.read_bytes()
            place = self.place_of_positions() if name == "trajectory.h5" else len(good) // 2
            zeros = good[:place] + bytes(200) + good[place + 200:]
            for damaged in (b"", good[:len(good) // 2], zeros, None):
                with self.subTest(name=name, size=damaged and len(damaged)):
                    path.unlink()
                    if damaged is not None:
                        path.write_bytes(damaged)
                    before = {p: p.read_bytes() for p in self.out.rglob("*") if p.is_file()}
                    self.assert_error(self.simulate(*formats, "--resume", expect=3), "out/" + name.split("_")[0], "--force")
                    self.assertEqual({p: p.read_bytes() for p in self.out.rglob("*") if p.is_file()}, before)
            path.write_bytes(good)
        self.simulate(*formats, "--resume")

    def test_output_older_than_the_checkpoint(self):
        self.simulate("--checkpoint-every", 2, "--steps", 8)
        checkpoint = (self.out / "checkpoint.bin").read_bytes()
        self.simulate("--force", "--steps", 5)
        (self.out / "checkpoint.bin").write_bytes(checkpoint)
        self.assert_error(self.simulate("--resume", expect=3), "trajectory.h5", "--force")


if __name__ == "__main__":
    unittest.main()
