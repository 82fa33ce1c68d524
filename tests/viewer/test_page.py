"""The page of bemview in headless Chromium: real clicks and keys, no network, pictures that show the bodies."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import h5py
import numpy as np

from trajectories import FRAMES, write_layout_1, write_layout_2

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
from common import browser  # noqa: E402

WIDTH, HEIGHT = 460, 640  # as on a phone
CORAL, TEAL = (255, 125, 107), (47, 181, 166)  # colours of the first two bodies


def share(picture, colour):
    """Part of the pixels whose hue is near that of a colour, and that are no grey."""
    pixels, wanted = picture.astype(float), np.array(colour, float)
    unit = lambda v: (v - v.mean(-1, keepdims=True)) / (np.linalg.norm(v - v.mean(-1, keepdims=True), axis=-1, keepdims=True) + 1e-9)
    vivid = pixels.max(-1) - pixels.min(-1) > 60
    return float((((unit(pixels) * unit(wanted)).sum(-1) > 0.95) & vivid).mean())


class PageCase(unittest.TestCase):
    """Opens a page of one trajectory, at whose first frame every test begins; tests leave the rest as they found it."""

    @classmethod
    def open(cls, write):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="bem_page_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        write(cls.folder / "t.h5")
        subprocess.run([os.environ["BEMVIEW"], cls.folder / "t.h5", "-o", cls.folder / "t.html", "-q"], check=True)
        cls.chromium = browser.Browser(WIDTH, HEIGHT)
        cls.addClassCleanup(cls.chromium.close)
        cls.chromium.open(cls.folder / "t.html")

    def setUp(self):
        self.assertEqual(self.data("state"), "ready", self.chromium.errors)
        self.chromium.press("Home")

    def tearDown(self):
        self.assertEqual(self.chromium.errors, [])
        self.assertEqual(self.chromium.requests, [])

    def data(self, name):
        return self.chromium.evaluate(f"document.body.dataset.{name}")

    def frame(self):
        return int(self.data("frame"))

    def text(self, selector):
        return self.chromium.evaluate(f"document.querySelector('{selector}').innerText")

    def view(self):
        """The picture above the controls."""
        _, top = self.chromium.place_of("#dock", 0, 0)
        return self.chromium.screenshot()[:int(top)]


class OldPage(PageCase):
    @classmethod
    def setUpClass(cls):
        cls.open(write_layout_1)

    def test_a_trajectory_of_layout_1(self):
        shown = self.chromium.evaluate("document.querySelector('#quantity').selectedOptions[0].textContent")
        self.assertEqual(shown, "height")
        self.assertGreater(share(self.view(), CORAL), 0.01)


class Page(PageCase):
    @classmethod
    def setUpClass(cls):
        cls.open(write_layout_2)

    def test_play_and_pause(self):
        self.assertEqual(self.frame(), 0)
        self.chromium.click("#play")
        self.chromium.wait_for("Number(document.body.dataset.frame) > 3", 20)
        self.assertEqual(self.data("playing"), "true")
        self.chromium.press(" ")
        self.assertEqual(self.data("playing"), "false")
        stopped = self.frame()
        time.sleep(0.3)
        self.assertEqual(self.frame(), stopped)

    def test_scrub_and_keys(self):
        left, middle = self.chromium.place_of("#scrub", 0.02), self.chromium.place_of("#scrub", 0.5)
        self.chromium.drag(left, middle, steps=3)
        self.assertAlmostEqual(self.frame(), FRAMES // 2, delta=1)
        at = self.frame()
        for key, expected in [("ArrowRight", at + 1), ("ArrowLeft", at), ("ArrowLeft", at - 1), ("Home", 0), ("ArrowLeft", 0), ("End", FRAMES - 1)]:
            self.chromium.press(key)
            self.assertEqual(self.frame(), expected, key)
        self.assertIn("800 ms", self.text("#clock"))

    def test_a_click_on_the_plot_goes_there(self):
        self.assertIn("m", self.text("#readings"))
        self.chromium.click("#chart", across=(72 + 0.25 * (WIDTH - 28 - 90)) / (WIDTH - 28))
        self.assertAlmostEqual(self.frame(), (FRAMES - 1) / 4, delta=1)

    def test_pictures_show_the_bodies(self):
        first = self.view()
        for colour in (CORAL, TEAL):
            self.assertGreater(share(first, colour), 0.01)
            self.assertLess(share(first, colour), 0.3)
        self.chromium.press("End")
        last = self.view()
        moved = (np.abs(first.astype(int) - last).max(-1) > 40).mean()
        self.assertGreater(moved, 0.01)
        self.assertGreater(share(last, CORAL), 0.01)

    def click_on_first_body(self):
        self.chromium.click("#open-panel")
        self.chromium.click("#bodies li:first-child label")
        self.chromium.click("#open-panel")

    def test_a_body_is_hidden_and_shown(self):
        self.click_on_first_body()
        hidden = self.view()
        self.assertLess(share(hidden, CORAL), 0.002)
        self.assertGreater(share(hidden, TEAL), 0.01)
        self.assertNotIn("right", self.text("#readings"))
        self.click_on_first_body()
        self.assertGreater(share(self.view(), CORAL), 0.01)

    def test_colours_and_their_legend(self):
        self.assertIsNone(self.chromium.evaluate("document.querySelector('#legend').offsetParent"))
        for label in ("displacement", "speed", "traction", "von Mises stress"):
            self.chromium.press("c")
            self.assertEqual(self.text("#legend-label"), label)
        self.assertIn("kPa", self.text("#legend-ticks"))
        self.assertLess(share(self.view(), TEAL), 0.002)
        self.chromium.press("c")
        self.assertGreater(share(self.view(), TEAL), 0.01)

    def test_contact_forces_appear_with_the_contact(self):
        arrows = "bemview.stage.arrows.count"
        self.assertEqual(self.chromium.evaluate(arrows), 0)
        self.chromium.press("End")
        self.assertEqual(self.chromium.evaluate(arrows), 4)

    def test_what_is_decoded_is_what_was_written(self):
        """The middle of a cube by the page, against the file's: within the quantisation."""
        with h5py.File(self.folder / "t.h5") as file:
            for b, name in enumerate(("right", "left")):
                for k in (0, 33, FRAMES - 1):
                    found = np.array(self.chromium.evaluate(f"Array.from(bemview.stage.bodies[{b}].world({k}))")).reshape(-1, 3)
                    np.testing.assert_allclose(found, file[f"bodies/{name}/positions"][k], atol=0.2 / 131070 * 1.75 + 1e-7)

    def test_the_page_may_not_use_the_network(self):
        self.assertEqual(self.chromium.evaluate("fetch('https://example.org').then(() => 'sent', () => 'refused')"), "refused")
        self.assertIn("Content Security Policy", " ".join(self.chromium.errors))
        self.chromium.errors.clear()

    def test_dark_and_help(self):
        bright = self.view().mean()
        self.chromium.press("d")
        self.assertLess(self.view().mean(), 0.5 * bright)
        self.chromium.press("h")
        self.assertTrue(self.chromium.evaluate("document.querySelector('#help').open"))
        self.chromium.press("h")
        self.chromium.press("d")
        self.assertAlmostEqual(self.view().mean(), bright, delta=2)


if __name__ == "__main__":
    if not browser.program():
        print("skipped: Chromium is missing; scripts/setup.sh --test installs it")
        sys.exit(77)
    unittest.main()
