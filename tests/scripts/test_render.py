"""scripts/render.py: pictures of a small trajectory, and the parts that they rest on."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np
from PIL import Image

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))

from rendering import camera, colors, geometry, hdf5, picture, raster, texture, trajectory  # noqa: E402

BOX_FACES = np.array([[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4],
                      [1, 2, 6], [1, 6, 5], [2, 3, 7], [2, 7, 6], [3, 0, 4], [3, 4, 7]])


def box(center, size):
    unit = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
    return (unit - 0.5) * size + center


def write_trajectory(path, bodies, times=None, tractions=None):
    """bodies: name -> positions [frames, N, 3] of boxes."""
    with h5py.File(path, "w") as file:
        frames = len(next(iter(bodies.values())))
        file["time"] = np.arange(frames) * 0.1 if times is None else times
        for name, positions in bodies.items():
            file[f"bodies/{name}/positions"] = np.asarray(positions, dtype=float)
            file[f"bodies/{name}/faces"] = BOX_FACES
        for name, values in (tractions or {}).items():
            file[f"bodies/{name}/tractions"] = values


def pixels(path):
    with Image.open(path) as image:
        return np.asarray(image)


def hue_distance(pixel, color):
    """How far a pixel's hue is from a colour's: shading changes brightness, not so much the hue."""
    def direction(rgb):
        chroma = np.asarray(rgb, dtype=float) - np.mean(rgb)
        return chroma / max(np.linalg.norm(chroma), 1e-12)
    return np.linalg.norm(direction(pixel) - direction(color))


def add_obstacle(path, name, vertices, faces, translation, rotation):
    """A mesh obstacle as docs/trajectory-format.md has it; one pose for each frame."""
    with h5py.File(path, "a") as file:
        group = file.create_group(f"obstacles/{name}")
        group["vertices"], group["faces"] = np.asarray(vertices, dtype=float), faces
        group["translation"], group["rotation"] = np.asarray(translation, dtype=float), np.asarray(rotation, dtype=float)


def add_plane(path, name, point, normal):
    with h5py.File(path, "a") as file:
        file[f"obstacles/{name}/point"] = np.asarray(point, dtype=float)
        file[f"obstacles/{name}/normal"] = np.asarray(normal, dtype=float)


class Obstacles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "t.h5"
        write_trajectory(self.path, {"a": [box(0, 1)] * 3})

    def load(self, every=1):
        return trajectory.load(self.path, lambda times: trajectory.select_frames(times, every=every), False)

    def test_meshes_are_where_their_poses_say_in_the_chosen_frames(self):
        quarter = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
        add_obstacle(self.path, "plate", box(0, 2), BOX_FACES, [[0, 0, 0], [9, 9, 9], [0, 0, 5]], [np.eye(3), np.eye(3), quarter])
        plate, = self.load(every=2).obstacles
        np.testing.assert_array_equal(plate.faces, BOX_FACES)
        np.testing.assert_array_equal(plate.at(0), box(0, 2))
        np.testing.assert_array_equal(plate.at(1)[6], [-1, 1, 6])  # (1, 1, 1) turned about z and lifted

    def test_open_meshes_are_seen_from_both_sides(self):
        add_obstacle(self.path, "sheet", box(0, 2), BOX_FACES[:2], np.zeros((3, 3)), [np.eye(3)] * 3)
        np.testing.assert_array_equal(self.load().obstacles[0].faces, [*BOX_FACES[:2], *BOX_FACES[:2, ::-1]])

    def test_planes_have_a_normal_of_length_one(self):
        add_plane(self.path, "floor", [1, 2, 3], [0, 4, 0])
        floor, = self.load().planes
        np.testing.assert_array_equal(floor.normal, [0, 1, 0])
        self.assertEqual(floor.offset, 2)
        patch = floor.patch(np.array([5.0, 7.0, 5.0]), 3.0, 3).at(2)
        np.testing.assert_allclose([patch.min(axis=0), patch.max(axis=0)], [[2, 2, 2], [8, 2, 8]], atol=1e-12)

    def test_poses_that_are_missing_are_an_error(self):
        add_obstacle(self.path, "plate", box(0, 2), BOX_FACES, np.zeros((2, 3)), [np.eye(3)] * 3)
        with self.assertRaisesRegex(hdf5.InvalidInput, "/obstacles/plate has no pose"):
            self.load()

    def test_long_edges_are_split_and_the_surface_stays(self):
        points, faces = geometry.split_long_edges(box(0, 1), BOX_FACES, 0.4, 8)
        corners = points[faces]
        self.assertLess(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(), 0.4)
        self.assertAlmostEqual(np.linalg.norm(geometry.face_normals(points, faces), axis=1).sum() / 2, 6)
        self.assertTrue(geometry.is_closed(faces[:0]) and geometry.is_closed(BOX_FACES))
        self.assertFalse(geometry.is_closed(BOX_FACES[1:]))


class Surfaces(unittest.TestCase):
    def test_simulated_surfaces_beside_render_meshes_are_not_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "t.h5"
            write_trajectory(path, {name: [box(0, 1)] for name in ("a", "a-simulation", "b", "b-simulation")})
            with h5py.File(path, "a") as file:
                file["bodies/a"].attrs["surface"] = "render"
                file["bodies/a-simulation"].attrs["surface"] = "simulation"
            drawn = trajectory.load(path, trajectory.select_frames, False).bodies
        self.assertEqual([body.name for body in drawn], ["a", "b", "b-simulation"])


class Textures(unittest.TestCase):
    OBJ = ("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 0.9 0\nvt 0.9 0.9\nvt 0 0.9\n"
           "f 1/1 2/2 3/3 4/4\nf 1/3 2/4 5/1\n")

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.mesh, self.image = (pathlib.Path(folder.name) / name for name in ("m.obj", "i.png"))
        self.mesh.write_text(self.OBJ)
        rgba = [[[255, 0, 0, 255], [0, 255, 0, 0]], [[0, 0, 255, 255], [255, 255, 255, 51]]]
        picture.save(self.image, np.array(rgba, np.uint8))

    def body(self, faces):
        return trajectory.Body("b", np.array(faces), None, None, None)

    def load(self, *faces):
        return texture.of_bodies((self.mesh, self.image), [self.body(f) for f in faces])

    def test_corners_have_the_coordinates_of_their_face(self):
        plain, textured = self.load([[0, 1, 2]], [[2, 0, 1], [2, 3, 0], [4, 1, 0]])
        self.assertIsNone(plain)
        np.testing.assert_array_equal(textured.coordinates, [[[.9, .9], [0, 0], [.9, 0]], [[.9, .9], [0, .9], [0, 0]],
                                                             [[0, 0], [0, .9], [.9, .9]]])

    def test_images_begin_at_the_upper_left_and_repeat(self):
        textured, = self.load([[2, 0, 1], [2, 3, 0], [4, 1, 0]])
        seen, opacity = textured.colors(np.array([[0.2, 0.9], [0.7, 1.9], [-0.8, 0.1], [0.9, 0.1]]))
        np.testing.assert_array_equal(seen, [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]])
        np.testing.assert_array_equal(opacity, [[1], [0], [1], [0.2]])

    def test_what_does_not_fit_is_an_error(self):
        for faces in ([[0, 1, 2]], [[2, 0, 1], [2, 3, 0], [3, 1, 0]]):
            with self.assertRaises(hdf5.InvalidInput):
                self.load(faces)
        for text in ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "vt x\n"):
            self.mesh.write_text(text)
            with self.assertRaises(hdf5.InvalidInput):
                self.load([[0, 1, 2]])
        self.mesh.write_text(self.OBJ)
        self.image.write_bytes(b"no image")
        with self.assertRaises(hdf5.InvalidInput):
            self.load([[0, 1, 2]])


class Pictures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.file = self.folder / "trajectory.h5"

    def render(self, *options, expect=0, path=None):
        done = subprocess.run([sys.executable, SCRIPTS / "render.py", self.file, *map(str, options)],
                              capture_output=True, text=True, env={**os.environ, **({"PATH": path} if path else {})})
        self.assertEqual(done.returncode, expect, done.stderr)
        return done

    def frames(self, *options, size="120x90"):
        out = self.folder / "frames"
        self.render("-o", out, "--size", size, "--no-text", *options)
        return [pixels(p) for p in sorted(out.glob("*.png"))]

    def two_moving_boxes(self):
        shift = np.linspace(0, 1, 5)[:, None, None] * [1.0, 0.0, 0.0]
        write_trajectory(self.file, {"left": box([-1, 0.5, 0], 1.0) + 0 * shift,
                                     "right": box([1, 0.5, 0], 1.0) + shift})

    def test_frames_have_the_size_asked_for_and_show_the_bodies(self):
        self.two_moving_boxes()
        pictures = self.frames("--every", 2, "--view", "0,0", "--floor", "none", size="160x100")
        self.assertEqual(len(pictures), 3)
        self.assertEqual([p.name for p in sorted((self.folder / "frames").glob("*"))],
                         ["frame_000000.png", "frame_000002.png", "frame_000004.png"])
        for picture in pictures:
            self.assertEqual(picture.shape, (100, 160, 3))
            brightness = picture.astype(int).sum(axis=2)  # of the background: the same all along a row
            body = np.abs(brightness - brightness[:, 2:3]) > 30
            self.assertGreater(body.mean(), 0.05)
            self.assertLess(body.mean(), 0.9)
            self.assertFalse(body[0].any() or body[-1].any() or body[:, 0].any() or body[:, -1].any())
        # The right box moves to the right, and only that one.
        changed = np.abs(pictures[0].astype(int) - pictures[2]).sum(axis=2) > 30
        self.assertTrue(changed[:, 100:].any())
        self.assertFalse(changed[:, :70].any())

    def test_a_near_body_hides_a_far_one_whatever_their_order(self):
        near, far = box([0, 0, 2], 0.6), box([0, 0, -2], [3, 3, 1])
        for names in (("a", "b"), ("b", "a")):
            write_trajectory(self.file, {names[0]: near[None], names[1]: far[None]})
            picture, = self.frames("--color", "body", "--view", "0,0")
            order = sorted(names)
            near_color, far_color = (colors.body_color(order.index(n)) for n in names)
            middle, beside = picture[45, 60], picture[45, 60 + 22]
            self.assertLess(hue_distance(middle, near_color), 0.3)
            self.assertLess(hue_distance(beside, far_color), 0.3)
            self.assertGreater(hue_distance(middle, far_color), 0.6)

    def test_the_colour_range_decides_the_colour(self):
        start = box([0, 0, 0], 1.0)
        write_trajectory(self.file, {"box": np.stack([start, start + [2, 0, 0]])})
        options = ("--color", "displacement", "--view", "0,0", "--look-at", "2,0,0")
        table = colors.viridis()
        for limits, expected in (("0,2", table[-1]), ("0,4", table[128]), ("0,1000", table[0]), ("-9,-1", table[-1])):
            picture = self.frames(*options, "--range", limits)[1]
            distances = [hue_distance(picture[45, 60], color) for color in (table[0], table[128], table[-1])]
            self.assertEqual(np.argmin(distances), np.argmin([hue_distance(expected, c) for c in
                                                              (table[0], table[128], table[-1])]), limits)

    def test_the_ground_shows_a_shadow_and_hides_what_is_below(self):
        write_trajectory(self.file, {"box": box([0, 0.6, 0], 1.0)[None]})
        plain, = self.frames("--color", "none", "--floor", "none")
        above, = self.frames("--color", "none", "--floor", "y=0")
        below, = self.frames("--color", "none", "--floor", "y=3", "--view", "30,60")

        def body_share(picture):  # the clay is warm, all else is bluish
            return (picture[..., 0].astype(int) > picture[..., 2]).mean()

        darker = plain.astype(int).sum(axis=2) - above.astype(int).sum(axis=2) > 60
        self.assertGreater(darker.mean(), 0.02)
        self.assertGreater(body_share(above), 0.05)
        self.assertEqual(body_share(below), 0.0)

    def test_growing_triangles_are_red_and_shrinking_ones_blue(self):
        start = box([0, 0, 0], 1.0)
        for factor, color in ((1.2, colors.coolwarm()[-1]), (0.8, colors.coolwarm()[0])):
            write_trajectory(self.file, {"box": np.stack([start, factor * start])})
            still = self.folder / "still.png"
            self.render("--still", still, "--color", "area", "--view", "0,0", "--no-text", "--size", "120x90",
                        "--range", "-36,36")
            self.assertLess(hue_distance(pixels(still)[45, 60], color), 0.4)

    def test_ghosts_show_where_a_body_was(self):
        start = box([0, 0, 0], 1.0)
        write_trajectory(self.file, {"box": np.stack([start + [x, 0, 0] for x in (0, 2, 4)])})
        options = ("--view", "0,0", "--no-text", "--size", "240x90", "--floor", "none")
        plain, ghosts = self.folder / "plain.png", self.folder / "ghosts.png"
        self.render("--still", plain, *options)
        self.render("--still", ghosts, *options, "--ghosts", 2)
        changed = np.abs(pixels(plain).astype(int) - pixels(ghosts)).sum(axis=2) > 30
        columns = np.flatnonzero(changed.any(axis=0))
        self.assertLess(columns.min(), 60)
        self.assertLess(columns.max(), 170)  # the last position is as it was
        self.assertGreater(np.diff(columns).max(), 10)  # two ghosts, apart
        solid = np.abs(pixels(plain)[45, 200].astype(int) - pixels(plain)[45, 20]).sum()
        ghost = np.abs(pixels(ghosts)[45, 30].astype(int) - pixels(plain)[45, 30]).sum()
        self.assertGreater(ghost, 0.15 * solid)
        self.assertLess(ghost, 0.6 * solid)

    def test_the_pictures_do_not_depend_on_the_number_of_workers(self):
        self.two_moving_boxes()
        written = []
        for jobs in (1, 2):
            out = self.folder / f"jobs{jobs}"
            self.render("-o", out, "--size", "64x48", "--jobs", jobs)
            written.append([p.read_bytes() for p in sorted(out.glob("*.png"))])
        self.assertEqual(len(written[0]), 5)
        self.assertEqual(written[0], written[1])

    def test_a_contact_sheet_holds_its_panels(self):
        self.two_moving_boxes()
        sheet = self.folder / "sheet.png"
        self.render("--sheet", sheet, "--columns", 2, "--sheet-frames", 3, "--size", "100x80", "--no-text")
        gap = 4
        self.assertEqual(pixels(sheet).shape, (2 * (80 + gap) + gap, 2 * (100 + gap) + gap, 3))
        self.render("--sheet", sheet, "--columns", 2, "--sheet-frames", 3, "--size", "100x80",
                    "--color", "deformation")
        self.assertGreater(pixels(sheet).shape[1], 2 * (100 + gap) + gap)  # room for the colour bar

    def test_the_floor_is_the_plane_that_faces_upward_and_walls_stand_behind(self):
        write_trajectory(self.file, {"box": box([0, 2, 0], 1.0)[None]})
        lowest, = self.frames("--view", "0,5")
        add_plane(self.file, "floor", [0, 0, 0], [0, 1, 0])
        floor, = self.frames("--view", "0,5")
        self.assertFalse(np.array_equal(floor, lowest))
        np.testing.assert_array_equal(self.frames("--view", "0,5", "--floor", "y=0")[0], floor)
        add_plane(self.file, "wall", [0, 0, -1], [0, 0, 1])
        wall, = self.frames("--view", "0,5")
        self.assertGreater((wall != floor).any(axis=2).mean(), 0.3)
        np.testing.assert_array_equal(self.frames("--view", "0,5", "--no-obstacles")[0], floor)

    def test_obstacles_move_and_are_drawn_grey_however_large(self):
        write_trajectory(self.file, {"box": box([0, 0.5, 0], 1.0)[None].repeat(2, axis=0)})
        add_obstacle(self.file, "plate", box([0, -0.1, 0], [60, 0.2, 60]), BOX_FACES, [[0, 0, 0], [0, -0.4, 0]], [np.eye(3)] * 2)
        near, far = self.frames("--floor", "none", "--view", "0,20")
        self.assertGreater((near != far).any(axis=2).mean(), 0.1)
        self.assertLess(np.ptp(near[80, 60].astype(int)), 40)  # grey, in front of the box

    def test_videos_are_what_their_names_say(self):
        self.two_moving_boxes()
        film = self.folder / "film.gif"
        self.render("--video", film, "--size", "160x96", "--fps", 20)
        with Image.open(film) as gif:
            self.assertEqual((gif.format, gif.n_frames, gif.size), ("GIF", 5, (160, 96)))
            self.assertEqual((gif.info["duration"], gif.info["loop"]), (50, 0))
            shown = []
            for k in range(gif.n_frames):
                gif.seek(k)
                shown.append(np.asarray(gif.convert("RGB")).astype(int))
        self.render("-o", self.folder / "frames", "--size", "160x96")
        for gif_frame, png in zip(shown, sorted((self.folder / "frames").glob("*.png"))):
            self.assertLess(np.abs(gif_frame - pixels(png)).mean(), 4)
        if shutil.which("ffmpeg"):
            film = self.folder / "film.mp4"
            self.render("--mp4", film, "--size", "161x97")
            self.assertEqual(film.read_bytes()[4:8], b"ftyp")
        without = self.render("--video", film.with_suffix(".mp4"), expect=6, path="/nowhere")
        self.assertIn("need ffmpeg", without.stderr)

    def test_a_legend_leaves_room_for_the_time(self):
        blank = np.full((200, 300, 3), 255, np.uint8)
        legend = [(f"body {k}", colors.body_color(k)) for k in range(40)]
        captions = picture.Captions(200)
        with_both = captions.annotate(blank, "t = 0.00 s", legend=legend)
        with_time = captions.annotate(blank, "t = 0.00 s")
        changed = np.flatnonzero((with_both != with_time).any(axis=(1, 2)))
        written = np.flatnonzero((with_time != blank).any(axis=(1, 2)))
        self.assertGreater(changed.max(), 100)
        self.assertLess(changed.max() + 4, written.min())

    def test_what_cannot_be_drawn_is_one_line_of_error(self):
        def fails(code, *options):
            done = self.render(*options, expect=code)
            self.assertRegex(done.stderr, r"\Aerror: [^\n]+\n\Z")
            return done.stderr

        out = ("-o", self.folder / "out")
        self.assertIn("no such file", fails(3, *out))
        self.file.write_text("not HDF5")
        self.assertIn("not a readable HDF5 file", fails(3, *out))
        self.two_moving_boxes()
        fails(2)
        fails(2, *out, "--size", "12")
        self.assertIn(".mp4 or .gif", fails(2, "--video", self.folder / "film.avi"))
        fails(2, *out, "--frames", "0")
        fails(2, *out, "--floor", "w=1")
        fails(2, *out, "--ghosts", "3")
        self.assertIn("tractions", fails(3, *out, "--color", "traction"))
        with h5py.File(self.file, "r+") as file:
            file["bodies/left/positions"][2, 0, 0] = np.nan
        self.assertIn("/bodies/left/positions", fails(3, *out))
        self.two_moving_boxes()
        with h5py.File(self.file, "r+") as file:
            file["bodies/left/faces"][0, 0] = 8
        self.assertIn("outside 0..7", fails(3, *out))
        self.two_moving_boxes()
        (self.folder / "PIL.py").write_text("raise ModuleNotFoundError('No module named PIL')\n")
        os.environ["PYTHONPATH"] = str(self.folder)
        self.addCleanup(os.environ.pop, "PYTHONPATH")
        self.assertIn("python3-pil", fails(6, *out))
        (self.folder / "PIL.py").unlink()
        blocked = self.folder / "blocked"
        blocked.write_text("")
        fails(6, "-o", blocked / "out")


class Rasteriser(unittest.TestCase):
    def test_agrees_with_the_definition(self):
        random = np.random.default_rng(1)
        corners = random.uniform(-4, 36, (60, 3, 2))
        nearness = random.uniform(1, 2, (60, 3))
        owner = raster.visible_triangles(corners, nearness, 32, 24).reshape(24, 32)
        coefficients = raster.barycentric_coefficients(corners)
        y, x = np.mgrid[:24, :32] + 0.5
        weights = coefficients @ np.stack([x.ravel(), y.ravel(), np.ones(x.size)])
        value = np.where((weights > 0).all(axis=1), np.einsum("tis,ti->ts", weights, nearness), -np.inf)
        expected = np.where(np.isfinite(value.max(axis=0)), value.argmax(axis=0), -1).reshape(24, 32)
        np.testing.assert_array_equal(owner, expected)
        self.assertGreater(len(np.unique(owner)), 10)

    def test_neighbours_share_no_sample_and_leave_no_gap(self):
        grid = np.stack(np.meshgrid(np.arange(7.0), np.arange(7.0)), axis=-1) * 4 + 2.0
        grid[1:-1, 1:-1] += np.random.default_rng(2).uniform(-1.5, 1.5, (5, 5, 2))
        quads = [(grid[j, i], grid[j, i + 1], grid[j + 1, i + 1], grid[j + 1, i]) for i in range(6) for j in range(6)]
        corners = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
        hits = sum((raster.visible_triangles(t[None], np.ones((1, 3)), 28, 28) >= 0).astype(int) for t in corners)
        expected = np.zeros((28, 28), dtype=int)
        expected[2:26, 2:26] = 1
        np.testing.assert_array_equal(hits.reshape(28, 28), expected)


class Geometry(unittest.TestCase):
    def test_rigid_fit_follows_a_rigid_motion_and_no_deformation(self):
        points = box([1, 2, 3], [1, 2, 3])
        c, s = np.cos(2.0), np.sin(2.0)
        moved = points @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]).T + [4, 5, 6]
        weights = geometry.vertex_areas(points, BOX_FACES)
        np.testing.assert_allclose(geometry.rigid_fit(points, moved, weights), moved, atol=1e-12)
        stretched = moved * [1, 1, 1.1]
        self.assertGreater(np.abs(geometry.rigid_fit(points, stretched, weights) - stretched).max(), 0.05)

    def test_area_changes_are_percents_of_each_triangle(self):
        points = box([1, 2, 3], 1.0)
        changes = geometry.area_changes(points, np.stack([points, points * [1, 1, 2]]), BOX_FACES)
        np.testing.assert_allclose(changes, [[0] * 12, [0] * 4 + [100] * 8], atol=1e-9)

    def test_normals_split_at_sharp_edges_only(self):
        points = box([0, 0, 0], 1.0)
        self.assertEqual(geometry.smoothing_groups(points, BOX_FACES, 40)[1], 24)
        self.assertEqual(geometry.smoothing_groups(points, BOX_FACES, 100)[1], 8)
        normals = geometry.corner_normals(points, BOX_FACES, *geometry.smoothing_groups(points, BOX_FACES, 40))
        np.testing.assert_allclose(normals[0, 0], [0, 0, -1], atol=1e-12)

    def test_the_camera_sees_everything_and_is_no_farther_than_it_must(self):
        points = box([5, -2, 1], [1, 4, 2])
        for up in "yz":
            view = camera.frame_points([points], camera.view_axes(50, 25, up), 4 / 3, margins=(0.1, 0.2, 0.1, 0.1))
            place, inverse = view.project(points, 400, 300)
            self.assertTrue((inverse > 0).all())
            room = [place[:, 0].min() - 40, 320 - place[:, 0].max(), place[:, 1].min() - 30, 270 - place[:, 1].max()]
            self.assertGreater(min(room), -1e-6)
            self.assertLess(min(room), 1e-6)

    def test_frames_are_chosen_by_number_and_by_rate(self):
        times = np.arange(11) * 0.1
        self.assertEqual(list(trajectory.select_frames(times, count=3)), [0, 5, 10])
        self.assertEqual(list(trajectory.select_frames(times, every=4)), [0, 4, 8])
        self.assertEqual(list(trajectory.select_frames(times, at=[0, 0.31, 0.32, 9])), [0, 3, 10])
        self.assertEqual(list(trajectory.select_frames(times, rate=5.0)), [0, 2, 4, 6, 8, 10])
        self.assertEqual(list(trajectory.select_frames(times, rate=20.0))[:5:2], [0, 1, 2])

    def test_bytes_are_those_of_the_srgb_curve(self):
        linear = np.concatenate([np.linspace(-0.1, 1.1, 2001), np.linspace(0, 0.004, 500)])
        exact = 255 * colors.to_srgb(linear)
        self.assertLess(np.abs(colors.to_bytes(linear) - exact).max(), 0.53)
        np.testing.assert_allclose(colors.to_linear(exact / 255), np.clip(linear, 0, 1), atol=1e-6)

    def test_ticks_are_round_and_carry_the_unit(self):
        scale = colors.Scale("deformation", "m", 0.0, 0.0123)
        values, texts = scale.ticks()
        self.assertEqual(texts, ["0", "5", "10"])
        np.testing.assert_allclose(values, [0, 0.005, 0.010])
        self.assertEqual(scale.display()[1], "mm")


if __name__ == "__main__":
    unittest.main()
