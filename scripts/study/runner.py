"""Runs settings with the command line programs and keeps the results, so that a study can stop and go on."""
import json
import sys
import time

import h5py

from common.machine import OtherLoad
from common.programs import DIVERGED, Programs
from common.results import Results, load

from .problems import PROBLEMS, Run


class Runner:
    """`out` receives NAME.json per problem; meshes, archives and trajectories are removed after use."""

    def __init__(self, out, binaries, force=False):
        self.out, self.force = out, force
        self.programs = Programs(binaries, out / "log.txt", place=out)

    def program(self, name, *arguments):
        return self.programs.run(name, *arguments, allowed=(0, DIVERGED))

    def problem(self, name, settings):
        """Runs what is not there yet."""
        results, start = Results(self.out / f"{name}.json"), time.monotonic()
        for i, setting in enumerate(settings):
            missing = [s for s in PROBLEMS[name].scenes if self.force or f"{s}: {setting.key()}" not in results.records]
            if missing:
                print(f"{name} {i + 1}/{len(settings)} ({time.monotonic() - start:.0f} s): {setting.key()}",
                      file=sys.stderr, flush=True)
                for scene, record in self.run(name, setting, missing).items():
                    results.add(f"{scene}: {setting.key()}", record)

    def run(self, name, setting, scenes):
        """Precomputes a setting and simulates scenes with it; {scene: record}."""
        problem, others = PROBLEMS[name], OtherLoad()
        dt = problem.period / setting.steps
        self.programs.mesh("body.obj", problem.shape(setting.mesh))
        (self.out / "material.json").write_text(json.dumps(problem.material))
        time_step = [] if setting.model == "rigid" else ["--dt", repr(dt)]
        done = self.program("bemprecomp", "body.obj", "material.json", "-o", "body.bem", "--force", "-q",
                            "--threads", 1, "--stats", "precompute.json", *time_step, *setting.options())
        record = {"scheme": setting.scheme if setting.model == "dynamic" else setting.model, "mesh": setting.mesh,
                  "steps": setting.steps, "dt": dt, "precompute_cpu": done.cpu,
                  "precompute_memory": done.memory, "error": None}
        if done.code == DIVERGED:
            return {scene: {**record, "failed": "bemprecomp refused"} for scene in scenes}
        record.update(precomputed(load(self.out / "precompute.json")))
        found = {scene: {**record, **self.simulate(problem, setting, scene, dt)} for scene in scenes}
        (self.out / "body.bem").unlink()
        for one in found.values():
            one["cores_of_others"] = others.cores()
        return found

    def simulate(self, problem, setting, name, dt):
        scene, measure = problem.scenes[name]
        steps = round(problem.duration(setting.steps))
        content = {"version": 1, "time_step": dt, "duration": steps * dt,
                   **{k: v for k, v in scene.items() if k != "body"},
                   "bodies": [{"name": "body", "archive": "body.bem", **scene["body"]}]}
        (self.out / "scene.json").write_text(json.dumps(content))
        done = self.program("bemsim", "scene.json", "-o", "run", "--force", "-q", "--threads", 1, "--stats", "simulate.json")
        stats = load(self.out / "simulate.json")
        record = {"simulate_cpu": done.cpu, "simulate_memory": done.memory, "simulated": stats["time"],
                  "loading": stats["loading_seconds"], "matrix_bytes": stats["matrix_bytes"],
                  "simulate_phases": {k: v["total_seconds"] for k, v in stats["phases"].items()}}
        if done.code == DIVERGED:
            return {**record, "failed": f"diverged after {stats['steps']} of {steps} steps"}
        with h5py.File(self.out / "run/trajectory.h5") as file:
            body = file["bodies/body"]
            run = Run(file["time"][:], body["positions"][:], body["faces"][:], body["frame/rotation"][:],
                      body["frame/translation"][:], setting.steps)
        return {**record, **measure(run)}


def precomputed(stats):
    """What the study keeps of the statistics of bemprecomp."""
    found = {"nodes": stats["body"]["nodes"], "archive_bytes": stats["archive_bytes"],
             "precompute_phases": {p["name"]: p["cpu_seconds"] for p in stats["phases"]}}
    if "scheme" in stats:
        found.update(history=stats["scheme"]["history_length"], window=stats["scheme"]["window"],
                     lam=stats["report"]["lam"], growth_factor=stats["report"].get("growth"))
    return found
