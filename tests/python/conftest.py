"""What the tests of the Python module share: the programs, and small bodies."""
import json
import os
import subprocess

import numpy as np
import pytest

import bem

RUBBER = {"name": "rubber", "density": 1000, "poisson_ratio": 0.3, "shear_modulus": 1e5}
STEP = 0.005
BOX = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * 0.05
FACES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                  [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])


def obj_text(vertices, faces):
    return "".join("v {} {} {}\n".format(*v) for v in vertices) + "".join("f {} {} {}\n".format(*f) for f in faces + 1)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """Every test runs in a folder of its own that holds box.obj and rubber.json."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "box.obj").write_text(obj_text(BOX, FACES))
    (tmp_path / "rubber.json").write_text(json.dumps(RUBBER))
    return tmp_path


@pytest.fixture(scope="session")
def archive():
    """Of the box, for the time step STEP."""
    return bem.precompute((BOX, FACES), RUBBER, time_step=STEP, scheme="bdf1")


@pytest.fixture(scope="session")
def rigid():
    return bem.precompute((BOX, FACES), RUBBER, model="rigid")


def run(tool, *arguments):
    """Runs one of the programs."""
    subprocess.run([os.environ[tool], *map(str, arguments)], check=True, capture_output=True, timeout=100)
