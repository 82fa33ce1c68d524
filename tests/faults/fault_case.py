"""The programs into which faults are put: how they are run, and what must hold after a run."""
import json
import os
import pathlib
import shutil
import struct
import subprocess
import xml.etree.ElementTree

import h5py
import numpy as np

KINDS_OF_LINES = ("error: ", "warning: ", "info: ", "detail: ")
LIMIT = 60  # seconds that no run here may take


def files_below(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


class Broken(Exception):
    """What must hold does not."""


def require(condition, text):
    if not condition:
        raise Broken(text)


class Case:
    """A command that writes to a folder, which is prepared anew for every run."""

    def __init__(self, root, name, command, before=None):
        self.work = root / name
        self.command = [str(part) for part in command(self.work)]
        self.before = before  # a folder to begin with
        self.prepare()
        self.run(check=True)
        self.reference = files_below(self.work)

    def prepare(self):
        shutil.rmtree(self.work, ignore_errors=True)
        if self.before:
            shutil.copytree(self.before, self.work)
        else:
            self.work.mkdir()

    def run(self, check=False, command=None, **environment):
        done = subprocess.run(command or self.command, env={**os.environ, **environment}, capture_output=True, text=True,
                              timeout=LIMIT)
        if check:
            require(done.returncode == 0, f"exit code {done.returncode}: {done.stderr}")
        return done

    def run_with(self, must_succeed=False, **environment):
        """One run with a fault; throws Broken. Returns the exit code."""
        self.prepare()
        done = self.run(**environment)
        require(done.returncode in ((0,) if must_succeed else (0, 6)), f"exit code {done.returncode}: {done.stderr}")
        lines = [line for line in done.stderr.splitlines() if line]
        require(all(line.startswith(KINDS_OF_LINES) for line in lines), done.stderr)
        errors = sum(line.startswith("error: ") for line in lines)
        require(errors == (done.returncode != 0), f"{errors} error lines: {done.stderr}")
        if done.returncode == 0:
            self.check_same()
        else:
            self.check_failed()
        return done.returncode

    def check_same(self):
        self.compare(self.reference, files_below(self.work))

    @staticmethod
    def compare(expected, found):
        other = [name for name in sorted(set(expected) | set(found)) if expected.get(name) != found.get(name)]
        require(not other, f"other bytes than without the fault: {other[:4]}")

    def check_failed(self):
        """The next run ends as if nothing had happened."""
        self.run(check=True, command=[*self.command, "--force"])
        self.check_same()


class Archive(Case):
    """bemprecomp."""

    def check_failed(self):
        old = files_below(self.before) if self.before else {}
        for name, data in files_below(self.work).items():
            if ".partial-" not in name:
                require(data in (old.get(name), self.reference[name]), f"{name} is torn")
        require(all((self.work / name).exists() for name in old), "the old archive is lost")
        super().check_failed()


class Simulation(Case):
    """bemsim in all formats, with checkpoints."""
    results = ()  # of the reference without its checkpoint

    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        self.out = self.work / "out"
        with h5py.File(self.out / "trajectory.h5") as file:
            self.times = file["time"][:]
            self.positions = file["bodies/high/positions"][:]
        self.results = self.without_checkpoint()

    def without_checkpoint(self):
        return {name: data for name, data in files_below(self.work).items() if not name.endswith("checkpoint.bin")}

    def check_same(self):  # a checkpoint has times of the clock
        self.compare(self.results or self.without_checkpoint(), self.without_checkpoint())

    def check_failed(self):
        for name, data in files_below(self.work).items():
            if name.endswith((".obj", ".vtp")):
                require(data == self.reference.get(name), f"{name} is torn")
        self.check_trajectory()
        self.check_point_cache()
        self.check_list()
        option = "--resume" if (self.out / "checkpoint.bin").exists() else "--force"
        command = [part for part in self.command if part not in ("--force", "--resume")]
        self.run(check=True, command=[*command, option])
        self.check_same()

    def check_trajectory(self):
        path = self.out / "trajectory.h5"
        if not path.exists():
            return
        for swmr in (False, True):  # a disk that fails for good leaves one that still grows
            try:
                with h5py.File(path, "r", swmr=swmr) as file:
                    frames = len(file["time"])
                    require(np.array_equal(file["time"][:], self.times[:frames]) and np.array_equal(
                        file["bodies/high/positions"][:frames], self.positions[:frames]), "other frames in the trajectory")
                return
            except OSError as error:
                require(not swmr, f"unreadable trajectory: {error}")

    def check_point_cache(self):
        path = self.out / "pc2" / "high.pc2"
        if path.exists():
            data = path.read_bytes()
            vertices, samples = struct.unpack_from("<i", data, 16)[0], struct.unpack_from("<i", data, 28)[0]
            used = slice(32, 32 + 12 * vertices * samples)
            require(data[used] == self.reference["out/pc2/high.pc2"][used], "other samples in the point cache")

    def check_list(self):
        path = self.out / "vtp" / "trajectory.pvd"
        if path.exists():
            for entry in xml.etree.ElementTree.parse(path).getroot().iter("DataSet"):
                require((path.parent / entry.get("file")).exists(), "the list names a file that is not there")


def make_cases(root):
    """bemprecomp and bemsim on something small: new, over an old result, and going on."""
    inputs = root / "inputs"
    inputs.mkdir()
    (inputs / "rubber.json").write_text(json.dumps(
        {"name": "rubber", "density": 1000, "poisson_ratio": 0.3, "shear_modulus": 40000}))
    subprocess.run([os.environ["BEMSHAPE"], "icosphere", "--subdivisions", "0", "--radius", "0.1", "-o",
                    inputs / "ball.obj"], check=True)
    precompute = [os.environ["BEMPRECOMP"], inputs / "ball.obj", inputs / "rubber.json", "-q", "--threads", "1",
                  "--dt", "0.02", "--scheme", "bdf1"]
    subprocess.run([*precompute, "-o", inputs / "ball.bem"], check=True)
    ball = {"archive": str(inputs / "ball.bem"), "friction": 0.5}
    (inputs / "scene.json").write_text(json.dumps({
        "version": 1, "time_step": 0.02, "duration": 0.12, "gravity": [0, 0, -9.81], "contact": {"enabled": True},
        "bodies": [{"name": "low", "position": [0, 0, 0.1], **ball},
                   {"name": "high", "position": [0.02, 0.01, 0.31], "velocity": [0, 0, -1], **ball}],
        "obstacles": [{"name": "floor", "plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}],
        "output": {"formats": ["hdf5", "obj", "vtp", "pc2"], "fields": ["positions", "tractions"]}}))
    simulate = [os.environ["BEMSIM"], inputs / "scene.json", "-q", "--threads", "1", "--checkpoint-every", "2", "-o"]
    old = root / "old"
    old.mkdir()
    subprocess.run([*precompute, "--codec", "none", "-o", old / "a.bem"], check=True)
    subprocess.run([*simulate, old / "out", "--steps", "3"], check=True)
    half = root / "half"
    half.mkdir()
    subprocess.run([*simulate, half / "out", "--steps", "4"], check=True)
    archives = root / "archives"
    archives.mkdir()
    shutil.copy(old / "a.bem", archives)
    return [Archive(root, "new", lambda work: [*precompute, "-o", work / "a.bem"]),
            Archive(root, "over", lambda work: [*precompute, "-o", work / "a.bem", "--force"], before=archives),
            Simulation(root, "run", lambda work: [*simulate, work / "out"]),
            Simulation(root, "rerun", lambda work: [*simulate, work / "out", "--force"], before=old),
            Simulation(root, "resumed", lambda work: [*simulate, work / "out", "--resume"], before=half)]
