"""Colours: sRGB encoding, the colour maps, the palette of bodies, and the scale of a quantity."""
import dataclasses

import numpy as np

# viridis (Smith, van der Walt, Firing; CC0) at 32 equidistant points.
_VIRIDIS = (
    "440154470d6048186a482374472e7c4538824241863e4a893a548c365d8d32658e2e6d8e2b758e287d8e25848e228c8d"
    "1f948c1e9c8920a38625ab822eb37c3aba7648c16e58c7656ccd5a7fd34e93d741a8db34c0df25d5e21aeae51afde725")
# From blue over a light grey to red (coolwarm; Moreland 2009) at 9 equidistant points.
_COOLWARM = ("3b4cc0" "6788ee" "9abbff" "c9d7f0" "dddddd" "edd1c2" "f7a889" "e26952" "b40426")
_BODIES = ("4c86c6", "ee8a3a", "55a868", "d9575c", "8d79c9", "4fb5b0", "e3bb3f", "a47a61")
_CLAY = "c9bcae"
_SURROUNDINGS = "b4bac2"
_PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))


def to_linear(encoded):
    """sRGB-encoded values 0..1 to linear light."""
    encoded = np.asarray(encoded, dtype=float)
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def to_srgb(linear):
    """Linear light to sRGB-encoded values 0..1."""
    linear = np.clip(linear, 0.0, 1.0)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


_BYTES = np.round(255 * to_srgb(np.arange(65536) / 65535)).astype(np.uint8)


def to_bytes(linear):
    """Linear light to sRGB-encoded bytes, by a table: computing powers takes ten times as long."""
    return _BYTES[(np.clip(linear, 0.0, 1.0) * 65535 + 0.5).astype(np.uint16)]


def from_hex(text):
    """The sRGB triples 0..1 of a string of hexadecimal colours."""
    return np.frombuffer(bytes.fromhex(text), dtype=np.uint8).reshape(-1, 3) / 255.0


def viridis(count=256):
    """The map of quantities that start at zero, as `count` sRGB triples."""
    return _interpolated(_VIRIDIS, count)


def coolwarm(count=256):
    """The map of quantities of both signs."""
    return _interpolated(_COOLWARM, count)


def _interpolated(text, count):
    table = from_hex(text)
    at = np.linspace(0, len(table) - 1, count)
    return np.stack([np.interp(at, np.arange(len(table)), table[:, k]) for k in range(3)], axis=1)


def body_color(index):
    return from_hex(_BODIES[index % len(_BODIES)])[0]


def clay():
    return from_hex(_CLAY)[0]


def surroundings():
    return from_hex(_SURROUNDINGS)[0]


@dataclasses.dataclass
class Scale:
    """How a quantity becomes a colour and a labelled bar."""
    title: str
    unit: str
    low: float
    high: float
    clipped: bool = False  # some values lie above high
    signed: bool = False  # of both signs, with zero in the middle

    def table(self, count=256):
        """The colour map as `count` sRGB triples."""
        return coolwarm(count) if self.signed else viridis(count)

    def shares(self, values):
        return np.clip((values - self.low) / (self.high - self.low), 0.0, 1.0)

    def display(self):
        """Factor and unit that make the numbers of the bar short."""
        if self.unit == "%":
            return 1.0, self.unit
        largest = max(abs(self.low), abs(self.high))
        for size, prefix in _PREFIXES:
            if largest >= size * 0.9999:
                return size, prefix + self.unit
        return 1.0, self.unit

    def ticks(self):
        """Values of round ticks inside the range, and their texts in display units."""
        factor, _ = self.display()
        low, high = self.low / factor, self.high / factor
        step = nice_step((high - low) / 4)
        values = np.arange(np.ceil(low / step - 1e-9), np.floor(high / step + 1e-9) + 1) * step
        digits = max(0, -int(np.floor(np.log10(step) + 1e-9)))
        return values * factor, [f"{v + 0.0:.{digits}f}" for v in values]


def nice_step(rough):
    """1, 2 or 5 times a power of ten, not below rough."""
    power = 10.0 ** np.floor(np.log10(rough))
    return next(power * m for m in (1, 2, 5, 10) if power * m >= rough * 0.999)
