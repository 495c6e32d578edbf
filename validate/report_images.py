"""Pictures of a report: read with OpenImageIO, brought to 8 bits, cut, compared, encoded.

Arrays are height x width x channels. Coordinates are pixels from the top left, boxes half-open.
"""

import base64
import dataclasses
import io
import pathlib
from typing import NamedTuple

import numpy as np
from PIL import Image

LARGEST_SHOWN = 1280  # pixels; larger pictures are shown reduced by a whole factor
CROP_WIDTH, CROP_HEIGHT = 48, 36
NEAR = 8  # pixels on either side of a seam that count for which seam is worst
SPARSE = 0.002  # part of the pixels below which differing ones are grown to be seen


class Unreadable(Exception):
    """Says which picture cannot be shown, and why."""


@dataclasses.dataclass
class Picture:
    pixels: np.ndarray  # as stored: uint8, uint16 or float32
    alpha: int          # index of that channel, -1 where there is none

    @property
    def full_scale(self):
        return 1.0 if self.is_float else float(np.iinfo(self.pixels.dtype).max)

    @property
    def is_float(self):
        return self.pixels.dtype.kind == "f"


def inside(folder, name):
    """The file `name` below `folder`; results name nothing outside of their own folder."""
    folder = pathlib.Path(folder).resolve()
    file = (folder / name).resolve()
    if not file.is_relative_to(folder):
        raise Unreadable(f"'{name}' lies outside of the results' folder")
    return file


def load(folder, name):
    if not isinstance(name, str) or not name:
        raise Unreadable("no picture is named")
    try:
        import OpenImageIO as oiio
    except ImportError:
        raise Unreadable("OpenImageIO's Python module is missing: install python3-openimageio")
    file = inside(folder, name)
    if not file.is_file():
        raise Unreadable(f"'{name}' is not there")
    as_stored = oiio.ImageSpec()
    as_stored.attribute("oiio:UnassociatedAlpha", 1)
    source = oiio.ImageInput.open(str(file), as_stored)
    if source is None:
        raise Unreadable(f"'{name}' cannot be read: {'; '.join(oiio.geterror().split(chr(10)))}")
    spec = source.spec()
    depth = {"uint8": "uint8", "uint16": "uint16"}.get(str(spec.format), "float")
    pixels = source.read_image(depth)
    damage = "; ".join(source.geterror().split("\n")).strip("; ")
    source.close()
    if pixels is None or damage:
        raise Unreadable(f"'{name}' is damaged: {damage or 'its pixels cannot be read'}")
    pixels = np.asarray(pixels).reshape(spec.height, spec.width, spec.nchannels)
    return Picture(pixels, spec.alpha_channel)


def exposure_of(picture):
    """What floats are multiplied with to be shown: 1, or less where much is brighter than 1."""
    if not picture.is_float:
        return 1.0
    finite = picture.pixels[np.isfinite(picture.pixels)]
    bright = float(np.percentile(finite, 99.5)) if finite.size else 1.0
    return 1.0 / bright if bright > 1 else 1.0


def tone_mapping(picture, exposure):
    """How the stored values were brought to the page, or None where they are shown as they are."""
    if picture.is_float:
        scaled = f"linear values times {exposure:.3g}, " if exposure != 1 else "linear values, "
        return f"floats are shown as {scaled}clipped to 0..1, in the sRGB curve"
    if picture.pixels.dtype == np.uint16:
        return "16 bits are shown as 8"
    return None


def colour_channels(picture):
    channels = [c for c in range(picture.pixels.shape[2]) if c != picture.alpha]
    return (channels * 3)[:3] if len(channels) < 3 else channels[:3]


def to_bytes(picture, exposure=1.0):
    """uint8, 3 channels, or 4 with alpha."""
    pixels = picture.pixels
    channels = colour_channels(picture) + ([picture.alpha] if picture.alpha >= 0 else [])
    pixels = pixels[:, :, channels]
    if pixels.dtype == np.uint8:
        return pixels
    if pixels.dtype == np.uint16:
        return ((pixels.astype(np.uint32) + 128) // 257).astype(np.uint8)
    values = np.clip(np.nan_to_num(pixels.astype(np.float64), nan=0.0), 0, 1e30)
    colour, alpha = values[:, :, :3] * exposure, np.clip(values[:, :, 3:], 0, 1)
    if alpha.size:  # files of floats hold colour times alpha, a PNG does not
        colour = np.divide(colour, alpha, out=colour, where=alpha > 0)
    colour = np.clip(colour, 0, 1)
    colour = np.where(colour <= 0.0031308, colour * 12.92, 1.055 * colour ** (1 / 2.4) - 0.055)
    return np.rint(np.concatenate([colour, alpha], axis=2) * 255).astype(np.uint8)


def difference(a, b):
    """|b - a| per colour channel, as part of full scale; alpha's is added to all three."""
    if a.pixels.shape != b.pixels.shape or a.pixels.dtype != b.pixels.dtype:
        raise Unreadable(f"the two differ in size or depth: {a.pixels.shape[1]} x "
                         f"{a.pixels.shape[0]} x {a.pixels.shape[2]} {a.pixels.dtype} and "
                         f"{b.pixels.shape[1]} x {b.pixels.shape[0]} x {b.pixels.shape[2]} "
                         f"{b.pixels.dtype}")
    x, y = a.pixels, b.pixels
    if a.is_float:
        same = (x == y) | (np.isnan(x) & np.isnan(y))
        with np.errstate(invalid="ignore"):
            error = np.where(same, 0, np.nan_to_num(np.abs(x - y), nan=1, posinf=1))
    else:
        error = (np.maximum(x, y) - np.minimum(x, y)) / np.float32(a.full_scale)
    shown = error[:, :, colour_channels(a)]
    if a.alpha >= 0:
        shown = np.maximum(shown, error[:, :, a.alpha:a.alpha + 1])
    return shown


def amplification(error):
    """A power of two that brings 99 % of what differs into 0..1."""
    peak = error.max(axis=2)
    peak = peak[peak > 0]
    if not peak.size:
        return 1
    return 2 ** int(np.clip(np.floor(np.log2(1 / np.percentile(peak, 99))), 0, 16))


def grow(error):
    """Every pixel becomes the largest of its 3 x 3."""
    for axis in (0, 1):
        padded = np.pad(error, [(1, 1) if a == axis else (0, 0) for a in range(3)])
        length = error.shape[axis]
        error = np.maximum.reduce([np.take(padded, range(i, i + length), axis) for i in range(3)])
    return error


def difference_picture(error, factor):
    """Reduced, and whether pixels were grown."""
    sparse = np.count_nonzero(error.max(axis=2)) < SPARSE * error.shape[0] * error.shape[1]
    if sparse:
        error = grow(error)
    return amplified(reduce(error, np.max), factor), sparse


def amplified(error, factor):
    """uint8"""
    return np.rint(np.clip(error * factor, 0, 1) * 255).astype(np.uint8)


def reduce(pixels, by=np.mean):
    """By a whole factor to at most LARGEST_SHOWN; blocks at the right and bottom may be cut."""
    height, width, channels = pixels.shape
    n = -(-max(height, width) // LARGEST_SHOWN)
    if n <= 1 or min(height, width) < n:
        return pixels
    blocks = pixels[:height // n * n, :width // n * n].reshape(
        height // n, n, width // n, n, channels)
    return by(blocks, axis=(1, 3)).astype(pixels.dtype)


class Line(NamedTuple):
    """A seam: before the column, or the row, `position`, from `low` to before `high` along it."""

    vertical: bool
    position: int
    low: int
    high: int


def worst_place(error, line):
    """(mean error within NEAR of the seam, position along it) of the worst stretch of a crop."""
    vertical, position, low, high = line
    amount = error.max(axis=2)
    if not vertical:
        amount = amount.T
    band = amount[low:high, max(0, position - NEAR):position + NEAR]
    if not band.size:
        return 0.0, low
    window = min(CROP_HEIGHT if vertical else CROP_WIDTH, band.shape[0])
    sums = np.cumsum(np.concatenate([[0.0], band.mean(axis=1)]))
    means = (sums[window:] - sums[:-window]) / window
    start = int(means.argmax())
    return float(means[start]), low + start + window // 2


def crop_box(x, y, width, height):
    """(x0, y0, x1, y1) of the size of a crop, or of the picture, that holds x, y in its middle."""
    crop_width, crop_height = min(CROP_WIDTH, width), min(CROP_HEIGHT, height)
    x0 = min(max(0, x - crop_width // 2), width - crop_width)
    y0 = min(max(0, y - crop_height // 2), height - crop_height)
    return x0, y0, x0 + crop_width, y0 + crop_height


def cut(pixels, box):
    x0, y0, x1, y1 = box
    return pixels[y0:y1, x0:x1]


def data_uri(pixels):
    buffer = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(pixels)).save(buffer, "PNG", optimize=True)
    return "data:image/png;base64," + base64.b64encode(buffer.getvalue()).decode()
