"""Archives from Python, against those of bemprecomp."""
import ast
import json
import os
import pathlib
import signal
import subprocess
import threading
import time

import numpy as np
import pytest

import bem
from bem import _bem
from conftest import BOX, FACES, RUBBER, STEP, run


def test_a_file_gives_the_bytes_of_bemprecomp():
    run("BEMPRECOMP", "box.obj", "rubber.json", "-o", "a.bem", "--dt", STEP, "--scheme", "bdf1", "--codec-tol", 1e-3)
    bem.precompute("box.obj", "rubber.json", "b.bem", time_step=STEP, scheme="bdf1", codec_tol=1e-3)
    assert pathlib.Path("a.bem").read_bytes() == pathlib.Path("b.bem").read_bytes()


def test_arrays_give_the_matrices_of_a_file(archive):
    run("BEMPRECOMP", "box.obj", "rubber.json", "-o", "a.bem", "--dt", STEP, "--scheme", "bdf1")
    done = subprocess.run([os.environ["BEMPRECOMP"], "--diff", "a.bem", archive.path], capture_output=True, text=True)
    assert "matri" not in done.stdout or done.returncode == 0, done.stdout
    assert np.array_equal(archive.vertices, BOX) and np.array_equal(archive.faces, FACES)


def test_info_is_that_of_bemprecomp(archive):
    done = subprocess.run([os.environ["BEMPRECOMP"], "--info", archive.path, "--json"], capture_output=True, text=True, check=True)
    assert archive.info == json.loads(done.stdout)
    assert archive.info["material"]["shear_modulus"] == 1e5


def test_what_was_made_of_the_same_is_kept():
    bem.precompute((BOX, FACES), RUBBER, "a.bem", model="rigid")
    made = os.stat("a.bem").st_mtime_ns
    bem.precompute((BOX, FACES), RUBBER, "a.bem", model="rigid")
    assert os.stat("a.bem").st_mtime_ns == made
    with pytest.raises(bem.UsageError, match="another mesh.*force"):
        bem.precompute((2 * BOX, FACES), RUBBER, "a.bem", model="rigid")
    changed = bem.precompute((2 * BOX, FACES), RUBBER, "a.bem", model="rigid", force=True)
    assert np.array_equal(changed.vertices, 2 * BOX)


def test_an_archive_without_a_file_goes_with_its_object():
    archive = bem.precompute((BOX, FACES), RUBBER, model="rigid")
    path = archive.path
    kept = archive.save("kept.bem")
    with pytest.raises(bem.UsageError, match="exists already"):
        archive.save("kept.bem")
    del archive
    assert not os.path.exists(path)
    assert kept.info["model"] == "rigid"
    assert sorted(os.listdir()) == ["box.obj", "kept.bem", "rubber.json"]


def test_a_damaged_archive_is_refused(archive):
    archive.verify()
    data = bytearray(pathlib.Path(archive.path).read_bytes())
    data[len(data) // 2] ^= 1
    pathlib.Path("damaged.bem").write_bytes(data)
    with pytest.raises(bem.ArchiveError, match="damaged.bem") as caught:
        bem.Archive("damaged.bem")
    assert caught.value.code == 4 and isinstance(caught.value, bem.Error)
    with pytest.raises(bem.ArchiveError, match="none.bem"):
        bem.Archive("none.bem")


@pytest.mark.parametrize("arguments, message", [
    (dict(codec_toll=1e-3), 'is "codec_tol" meant'),
    (dict(scheme="radau9"), '"radau9"'),
    (dict(history=1.5), '"history"'),
    (dict(codec="none", codec_tol=1e-3), '"codec_tol"'),
    (dict(mesh_scale=-1), "mesh_scale"),
])
def test_settings_that_cannot_be_used(arguments, message):
    with pytest.raises(bem.UsageError, match=message) as caught:
        bem.precompute("box.obj", RUBBER, time_step=STEP, **arguments)
    assert isinstance(caught.value, ValueError) and caught.value.code == 2


@pytest.mark.parametrize("vertices, faces, kind, message", [
    (BOX, FACES[1:], bem.InputError, "arrays"),
    (BOX, FACES + 5, bem.InputError, "arrays"),
    (BOX * np.nan, FACES, bem.InputError, "arrays"),
    (BOX[:, :2], FACES, bem.UsageError, "vertices must be an array of three columns"),
    (BOX, FACES.astype(float), bem.UsageError, "faces must be integers"),
    (BOX, FACES + 2**40, bem.UsageError, "faces"),
])
def test_meshes_that_cannot_be_used(vertices, faces, kind, message):
    with pytest.raises(kind, match=message):
        bem.precompute((vertices, faces), RUBBER, model="rigid")


def test_materials():
    assert "rubber" in bem.materials()
    assert bem.precompute((BOX, FACES), "steel", model="rigid").info["material"]["name"] == "steel"
    with pytest.raises(bem.InputError, match="poisson_ratio"):
        bem.precompute((BOX, FACES), {"density": 1000, "shear_modulus": 1e5}, model="rigid")


def test_a_mesh_that_is_inside_out_is_warned_of():
    with pytest.warns(bem.BemWarning, match="arrays"):
        bem.precompute((BOX, FACES[:, ::-1]), RUBBER, model="rigid")


def test_a_mesh_file_is_read_as_it_is():
    vertices, faces = bem.read_mesh("box.obj")
    assert np.array_equal(vertices, BOX) and np.array_equal(faces, FACES)


def test_the_types_of_the_compiled_part_are_those_that_it_has():
    tree = ast.parse(pathlib.Path(bem.__file__).with_name("_bem.pyi").read_text())

    def functions(body):
        return {node.name for node in body if isinstance(node, ast.FunctionDef) and node.name != "__init__"}

    def names(thing):
        return {name for name in vars(thing) if not name.startswith("_")}

    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    assert functions(tree.body) | set(classes) == names(_bem)
    for name in ("Archive", "Session"):
        assert functions(classes[name].body) == names(getattr(_bem, name))


def fine_ball():
    """Takes seconds to precompute."""
    run("BEMSHAPE", "icosphere", "--subdivisions", 3, "--radius", 0.1, "-o", "ball.obj")
    return "ball.obj"


def test_progress_may_end_the_work():
    seen = []

    def progress(work, part):
        seen.append((work, part))
        if len(seen) == 5:
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        bem.precompute("box.obj", RUBBER, "a.bem", time_step=STEP, progress=progress)
    assert all(isinstance(work, str) and 0 <= part <= 1 for work, part in seen)
    assert not os.path.exists("a.bem")


def test_other_threads_go_on_and_ctrl_c_ends_it():
    counted = [0]
    stop = threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0.001)

    ball = fine_ball()
    counter = threading.Thread(target=count)
    counter.start()
    timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    start = time.monotonic()
    try:
        with pytest.raises(KeyboardInterrupt):
            bem.precompute(ball, RUBBER, "a.bem", time_step=STEP)
    finally:
        stop.set()
        counter.join()
    assert time.monotonic() - start < 20  # of more than a minute
    assert counted[0] > 50
    assert not [name for name in os.listdir() if name.startswith("a.bem")]
