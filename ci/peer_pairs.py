"""The image pairs of peers.py: made by numpy, and rendered by POV-Ray and mpipov.

Values are what the files store, H x W x C; an integer's full scale is 1.0 for the metrics.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import numpy

from program_runs import ROOT, require_success

WIDTH, HEIGHT = 64, 48


@dataclass(frozen=True)
class Pair:
    name: str
    what: str
    make: Callable  # (random generator) -> a, b; or of a rendered one (programs, folder) -> files
    depth: str = "uint8"
    suffix: str = ".png"
    rendered: bool = False
    # In what a peer is known not to agree, and why (peer_models.CAUSES): {"idiff.psnr": "peak"}.
    known: tuple = ()


def noise(random, shape, depth=numpy.uint8):
    return random.integers(0, numpy.iinfo(depth).max, shape, depth, endpoint=True)


def image(random, channels=3, height=HEIGHT, width=WIDTH):
    return noise(random, (height, width, channels))


def plus(pixels, y, x, channel, more):
    changed = pixels.copy()
    changed[y, x, channel] = more if numpy.isnan(more) else pixels[y, x, channel] + more
    return changed


def one_level(random):
    a = numpy.minimum(image(random), 254)
    return a, plus(a, 7, 9, 1, 1)


def every_level(random):
    a = numpy.minimum(image(random), 254)
    return a, a + numpy.uint8(1)


def noisy(random):
    a = image(random).astype(float)
    b = a + random.normal(0, 5, a.shape)
    return a.astype(numpy.uint8), numpy.clip(b.round(), 0, 255).astype(numpy.uint8)


def gradient(_random):
    ramp = numpy.linspace(0, 255, WIDTH).astype(numpy.uint8)
    a = numpy.broadcast_to(ramp[None, :, None], (HEIGHT, WIDTH, 3)).copy()
    return a, a[:, ::-1].copy()


def constant(a, b):
    return lambda _random: (numpy.full((HEIGHT, WIDTH, 3), a, numpy.uint8),
                            numpy.full((HEIGHT, WIDTH, 3), b, numpy.uint8))


def same(random):
    a = image(random)
    return a, a.copy()


def noisy_16(random):
    a = noise(random, (HEIGHT, WIDTH, 3), numpy.uint16)
    b = numpy.clip(a + random.normal(0, 300, a.shape).round(), 0, 65535)
    return a, b.astype(numpy.uint16)


def one_level_16(random):
    a = numpy.minimum(noise(random, (HEIGHT, WIDTH, 3), numpy.uint16), 65534)
    return a, plus(a, 20, 30, 2, 1)


def gray(random):
    a = image(random, 1)
    return a, numpy.roll(a, 1, axis=1)


def with_alpha(random):
    a = image(random, 4)
    b = a.copy()
    b[::3, ::5] = 255 - b[::3, ::5]
    return a, b


def tall(random):
    """More rows than our SSIM takes at once."""
    a = image(random, 3, 600, 40)
    return a, numpy.where(image(random, 3, 600, 40) < 40, 0, a).astype(numpy.uint8)


def small(random):
    """Smaller than SSIM's window of 11 x 11 pixels."""
    a = image(random, 3, 9, 30)
    return a, 255 - a


def high_range(random):
    a = random.normal(0, 1, (HEIGHT, WIDTH, 3)).astype(numpy.float32)
    a[0, 0], a[0, 1], a[0, 2] = 1e20, -1e20, 1e-30
    return a, (a * numpy.float32(1.01)).astype(numpy.float32)


def half_floats(random):
    a = random.uniform(0, 1, (HEIGHT, WIDTH, 3)).astype(numpy.float16)
    a[0, :4] = numpy.array([65504, -65504, 6e-8, -0.0], numpy.float16)[:, None]
    return a, numpy.roll(a, 3, axis=1)


def one_infinite(random):
    a = random.uniform(0, 1, (HEIGHT, WIDTH, 3)).astype(numpy.float32)
    b = plus(a, 3, 4, 1, 0.5)
    b[10, 10, 0] = numpy.inf
    return a, b


def two_not_finite(random):
    a = random.uniform(0, 1, (HEIGHT, WIDTH, 3)).astype(numpy.float32)
    b = plus(a, 3, 4, 1, 0.5)
    b[10, 10, 0], b[11, 11, 2] = numpy.inf, numpy.nan
    return a, b


def rendered(scene, options, ours):
    """The serial render, and that of mpipov with sections that leave seams."""
    def make(programs, folder):
        name = Path(scene).stem
        file, suffix = ROOT / "scenes" / scene, ".exr" if "+FE" in options else ".png"
        output = folder / f"{name}{suffix}", folder / f"{name}.sections{suffix}"
        programs.serial([f"+I{file}", f"+O{output[0]}", *options], folder)
        require_success(programs.mpi(1, [*ours, "--progress", "none", file, f"+O{output[1]}",
                                         *options], folder))
        return output
    return make


SIZE = ["+W96", "+H72"]
PLAIN = ["--seams", "plain", "--shape", "tiles", "--sections", "6"]
PEAK, ALPHA = ("idiff.psnr", "peak"), "alpha"
NOT_FINITE = tuple((f"idiff.{metric}", "not finite") for metric in ("mean", "rms", "psnr", "max")) + \
    tuple((f"scikit_image.{metric}", "no number") for metric in ("rms", "psnr", "ssim"))
PAIRS = [
    Pair("identical", "the same noise twice", same,
         known=(("idiff.psnr", "none"), ("scikit_image.psnr", "none"))),
    Pair("one_level", "one sample one level off", one_level),
    Pair("every_level", "every sample one level off", every_level),
    Pair("noise", "noise of 5 levels", noisy),
    Pair("gradient", "a gradient and its mirror image", gradient),
    Pair("constant", "constant 100 and constant 101", constant(100, 101)),
    Pair("zero", "all zero twice", constant(0, 0),
         known=(("idiff.psnr", "none"), ("scikit_image.psnr", "none"))),
    Pair("black_white", "all zero and all at full scale", constant(0, 255)),
    Pair("noise_16", "16 bits, noise of 300 levels", noisy_16, "uint16"),
    Pair("one_level_16", "16 bits, one sample one level off", one_level_16, "uint16"),
    Pair("gray", "gray noise, moved by one pixel", gray),
    Pair("alpha", "noise with alpha", with_alpha,
         known=tuple((f"idiff.{metric}", ALPHA) for metric in ("mean", "rms", "psnr"))),
    Pair("tall", "600 rows: SSIM in bands", tall),
    Pair("small", "9 rows: fewer than SSIM's window", small),
    Pair("float_range", "EXR from -1e20 to 1e20 and 1e-30", high_range, "float", ".exr",
         known=(PEAK,)),
    Pair("half_range", "EXR of half floats with their largest, smallest and -0", half_floats,
         "half", ".exr", known=(PEAK,)),
    Pair("infinite", "EXR, one sample infinite in B", one_infinite, "float", ".exr",
         known=NOT_FINITE),
    Pair("not_finite", "EXR, one sample infinite and one NaN in B", two_not_finite, "float",
         ".exr", known=NOT_FINITE),
    Pair("plain_seams", "basic/checker, serial and with plain seams",
         rendered("basic/checker.pov", [*SIZE, "+A0.1", "+AM1"], PLAIN), rendered=True),
    Pair("radiosity", "effects/radiosity as EXR, serial and in sections that share no samples",
         rendered("effects/radiosity.pov", [*SIZE, "+FE"],
                  [*PLAIN, "--radiosity", "independent"]),
         "half", ".exr", rendered=True, known=(PEAK,)),
]
