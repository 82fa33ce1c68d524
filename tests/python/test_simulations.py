"""Simulations from Python, against bemsim."""
import json
import os
import pathlib
import signal
import threading

import numpy as np
import pytest

import bem
from conftest import BOX, FACES, RUBBER, STEP, obj_text, run

TOP = {"box": {"min": [-1, -1, 0.04], "max": [1, 1, 1]}}
BOTTOM = {"box": {"min": [-1, -1, -1], "max": [1, 1, -0.04]}}
PLATE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])


@pytest.fixture
def scene(archive):
    """The box held at its bottom and pulled at its top."""
    return {"version": 1, "time_step": STEP, "duration": 0.05,
            "bodies": [{"name": "box", "archive": archive, "fixed": [BOTTOM],
                        "tractions": [{"select": TOP, "traction": [300, 0, 0]}]}]}


@pytest.fixture
def contact(archive, rigid):
    """The box and a rigid one above it fall onto a plate and a plane."""
    pathlib.Path("plate.obj").write_text(obj_text(PLATE, np.array([[0, 1, 2], [0, 2, 3]])))
    return {"version": 1, "time_step": STEP, "duration": 0.1, "gravity": [0, 0, -9.81], "contact": {},
            "bodies": [{"name": "soft", "archive": archive, "position": [0, 0, 0.051], "friction": 0.3},
                       {"name": "hard", "archive": rigid, "position": [0.01, 0, 0.152], "velocity": [0, 0, -0.2]}],
            "obstacles": [{"name": "plate", "mesh": "plate.obj"},
                          {"name": "floor", "plane": {"point": [0, 0, -1], "normal": [0, 0, 1]}}],
            "output": {"fields": ["positions", "velocities", "contacts"]}}


def write(scene, name="scene.json"):
    pathlib.Path(name).write_text(json.dumps(scene, default=os.fspath))
    return name


def test_files_have_the_bytes_of_bemsim(contact):
    name = write(contact)
    run("BEMSIM", name, "-o", "programs")
    with bem.Simulation(name, output="python") as simulation:
        simulation.run()
        assert simulation.steps == simulation.planned_steps == 20
    for file in ("trajectory.h5",):
        assert pathlib.Path("python", file).read_bytes() == pathlib.Path("programs", file).read_bytes()


def test_a_dictionary_moves_as_its_file_does(contact):
    run("BEMSIM", write(contact), "-o", "out", "--fps", 50)
    simulation = bem.Simulation(contact, output="python", fps=50)
    positions = {0: [body.positions for body in simulation]}
    simulation.run(callback=lambda s: positions.update({s.steps: [body.positions for body in s]}))
    simulation.close()
    with bem.Trajectory("out/trajectory.h5") as theirs, bem.Trajectory("python/trajectory.h5") as ours:
        assert len(theirs) == len(ours) == 6
        for frame, time in enumerate(theirs.time):
            for body, found in zip(theirs.bodies.values(), positions[round(time / STEP)]):
                assert np.array_equal(body.positions[frame], found)
            a, b = theirs.contacts(frame), ours.contacts(frame)
            assert all(np.array_equal(x, y) for x, y in zip(a, b))
        assert len(theirs.contacts(-1).points) > 0
        assert list(ours.obstacles) == ["plate", "floor"] and np.array_equal(ours.obstacles["floor"].normal, [0, 0, 1])


def test_bodies_of_mesh_and_material_use_the_cache():
    scene = {"version": 1, "time_step": STEP, "duration": 0.02,
             "bodies": [{"name": "box", "mesh": "box.obj", "material": RUBBER, "precompute": {"scheme": "bdf1"}, "velocity": [1, 0, 0]}]}
    run("BEMSIM", write(scene), "-o", "out", "--cache", "cache")
    made = {entry.name: entry.stat().st_mtime_ns for entry in os.scandir("cache") if entry.name.endswith(".bem")}
    with bem.Simulation(scene, cache="cache", output="python", formats=["hdf5", "obj"]) as simulation:
        simulation.run()
    assert len(made) == 1 and {entry.name for entry in os.scandir("cache") if entry.name.endswith(".bem")} == set(made)
    assert sorted(os.listdir("python/obj"))[-1] == "box_000004.obj"


def test_what_a_step_shows(contact):
    simulation = bem.Simulation(contact)
    simulation.run()
    soft, contacts = simulation["soft"], simulation.contacts
    assert len(simulation) == 2 and list(simulation.bodies) == ["soft", "hard"] and simulation.obstacles == ["plate", "floor"]
    assert abs(soft.mass - 1) < 1e-12 and np.array_equal(soft.faces, FACES) and np.array_equal(soft.rest_positions, BOX)
    assert soft.velocities.shape == soft.tractions.shape == (8, 3)
    assert contacts.points.shape == contacts.normals.shape == contacts.forces.shape and contacts.pairs.shape[1] == 2
    assert len(contacts.points) == simulation.statistics["contacts"] > 0
    on_soft = sum(force if pair[0] == 0 else -force for force, pair in zip(contacts.forces, contacts.pairs) if 0 in pair)
    assert np.allclose(on_soft, soft.series["contact_force"], atol=1e-12)
    shape = soft.frame.translation + BOX @ soft.frame.rotation.T
    assert np.abs(shape - soft.positions).max() < 0.01
    assert simulation.statistics["converged"] and simulation.statistics["seconds"]["unconstrained"] > 0
    assert abs(simulation.time - 0.1) < 1e-12 and simulation.time_step == STEP


def test_loads_may_change(scene):
    scene["bodies"][0]["tractions"].append({"select": TOP, "pressure": 200})

    def end(change):
        simulation = bem.Simulation(scene)
        change(simulation["box"])
        simulation.run()
        return simulation["box"].positions

    as_said = end(lambda box: None)
    assert np.array_equal(end(lambda box: box.set_load(0, traction=[300, 0, 0])), as_said)
    assert np.array_equal(end(lambda box: box.set_load(1, pressure=200)), as_said)
    assert not np.array_equal(end(lambda box: box.set_load(1, pressure=400)), as_said)
    assert np.array_equal(end(lambda box: box.set_load(1, pressure=400)), end(lambda box: box.set_load(1, factor=2)))
    box = bem.Simulation(scene)["box"]
    for arguments, message in ((dict(load=2, factor=1), "no load 2"), (dict(load=0), "one of"), (dict(load=1, traction=[0, 0, 1]), "factor"),
                               (dict(load=0, pressure=1), "no pressure"), (dict(load=0, traction=[0, np.nan, 0]), "finite")):
        with pytest.raises(bem.UsageError, match=message):
            box.set_load(**arguments)


def test_handles_go_where_they_are_moved(scene):
    scene["bodies"][0]["handles"] = [{"select": TOP, "motion": []}]
    del scene["bodies"][0]["tractions"]
    simulation = bem.Simulation(scene)
    box, top = simulation["box"], BOX[:, 2] > 0
    for step in range(1, 5):
        box.move_handle(translate=[0.001 * step, 0, 0], angle_deg=90, axis=[0, 0, 2] if step == 4 else [1, 0, 0], about=[0, 0, 0])
        if step == 4:
            break
    box.move_handle(translate=[0.004, 0, 0])
    simulation.step()
    assert np.abs(box.positions[top] - BOX[top] - [0.004, 0, 0]).max() < 1e-9
    box.release_handle()
    simulation.run(5)
    assert np.abs(box.positions[top] - BOX[top] - [0.004, 0, 0]).max() > 1e-5
    with pytest.raises(bem.UsageError, match="no handle 1"):
        box.release_handle(1)


def test_obstacles_go_where_they_are_moved(contact):
    with bem.Simulation(contact, output="out") as simulation:
        for step in range(1, 6):
            simulation.move_obstacle("plate", translate=[0, 0, 0.002 * step], axis=[0, 0, 1], angle_deg=2 * step)
            simulation.step()
        with pytest.raises(bem.UsageError, match="is a plane"):
            simulation.move_obstacle("floor")
        with pytest.raises(bem.UsageError, match="no obstacle 'roof'"):
            simulation.move_obstacle("roof")
        assert simulation["soft"].positions[:, 2].min() > 0.009
    with bem.Trajectory("out/trajectory.h5") as trajectory:
        plate = trajectory.obstacles["plate"]
        assert np.allclose(plate.translation[:, 2], 0.002 * np.arange(6), atol=1e-15)
        assert np.allclose(plate.rotation[-1, 0, 0], np.cos(np.radians(10)), atol=1e-15)


def test_a_callback_may_end_a_run_and_so_may_ctrl_c(scene):
    simulation = bem.Simulation(scene, output="out")
    simulation.run(callback=lambda s: s.steps < 3)
    assert simulation.steps == 3

    def interrupt(running):
        if running.steps == 5:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        simulation.run(100, callback=interrupt)
    assert simulation.steps in (5, 6)
    simulation.close()
    simulation.step()
    with bem.Trajectory("out/trajectory.h5") as trajectory:
        assert len(trajectory) in (6, 7)


def test_two_threads_share_a_simulation(scene):
    simulation = bem.Simulation(scene)
    threads = [threading.Thread(target=lambda: simulation.run(50)) for _ in range(2)]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        assert np.isfinite(simulation["box"].positions).all()
    alone = bem.Simulation(scene)
    alone.run(100)
    assert simulation.steps == 100 and np.array_equal(alone["box"].positions, simulation["box"].positions)


def test_errors(scene, archive):
    with pytest.raises(bem.InputError, match=r"scene:\d+:\d+: /bodies/0/frictoin.*friction"):
        bem.Simulation({**scene, "bodies": [{"name": "box", "archive": archive, "frictoin": 1}]})
    with pytest.raises(bem.InputError, match="none.json"):
        bem.Simulation("none.json")
    with pytest.raises(bem.ArchiveError, match="time step"):
        bem.Simulation({**scene, "time_step": 0.004})
    with pytest.raises(bem.UsageError, match="either every or fps"):
        bem.Simulation(scene, every=2, fps=10)
    with pytest.raises(bem.UsageError, match="formats does not know"):
        bem.Simulation(scene, formats=["mp3"])
    with pytest.raises(KeyError, match="no body 'bunny'"):
        bem.Simulation(scene)["bunny"]
    with bem.Simulation(scene, output="out"):
        pass
    with pytest.raises(bem.UsageError, match="out"):
        bem.Simulation(scene, output="out")
    bem.Simulation(scene, output="out", force=True).close()


def test_a_step_that_fails_leaves_the_frames_so_far(scene):
    scene["bodies"][0]["tractions"][0]["traction"] = [0, 0, -1e9]
    simulation = bem.Simulation(scene, output="out")
    with pytest.raises(bem.NumericalError, match="box") as caught:
        simulation.run(100)
    assert isinstance(caught.value, ArithmeticError) and caught.value.code == 5
    with pytest.raises(bem.UsageError, match="has failed"):
        simulation.step()
    with bem.Trajectory("out/trajectory.h5") as trajectory:
        assert len(trajectory) >= 1


def test_a_trajectory_can_be_read_while_it_grows(scene):
    with bem.Simulation(scene, output="out") as simulation:
        for frames in (4, 7):
            simulation.run(3)
            with bem.Trajectory("out/trajectory.h5") as trajectory:
                assert len(trajectory) == frames
                assert np.array_equal(trajectory["box"].positions[-1], simulation["box"].positions)


def test_trajectories_that_are_none():
    with pytest.raises(bem.ArchiveError, match="box.obj"):
        bem.Trajectory("box.obj")
    with pytest.raises(bem.ArchiveError, match="none.h5"):
        bem.Trajectory("none.h5")


def test_a_study_has_a_row_for_every_run(scene):
    scene["bodies"][0].update(mesh="box.obj", material=RUBBER, precompute={"scheme": "bdf1"})
    del scene["bodies"][0]["archive"]
    study = bem.convergence(scene, coarser=1, finer=0, cache="cache")
    assert [row["time_step"] for row in study.table] == [STEP] + [row["time_step"] for row in study.table[1:]]
    assert len(study.table) >= 2 and study.table[-1]["position_difference"] >= 0
    assert "varied" in study.text and study.report["program"] == bem.version()
    with pytest.raises(bem.UsageError, match="nothing to compare"):
        bem.convergence(scene, coarser=0, finer=0)
