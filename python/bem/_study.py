"""How large the errors of mesh and time step are."""
from __future__ import annotations

import json
from typing import Any, Dict, List, NamedTuple, Optional

from . import _bem
from ._scene import Path, Progress, Scene, log, named_text, warn
from ._simulation import checked_options


class Study(NamedTuple):
    """What a convergence study has found."""

    table: List[Dict[str, Any]]  #: a row for every run, the scene's own first
    report: Dict[str, Any]  #: what ``bemsim --convergence`` writes as convergence.json
    text: str  #: the same for people


def row_of(run: Dict[str, Any], number: int, everything: Dict[str, Any]) -> Dict[str, Any]:
    """A run with the differences of its motion from the finest run, and the errors where there is convergence [m]."""
    row = dict(run)
    for quantity in ("position", "deformation"):
        found = everything[quantity]
        row[quantity + "_difference"] = found["from_finest"][number]
        row[quantity + "_error"] = found["error"][number] if found["error"] is not None else None
    return row


def convergence(scene: Scene, *, base: Optional[Path] = None, coarser: int = 2, finer: int = 1, every: Optional[int] = None,
                fps: Optional[float] = None, steps: Optional[int] = None, duration: Optional[float] = None, cache: Optional[Path] = None,
                progress: Optional[Progress] = None) -> Study:
    """Runs a scene on other meshes and with other time steps and compares the motions (docs/choosing.md, "Your own scene").

    coarser: meshes with 1/2, 1/4, ... of the nodes and time steps of twice the length, ...: so many of each.
    finer: meshes with 2, 4, ... times the nodes and half the time step, ...: likewise.
    The other arguments are those of `Simulation`; every body needs "mesh" and "material".

    Rows of the table have "nodes", "time_step" [s], the seconds of processor time "precompute_cpu_seconds" (None if it is not known) and
    "simulation_cpu_seconds", and root mean squares [m] over surfaces and times: "position_difference" from the finest run,
    "position_error" (None without convergence), and the same of the deformation.
    """
    for name, count in (("coarser", coarser), ("finer", finer)):
        if not 0 <= count <= 5:
            raise _bem.UsageError(f"{name} must be from 0 to 5, not {count}")
    if coarser + finer == 0:
        raise _bem.UsageError("coarser=0 and finer=0 leave nothing to compare")
    options = checked_options({"coarser": coarser, "finer": finer, "every": every, "fps": fps, "steps": steps, "duration": duration,
                               "cache": cache})
    file, source = named_text(scene, base)
    text, document = _bem.study(file, source, options, log.info, warn, progress)
    report = json.loads(document)
    table = [row_of(run, number, report["all"]) for number, run in enumerate(report["runs"])]
    return Study(table, report, text)
