"""Pictures as files: captions, colour bars, contact sheets."""
import numpy as np
from PIL import Image, ImageDraw, ImageFont

FONTS = ("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "DejaVuSans.ttf")
INK = (44, 52, 64)
FAINT_INK = (104, 114, 128)
PAPER = (247, 249, 251)


def save(path, pixels):
    """Writes [height, width, 3] bytes as a picture of the kind that the name's end says, the same bytes for the same
    pixels."""
    Image.fromarray(pixels).save(path)


class Captions:
    """Draws texts and colour bars into pictures of one height."""

    def __init__(self, picture_height):
        self.size = int(np.clip(round(picture_height * 0.029), 11, 40))
        self.font = _font(self.size)
        self.small = _font(max(10, round(self.size * 0.85)))

    def annotate(self, pixels, time_text, note="", scale=None, legend=()):
        """A copy of the picture with the time at the lower left, a note at the lower right, and at
        the right a colour bar, or at the upper left a legend of (name, sRGB colour) pairs."""
        image = Image.fromarray(pixels)
        canvas = ImageDraw.Draw(image)
        width, height = image.size
        pad = round(0.9 * self.size)
        canvas.text((pad, height - pad), time_text, INK, self.font, anchor="ls")
        if note:
            canvas.text((width - pad, height - pad), note, FAINT_INK, self.small, anchor="rs")
        self._legend(canvas, legend, pad, height - 3 * pad - self.size)
        if scale:
            self.bar(image, width - pad, round(0.2 * height), round(0.56 * height), scale)
        return np.asarray(image)

    def _legend(self, canvas, legend, pad, lowest):
        """Rows from the upper left down to `lowest`, above the time; the last one counts those that have no room."""
        line = round(1.6 * self.size)
        room = max(1, (lowest - pad) // line)
        shown = legend if len(legend) <= room else legend[:room - 1]
        for row, (name, color) in enumerate(shown):
            y = pad + row * line
            _chip(canvas, (pad, y, pad + self.size, y + self.size), color)
            canvas.text((pad + line, y + self.size / 2), name, INK, self.small, anchor="lm")
        if len(shown) < len(legend):
            y = pad + len(shown) * line + self.size / 2
            canvas.text((pad, y), f"and {len(legend) - len(shown)} more", FAINT_INK, self.small, anchor="lm")

    def bar_width(self, scale):
        """Pixels that a colour bar takes at the right of a picture."""
        if not scale:
            return 0
        _, texts, title, unit = self._bar_texts(scale)
        widest = max(self.small.getlength(text) for text in texts + ["0"])
        return int(max(self.size * 2.4 + widest, self.small.getlength(title), self.small.getlength(unit))
                   + 1.8 * self.size)

    def bar(self, image, right, top, length, scale):
        """Draws the colour bar on a light veil, so that it can be read over bodies, too."""
        ticks, texts, title, unit = self._bar_texts(scale)
        left = right - self.bar_width(scale) + round(1.8 * self.size)
        box = (left - round(0.7 * self.size), top - round(3.4 * self.size),
               min(right + round(0.5 * self.size), image.width), top + length + round(0.9 * self.size))
        veil = Image.new("RGB", (box[2] - box[0], box[3] - box[1]), PAPER)
        image.paste(Image.blend(image.crop(box), veil, 0.55), box[:2])
        canvas = ImageDraw.Draw(image)
        wide = round(0.95 * self.size)
        canvas.text((left, top - 1.9 * self.size), title, INK, self.small, anchor="ls")
        canvas.text((left, top - 0.7 * self.size), unit, FAINT_INK, self.small, anchor="ls")
        strip = np.round(255 * scale.table(length)[::-1]).astype(np.uint8)
        image.paste(Image.fromarray(np.repeat(strip[:, None], wide, axis=1)), (left, top))
        canvas.rectangle((left - 1, top - 1, left + wide, top + length), outline=(255, 255, 255))
        if scale.clipped:  # an arrow: some values lie beyond the end
            tip = (left + (wide - 1) / 2, top - 0.45 * self.size)
            canvas.polygon([(left, top - 2), (left + wide - 1, top - 2), tip], tuple(int(c) for c in strip[0]))
        for value, text in zip(ticks, texts):
            y = top + (length - 1) * (1 - scale.shares(value))
            canvas.line((left + wide + 2, y, left + wide + 0.4 * self.size, y), FAINT_INK)
            canvas.text((left + wide + 0.65 * self.size, y), text, INK, self.small, anchor="lm")

    def _bar_texts(self, scale):
        ticks, texts = scale.ticks()
        _, unit = scale.display()
        return ticks, texts, scale.title, f"[{unit}]"


def contact_sheet(panels, columns, scale=None):
    """Annotated panels [height, width, 3] side by side, with one colour bar at the right."""
    height, width, _ = panels[0].shape
    gap = max(4, width // 80)
    columns = min(columns, len(panels))
    rows = -(-len(panels) // columns)
    captions = Captions(height)
    bar = captions.bar_width(scale)
    sheet = np.full((rows * (height + gap) + gap, columns * (width + gap) + gap + bar, 3), PAPER, np.uint8)
    for index, panel in enumerate(panels):
        y = gap + index // columns * (height + gap)
        x = gap + index % columns * (width + gap)
        sheet[y:y + height, x:x + width] = panel
    if not bar:
        return sheet
    image = Image.fromarray(sheet)
    length = round(min(0.6 * sheet.shape[0], 1.5 * height))
    captions.bar(image, sheet.shape[1] - gap, (sheet.shape[0] - length) // 2 + captions.size, length, scale)
    return np.asarray(image)


def _font(size):
    for name in FONTS:
        try:
            return ImageFont.truetype(name, size)
        except OSError:
            continue
    try:
        from matplotlib import font_manager
        return ImageFont.truetype(font_manager.findfont("DejaVu Sans"), size)
    except (ImportError, OSError):
        return ImageFont.load_default()


def _chip(canvas, box, color):
    canvas.rectangle(box, fill=tuple(int(round(255 * c)) for c in color), outline=(255, 255, 255))
