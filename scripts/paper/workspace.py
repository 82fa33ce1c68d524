"""Meshes, archives, scene files and runs of the catalogue in one folder."""
import hashlib
import json
import pathlib
import sys

from common import results
from common.machine import OtherLoad
from common.programs import DIVERGED, ROOT, Programs

from .catalogue import BODIES, OBSTACLES, SCENES

SOURCES = ROOT / "scenes/paper"


class Workspace:
    """`folder` receives everything; `binaries` holds the programs of the project. Scheme and discretisation are
    the paper's unless others are given."""

    def __init__(self, folder, binaries, small=False, threads=1, scheme="bdf1", discretisation="collocation"):
        self.folder, self.binaries = pathlib.Path(folder), binaries
        self.small, self.threads, self.scheme, self.discretisation = small, threads, scheme, discretisation
        self.folder.mkdir(parents=True, exist_ok=True)
        self.run = Programs(binaries, self.folder / "log.txt", echo=True).run

    def load(self, name):
        """What is in NAME.json of the folder, or None."""
        return results.load(self.folder / f"{name}.json")

    def save(self, name, value):
        results.save(self.folder / f"{name}.json", value)

    def mesh(self, name):
        """The path of the body's mesh."""
        body = BODIES[name]
        path = self.folder / f"{name}.obj"
        shape, vertices = (body.small_shape, body.small_vertices) if self.small else (body.shape, body.vertices)
        if shape == ("bunny",):
            self.run(ROOT / "scripts/fetch_meshes.sh", self.folder / "fetched")
            raw = self.folder / "fetched/bunny.obj"
        else:
            raw = path if vertices is None else self.folder / f"{name}-raw.obj"
            self.run("bemshape", *shape, "-o", raw)
        if vertices is not None:
            self.run(ROOT / "scripts/refine_mesh.py", raw, path, vertices)
        return path

    def archive(self, name):
        """Makes the body's archive unless there is one from the same inputs."""
        body = BODIES[name]
        path, note = self.folder / f"{name}.bem", self.folder / f"{name}.made"
        if body.recode and self.scheme == "bdf1":  # others need more memory for what is not compressed
            source, *options = body.recode
            self.archive(source)
            inputs = [(self.folder / f"{source}.made").read_text(), *options]
            command = ["bemrecode", self.folder / f"{source}.bem", "-o", path, "--force", *options]
        else:
            mesh, material = self.mesh(name), SOURCES / f"material-{body.material}.json"
            options = ["--scheme", self._scheme(body), "--discretisation", self.discretisation, "--dt", body.dt,
                       *self._scale(body), *body.options, *body.recode[1:]]
            inputs = [mesh.read_text(), material.read_text(), *options]
            command = ["bemprecomp", mesh, material, "-o", path, "--force", "--stats",
                       self.folder / f"{name}.precompute.json", *options]
        made = hashlib.sha256("\n".join(map(str, inputs)).encode()).hexdigest()
        if not (path.exists() and note.exists() and note.read_text() == made):
            note.unlink(missing_ok=True)
            self.run(*command)
            note.write_text(made)
        self.run("bemprecomp", "--info", path, "--json", output=self.folder / f"{name}.info.json")

    def _scheme(self, body):
        """Static models know schemes of one stage alone."""
        one_stage = not self.scheme.startswith("radau")
        return self.scheme if one_stage or "static" not in body.options else "bdf1"

    def _scale(self, body):
        return [] if self.small or body.scale == 1 else ["--mesh-scale", body.scale]

    def scene_file(self, name):
        """Writes the scene of a run, its paths relative to the folder; returns its path."""
        scene = SCENES[name]
        content = json.loads((SOURCES / f"{scene.file}.json").read_text())
        changes = {**scene.changes, **(scene.small_changes if self.small else {})}
        results.changed(content, changes)
        for thing in [*content["bodies"], *content.get("obstacles", [])]:
            for key in thing.keys() & {"archive", "mesh"}:
                thing[key] = pathlib.PurePath(thing[key]).name
        path = self.folder / f"{name}.scene.json"
        path.write_text(json.dumps(content, indent=1) + "\n")
        return path

    def trajectory(self, name):
        return self.folder / name / "trajectory.h5"

    def prepare(self, name):
        scene = SCENES[name]
        for obstacle in scene.obstacles:
            self.run("bemshape", *OBSTACLES[obstacle][self.small], "-o", self.folder / f"{obstacle}.obj")
        self.archive(scene.body)

    def simulate(self, name, steps=None):
        """Runs a scene whose archive is there; its statistics with what others use of the machine."""
        scene, file = SCENES[name], self.scene_file(name)
        count = steps or (scene.small_steps if self.small else None)
        others = OtherLoad()
        done = self.run("bemsim", file, "-o", self.folder / name, "--force", "--threads", self.threads, "--stats",
                        self.folder / f"{name}.stats.json", *(["--steps", count] if count else []), allowed=(0, DIVERGED))
        if done.code == DIVERGED:
            print(f"warning: {name} ended early", file=sys.stderr)
        stats = self.load(f"{name}.stats")
        stats["cores_of_others"] = others.cores()
        self.save(f"{name}.stats", stats)
        if scene.touches:
            self.run("bemmeasure", file, self.trajectory(name), output=self.folder / f"{name}.measure.json")
