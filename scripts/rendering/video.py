"""Videos that take one picture after the other: MP4 (H.264) through ffmpeg, and GIF."""
import pathlib
import shutil
import subprocess

import numpy as np
from PIL import Image

FORMATS = (".mp4", ".gif")
PALETTE_PICTURES = 12  # of a GIF, from which its colours are chosen
PALETTE_STEP = 4  # colours that differ by less count as one when the palette is chosen
GIF_COLORS = 255  # and one for pixels that stay as they are
DITHER = 8  # of 255
# Bayer's matrix, from -0.5 to 0.5.
_PATTERN = (np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]]) - 7.5) / 16


def is_gif(path):
    return pathlib.PurePath(path).suffix.lower() == ".gif"


def open_video(path, width, height, rate):
    """A video of pictures [height, width, 3] of bytes, `rate` per second: `add` takes them, `close` finishes the file.
    Raises OSError where the file cannot be written."""
    pathlib.Path(path).parent.mkdir(parents=True, exist_ok=True)
    return Gif(path, rate) if is_gif(path) else Mp4(path, width, height, rate)


class Mp4:
    def __init__(self, path, width, height, rate):
        if shutil.which("ffmpeg") is None:
            raise OSError(f"{path}: videos of this kind need ffmpeg (apt-get install ffmpeg); a name that ends with .gif "
                          "needs nothing")
        command = ["ffmpeg", "-nostdin", "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24",
                   "-s", f"{width}x{height}", "-r", f"{rate:g}", "-i", "-",
                   "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-crf", "17",
                   "-preset", "medium", "-pix_fmt", "yuv420p", "-movflags", "+faststart",
                   "-fflags", "+bitexact", "-f", "mp4", str(path)]
        self.path = pathlib.Path(path)
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE)

    def add(self, pixels):
        try:
            self.process.stdin.write(np.ascontiguousarray(pixels).tobytes())
        except BrokenPipeError:
            self.close()

    def close(self):
        """Raises OSError with ffmpeg's message when it failed, and leaves no file then."""
        _, message = self.process.communicate()
        if self.process.returncode != 0:
            self.path.unlink(missing_ok=True)
            lines = message.decode(errors="replace").strip().splitlines() or ["no message"]
            raise OSError(f"{self.path}: ffmpeg failed: {lines[-1]}")


class Gif:
    """Plays in a loop. All pictures share one palette, and pixels that stay as they are cost almost nothing."""

    def __init__(self, path, rate):
        self.path, self.rate, self.pictures = path, rate, []

    def add(self, pixels):
        self.pictures.append(pixels)

    def close(self):
        palette = self._palette()
        frames, before = [], None
        for pixels in self.pictures:
            now = np.asarray(Image.fromarray(_dithered(pixels)).quantize(palette=palette, dither=Image.Dither.NONE))
            frames.append(self._frame(now if before is None else np.where(now == before, GIF_COLORS, now), palette))
            before = now
        frames[0].save(self.path, save_all=True, append_images=frames[1:], loop=0, disposal=1, transparency=GIF_COLORS,
                       duration=self._durations(len(frames)), optimize=False)

    def _palette(self):
        """A picture with the palette of the whole video. Its last colour occurs nowhere: Pillow takes pixels of equal
        colour for equal."""
        chosen = np.unique(np.linspace(0, len(self.pictures) - 1, PALETTE_PICTURES).round().astype(int))
        sample = np.concatenate([self.pictures[k].reshape(-1, 3) for k in chosen])
        # The square root of how often a colour occurs: the background would take all colours.
        colors, counts = np.unique(sample // PALETTE_STEP * PALETTE_STEP, axis=0, return_counts=True)
        sample = np.repeat(colors, np.ceil(np.sqrt(counts)).astype(int), axis=0)
        palette = Image.fromarray(sample[None]).quantize(GIF_COLORS, method=Image.Quantize.MEDIANCUT)
        used = palette.getpalette()[:3 * GIF_COLORS]
        used += used[:3] * (GIF_COLORS - len(used) // 3)
        taken = {tuple(used[k:k + 3]) for k in range(0, len(used), 3)}
        free = next(c for c in ((255, 0, g) for g in range(256)) if c not in taken)
        palette.putpalette([*used, *free])
        return palette

    @staticmethod
    def _frame(indices, palette):
        frame = Image.fromarray(indices.astype(np.uint8), "P")
        frame.putpalette(palette.getpalette())
        return frame

    def _durations(self, count):
        """Milliseconds of each picture: GIF counts hundredths of a second, so the ends are rounded, not the lengths."""
        ends = np.round(np.arange(count + 1) * 100 / self.rate).astype(int)
        return (10 * np.maximum(np.diff(ends), 2)).tolist()  # browsers slow down what is faster than 50 per second


def _dithered(pixels):
    """With a pattern that hides the steps between the colours, and that stays the same where the picture does."""
    height, width, _ = pixels.shape
    pattern = np.tile(_PATTERN, (height // 4 + 1, width // 4 + 1))[:height, :width, None]
    return np.clip(np.round(pixels + DITHER * pattern), 0, 255).astype(np.uint8)
