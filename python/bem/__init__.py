"""Elastodynamics of bodies from their surface alone: precompute matrices, run scenes step by step, read trajectories.

>>> import bem
>>> archive = bem.precompute("ball.obj", "rubber", time_step=0.005)
>>> with bem.Simulation("scene.json", output="out") as simulation:
...     simulation.run()

docs/python.md has examples. All quantities are in SI units and world axes.
"""
from ._archive import Archive, materials, precompute, read_mesh, settings
from ._bem import (ArchiveError, Error, InputError, InternalError, NumericalError, ResourceError, UsageError, scene_schema, set_threads,
                   threads, version)
from ._scene import BemWarning
from ._simulation import Body, Contacts, Frame, Simulation
from ._study import Study, convergence
from ._trajectory import RecordedBody, RecordedObstacle, Trajectory

__all__ = [
    "Archive", "ArchiveError", "BemWarning", "Body", "Contacts", "Error", "Frame", "InputError", "InternalError", "NumericalError",
    "RecordedBody", "RecordedObstacle", "ResourceError", "Simulation", "Study", "Trajectory", "UsageError", "convergence", "materials",
    "precompute", "read_mesh", "scene_schema", "set_threads", "settings", "threads", "version",
]
