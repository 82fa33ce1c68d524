"""Paint of the fish: an eye, a pale belly, a dark back, gills and fin rays on each side, over the colour of the body."""
import numpy as np
from PIL import Image, ImageDraw, ImageFilter

from common import obj

WIDTH = 1200  # pixels of the fish's length
WHITE, BLACK, DARK = (250, 248, 242), (18, 20, 26), (22, 30, 52)


def paint(mesh, painted, image):
    """Writes the mesh again as `painted`, with texture coordinates that project `image` on it from the side, and the
    image. The fish's nose is at the largest x, its back at the largest z."""
    vertices, faces = obj.read(mesh)
    side = np.array(vertices)[:, [0, 2]]
    low, size = side.min(axis=0), np.ptp(side, axis=0)
    with open(painted, "w", encoding="ascii") as file:
        file.writelines("v " + " ".join(map(repr, x)) + "\n" for x in vertices)
        # A thousandth inside the image, so that the nose does not get the colour of the tail.
        file.writelines(f"vt {u:.6f} {v:.6f}\n" for u, v in 0.001 + 0.998 * (side - low) / size)
        file.writelines("f " + " ".join(f"{i + 1}/{i + 1}" for i in face) + "\n" for face in faces)
    _picture(WIDTH, round(WIDTH * size[1] / size[0])).save(image)


def _picture(width, height):
    """Transparent but for the paint; the nose is at the right."""
    v = 1 - (np.arange(height) + 0.5) / height
    u = (np.arange(width) + 0.5) / width
    body = np.clip((u - 0.22) / 0.2, 0, 1)  # the tail has no belly
    belly = 0.9 * np.clip((0.42 - v) / 0.16, 0, 1)[:, None] * body
    back = 0.5 * np.clip((v - 0.62) / 0.3, 0, 1)[:, None] * body
    picture = Image.new("RGBA", (width, height), WHITE + (0,))
    for color, opacity in ((WHITE, belly), (DARK, back)):
        layer = Image.new("RGBA", (width, height), color)
        layer.putalpha(Image.fromarray((255 * opacity).astype(np.uint8)))
        picture.alpha_composite(layer)
    picture.alpha_composite(_lines(width, height))
    return picture


def _lines(width, height):
    layer = Image.new("RGBA", (width, height), DARK + (0,))
    canvas = ImageDraw.Draw(layer)
    gill = 0.30 * height
    canvas.arc((0.745 * width, 0.5 * height - gill, 0.845 * width, 0.5 * height + gill), 105, 255, DARK + (170,), width // 90)
    canvas.line((0.955 * width, 0.60 * height, 0.995 * width, 0.57 * height), DARK + (200,), width // 130)
    for end in np.linspace(0.02, 0.98, 13):  # rays of the tail fin
        canvas.line((0.27 * width, (0.5 + 0.18 * (end - 0.5)) * height, 0, end * height), DARK + (120,), width // 150)
    layer = layer.filter(ImageFilter.GaussianBlur(1.5))
    canvas = ImageDraw.Draw(layer)
    for radius, color in ((0.034, WHITE), (0.022, BLACK)):
        x, y, r = 0.885 * width, 0.40 * height, radius * width
        canvas.ellipse((x - r, y - r, x + r, y + r), color + (255,))
    canvas.ellipse((0.888 * width, 0.37 * height, 0.897 * width, 0.37 * height + 0.009 * width), WHITE + (255,))
    return layer
