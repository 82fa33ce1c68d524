#!/usr/bin/python3
"""Takes a picture of a page of bemview, or measures it, in headless Chromium, which draws without a graphics card.

    page_picture.py PAGE.html PICTURE.png --frame 40 --colour "von Mises stress"
    page_picture.py PAGE.html --measure

--measure prints JSON: seconds from the start of loading until the first frame is drawn and until all frames are decoded,
and milliseconds of the page's program (shape, normals, colours, plot; not the drawing) per frame, for every colour.

Exit codes: 0 ok, 2 usage, 6 Chromium is missing or a file cannot be read or written.
"""
import argparse
import json
import pathlib
import sys

from common import browser

MEASURE = """(() => {
  const { stage, recording, player } = bemview;
  const colours = {};
  for (let f = -1; f < recording.fields.length; f++) {
    stage.painted = f;
    const before = performance.now();
    for (let i = 1; i <= 100; i++) player.goTo((i * 1.37) % (recording.frames - 1));
    colours[f < 0 ? "bodies" : recording.fields[f].label] = Number(((performance.now() - before) / 100).toFixed(2));
  }
  const seconds = (name) => performance.getEntriesByName(name)[0].startTime / 1000;
  return { first_frame_seconds: seconds("first frame"), all_frames_seconds: seconds("all frames"), milliseconds_per_frame: colours };
})()"""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("picture", type=pathlib.Path, nargs="?", help="PNG file to write")
    parser.add_argument("--frame", type=int, default=0)
    parser.add_argument("--colour", help="what the page calls it")
    parser.add_argument("--quantity", help="of the plot, what the page calls it")
    parser.add_argument("--size", default="1280x800", help="in pixels of the page (%(default)s)")
    parser.add_argument("--scale", type=float, default=1, help="pixels of the picture per pixel of the page")
    parser.add_argument("--dark", action="store_true")
    parser.add_argument("--turn", type=int, nargs=2, metavar=("RIGHT", "DOWN"), default=(0, 0), help="drag the view by so many pixels")
    parser.add_argument("--measure", action="store_true")
    found = parser.parse_args()
    if not found.picture and not found.measure:
        parser.error("name a picture to write, or --measure")
    return found


def choose(page, options):
    """What a reader would choose by hand."""
    if options.colour:
        page.evaluate(f"[...document.querySelectorAll('.chip')].find((chip) => chip.textContent === {json.dumps(options.colour)}).click()")
    if options.quantity:
        page.evaluate("(() => { const list = document.querySelector('#quantity'); list.selectedIndex = [...list.options].findIndex("
                      f"(option) => option.textContent === {json.dumps(options.quantity)}); list.onchange(); }})()")
    page.evaluate(f"bemview.player.goTo({options.frame})")
    if any(options.turn):
        x, y = page.place_of("#view")
        page.drag((x, y), (x + options.turn[0], y + options.turn[1]), steps=8)
        page.evaluate("new Promise((done) => setTimeout(done, 800))")  # the view swings out


def main():
    options = arguments()
    width, height = map(int, options.size.split("x"))
    try:
        with browser.Browser(width, height, options.scale, options.dark) as page:
            page.open(options.page)
            if options.measure:
                print(json.dumps(page.evaluate(MEASURE), indent=1))
            if options.picture:
                choose(page, options)
                page.screenshot(options.picture)
    except (browser.NoBrowser, OSError, RuntimeError, TimeoutError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 6
    return 0


if __name__ == "__main__":
    sys.exit(main())
