"""Small trajectories whose motion is known, of layout 1 and of layout 2."""
import json

import h5py
import numpy as np

FRAMES, STEP, GRAVITY = 81, 0.01, 9.81
CUBE = np.array([[x, y, z] for x in (-.1, .1) for y in (-.1, .1) for z in (-.1, .1)])
CUBE_FACES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
                       [1, 5, 7], [1, 7, 3]], dtype="i4")


def falls(time, height):
    """Height of the middle of a cube that falls to a floor and stays there."""
    return np.maximum(0.1, height - GRAVITY / 2 * time ** 2)


def turn(angle):
    """About the vertical axis."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def add(group, name, data, units=None):
    dataset = group.create_dataset(name, data=data)
    if units:
        dataset.attrs["units"] = units


def add_body(file, name, x, height, index):
    time = file["time"][:]
    body = file.create_group(f"bodies/{name}")
    moved = np.stack([np.full_like(time, x), falls(time, height), np.zeros_like(time)], axis=1)
    turned = np.array([turn(2 * t) for t in time])
    pressed = 1 - 0.2 * np.exp(-((time - 0.35) / 0.05) ** 2)  # along y
    shape = CUBE[None] * np.stack([np.ones_like(time), pressed, np.ones_like(time)], axis=1)[:, None]
    positions = moved[:, None] + np.einsum("kij,knj->kni", turned, shape)
    add(body, "positions", positions, "m")
    add(body, "faces", CUBE_FACES)
    add(body, "frame/translation", moved, "m")
    add(body, "frame/rotation", turned)
    body.attrs["index"] = index
    return positions


def write_layout_1(path):
    """One cube, positions alone."""
    with h5py.File(path, "w", libver="latest") as file:
        add(file, "time", STEP * np.arange(FRAMES), "s")
        return add_body(file, "cube", 0, 0.5, 0)


def write_layout_2(path):
    """Two cubes on a floor beside a slab that moves, with everything that layout 2 has."""
    with h5py.File(path, "w", libver="latest") as file:
        file.attrs.update({"format": "bem trajectory", "version": 2, "program": "bemsim 0.1.0", "time_step": STEP,
                           "scene": json.dumps({"gravity": [0, -GRAVITY, 0]})})
        time = STEP * np.arange(FRAMES)
        add(file, "time", time, "s")
        for index, (name, x, height) in enumerate([("right", 0.2, 0.7), ("left", -0.2, 0.4)]):
            positions = add_body(file, name, x, height, index)
            body = file[f"bodies/{name}"]
            velocities = np.gradient(positions, time, axis=0)
            add(body, "velocities", velocities, "m/s")
            add(body, "tractions", 1e3 * velocities, "Pa")
            add(body, "von_mises", 1e4 * np.abs(positions[:, :, 1]), "Pa")
            add(body, "stress", np.zeros((FRAMES, 8, 6)), "Pa")
            add(body, "series/kinetic_energy", 4 * (velocities ** 2).sum(2).mean(1), "J")
            add(body, "series/momentum", 8 * velocities.mean(1), "kg m/s")
        slab = CUBE * [4, 0.2, 0.5]
        add(file, "obstacles/slab/vertices", slab, "m")
        add(file, "obstacles/slab/faces", CUBE_FACES)
        add(file, "obstacles/slab/translation", np.stack([0.1 * time, 0.02 + 0 * time, -0.3 + 0 * time], axis=1), "m")
        add(file, "obstacles/slab/rotation", np.tile(np.eye(3), (FRAMES, 1, 1)))
        add(file, "obstacles/floor/point", np.zeros(3), "m")
        add(file, "obstacles/floor/normal", np.array([0, 1.0, 0]))
        file["obstacles/slab"].attrs["index"], file["obstacles/floor"].attrs["index"] = 2, 3
        add_contacts(file, time)


def add_contacts(file, time):
    """Forces on the corners of the left cube once it lies."""
    down = falls(time, 0.4) <= 0.1
    add(file, "contacts/counts", (4 * down).astype("i4"))
    rows = 4 * int(down.sum())
    points = CUBE[CUBE[:, 1] < 0] * [1, 0, 1] + [-0.2, 0, 0]
    add(file, "contacts/points", np.tile(points, (rows // 4, 1)), "m")
    add(file, "contacts/normals", np.tile([0, 1.0, 0], (rows, 1)))
    add(file, "contacts/forces", np.tile([0, 2.0, 0], (rows, 1)), "N")
    add(file, "contacts/pairs", np.tile([1, 3], (rows, 1)).astype("i4"))
