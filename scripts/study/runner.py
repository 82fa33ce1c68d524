"""Runs settings with the command line programs and keeps the results, so that a study can stop and go on."""
import json
import os
import pathlib
import subprocess
import sys
import time

import h5py

from paper.workspace import ROOT, OtherLoad

from . import meshes
from .problems import PROBLEMS, Run

DIVERGED = 5  # exit code of both programs for numbers that are no use


class Failed(Exception):
    """A program ended with an error."""


def spent(command, folder, environment=None):
    """Runs a program; returns its exit code, CPU seconds (user and system) and peak memory [bytes]."""
    with open(folder / "log.txt", "ab") as log:
        process = subprocess.Popen([str(c) for c in command], cwd=folder, stdout=log, stderr=log,
                                   env={**os.environ, **(environment or {})})
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_utime + usage.ru_stime, 1024 * usage.ru_maxrss


class Results:
    """{key: record} in one JSON file, written after every run."""

    def __init__(self, path):
        self.path = path
        self.records = json.loads(path.read_text()) if path.exists() else {}

    def add(self, key, record):
        self.records[key] = record
        partial = self.path.with_suffix(".partial")
        partial.write_text(json.dumps(self.records, indent=0) + "\n")
        partial.replace(self.path)


class Runner:
    """`out` receives NAME.json per problem; meshes, archives and trajectories are removed after use."""

    def __init__(self, out, binaries, force=False):
        self.out, self.binaries, self.force = pathlib.Path(out), pathlib.Path(binaries), force
        self.out.mkdir(parents=True, exist_ok=True)
        (self.out / "log.txt").unlink(missing_ok=True)

    def results(self, name):
        return Results(self.out / f"{name}.json")

    def program(self, name, *arguments):
        code, cpu, _ = spent([self.binaries / name, *arguments], self.out)
        if code not in (0, DIVERGED):
            tail = (self.out / "log.txt").read_text(errors="replace").splitlines()[-5:]
            raise Failed("\n".join([f"{name} {' '.join(map(str, arguments))}: exit code {code}", *tail]))
        return code, cpu

    def problem(self, name, settings):
        """Runs what is not there yet; returns the results."""
        results, start = self.results(name), time.monotonic()
        for i, setting in enumerate(settings):
            missing = [s for s in PROBLEMS[name].scenes if self.force or f"{s}: {setting.key()}" not in results.records]
            if missing:
                print(f"{name} {i + 1}/{len(settings)} ({time.monotonic() - start:.0f} s): {setting.key()}",
                      file=sys.stderr, flush=True)
                for scene, record in self.run(name, setting, missing).items():
                    results.add(f"{scene}: {setting.key()}", record)
        return results

    def run(self, name, setting, scenes):
        """Precomputes a setting and simulates scenes with it; {scene: record}."""
        problem, others = PROBLEMS[name], OtherLoad()
        dt = problem.period / setting.steps
        self.mesh(problem, setting.mesh)
        (self.out / "material.json").write_text(json.dumps(problem.material))
        time_step = [] if setting.model == "rigid" else ["--dt", repr(dt)]
        code, cpu = self.program("bemprecomp", "body.obj", "material.json", "-o", "body.bem", "--force", "-q",
                                         "--threads", 1, "--stats", "precompute.json", *time_step, *setting.options())
        record = {"scheme": setting.scheme if setting.model == "dynamic" else setting.model, "mesh": setting.mesh,
                  "steps": setting.steps, "dt": dt, "precompute_cpu": cpu, "error": None}
        if code == DIVERGED:
            return {scene: {**record, "failed": "bemprecomp refused"} for scene in scenes}
        record.update(precomputed(json.loads((self.out / "precompute.json").read_text())))
        found = {scene: {**record, **self.simulate(problem, setting, scene, dt)} for scene in scenes}
        (self.out / "body.bem").unlink()
        for one in found.values():
            one["cores_of_others"] = others.cores()
        return found

    def mesh(self, problem, number):
        shape = problem.shape(number)
        if isinstance(shape[0], str):
            self.program("bemshape", *shape, "-o", "body.obj")
        else:
            meshes.write_obj(self.out / "body.obj", *shape)

    def simulate(self, problem, setting, name, dt):
        scene, measure = problem.scenes[name]
        steps = round(problem.duration(setting.steps))
        content = {"version": 1, "time_step": dt, "duration": steps * dt,
                   **{k: v for k, v in scene.items() if k != "body"},
                   "bodies": [{"name": "body", "archive": "body.bem", **scene["body"]}]}
        (self.out / "scene.json").write_text(json.dumps(content))
        code, cpu = self.program("bemsim", "scene.json", "-o", "run", "--force", "-q", "--threads", 1,
                                         "--stats", "simulate.json")
        stats = json.loads((self.out / "simulate.json").read_text())
        record = {"simulate_cpu": cpu, "simulate_memory": stats["peak_memory_bytes"], "simulated": stats["time"],
                  "loading": stats["loading_seconds"], "matrix_bytes": stats["matrix_bytes"],
                  "simulate_phases": {k: v["total_seconds"] for k, v in stats["phases"].items()}}
        if code == DIVERGED:
            return {**record, "failed": f"diverged after {stats['steps']} of {steps} steps"}
        with h5py.File(self.out / "run/trajectory.h5") as file:
            body = file["bodies/body"]
            run = Run(file["time"][:], body["positions"][:], body["faces"][:], body["frame/rotation"][:],
                      body["frame/translation"][:], setting.steps)
        return {**record, **measure(run)}


def precomputed(stats):
    """What the study keeps of the statistics of bemprecomp."""
    found = {"nodes": stats["body"]["nodes"], "archive_bytes": stats["archive_bytes"],
             "precompute_memory": stats["peak_memory_bytes"],
             "precompute_phases": {p["name"]: p["cpu_seconds"] for p in stats["phases"]}}
    if "scheme" in stats:
        found.update(history=stats["scheme"]["history_length"], window=stats["scheme"]["window"],
                     lam=stats["report"]["lam"], growth_factor=stats["report"].get("growth"))
    return found


def programs():
    """The folder of the programs; builds them unless BEM_BIN names it."""
    if os.environ.get("BEM_BIN"):
        return pathlib.Path(os.environ["BEM_BIN"]).resolve()
    subprocess.run([str(ROOT / "scripts/setup.sh")], check=True)
    subprocess.run(["cmake", "--preset", "release"], cwd=ROOT, check=True)
    subprocess.run(["cmake", "--build", "--preset", "release", "--parallel", str(os.cpu_count()), "--target",
                    "bemprecomp", "bemsim", "bemshape"], cwd=ROOT, check=True)
    return ROOT / "build/release/bin"
