#!/usr/bin/env python3
"""Structural similarity of pairs of images handed over as raw pixels.

    ssim.py REQUESTS.json [--json FILE]

REQUESTS.json is a list of {"width", "height", "channels", "type" (u1, u2, f4, f8), "full_scale",
"data_range", "colour" (indices of the channels that are not alpha), "a", "b", "map"}; a and b name
files of rows of interleaved pixels in native byte order, relative to the request. Values are
divided by full_scale and compared with L = data_range. The file that map names, if it is not null,
gets the map as rows of native float32, the mean over the colour channels.

Prints a list, for each request {"ssim": x, "per_channel": [...]}: per channel the mean over all
pixels whose window lies in the image, and the mean of these over the colour channels; or
{"ssim": null, "reason": text}.

The settings are those with which scikit-image matches the implementation of Wang, Bovik, Sheikh and
Simoncelli (IEEE Transactions on Image Processing 13(4), 2004): Gaussian weights, sigma 1.5 (a
window of 11 x 11), K1 = 0.01, K2 = 0.03, population covariance. The image is worked through in
bands of rows that overlap by the window's radius, so memory does not grow with its height.

scikit-image takes a variance as the mean of squares less the square of the mean. Where values are
much larger than L (floats of bright light) nothing is left of it but rounding, and SSIM exceeds 1:
bands with such values are computed here, by the same formula, from deviations.

At the edges: identical images have 1 (so have those of one colour: there is no variance, and what
remains of the formula is (2 p q + C1) / (p^2 + q^2 + C1)); images smaller than the window, and
those with a NaN or an infinity, have none, and the reason is told.
"""

import argparse
import contextlib
import json
import math
import pathlib
import sys

import numpy as np
from skimage.metrics import structural_similarity

RADIUS = 5  # of the Gaussian, truncated at 3.5 sigma
WINDOW = 2 * RADIUS + 1
BAND_ROWS = 256
SIGMA, K1, K2 = 1.5, 0.01, 0.03
# Of L: with larger values scikit-image's variances are off by more than 1e-11 of C2 = (K2 L)^2.
LARGEST_FOR_SQUARES = 4.0


def bands(height, rows=BAND_ROWS):
    """Half-open ranges that cover `height`; none is thinner than the radius, if it can be helped."""
    start = 0
    while start < height:
        end = start + rows
        if height - end < WINDOW:
            end = height
        yield start, end
        start = end


def shifted(values, axis):
    """[(weight, the pixels so far before or after)] of the window, along an axis."""
    weights = np.exp(-0.5 * (np.arange(-RADIUS, RADIUS + 1) / SIGMA) ** 2)
    padded = np.pad(values, [(RADIUS, RADIUS) if n == axis else (0, 0) for n in range(values.ndim)],
                    mode="symmetric")
    length = values.shape[axis]
    return [(weight, np.take(padded, range(i, i + length), axis))
            for i, weight in enumerate(weights / weights.sum())]


def mean_along(values, axis):
    """Weighted mean, taken of the differences from the middle: exact where all are equal."""
    return values + sum(weight * (other - values) for weight, other in shifted(values, axis))


def ssim_from_deviations(a, b, data_range):
    """One channel. Variances as variance of the rows' means plus mean of the rows' variances."""
    c1, c2 = (K1 * data_range) ** 2, (K2 * data_range) ** 2
    variance_a, variance_b, covariance = (np.zeros_like(a) for _ in range(3))
    for axis in (1, 0):
        means = mean_along(a, axis), mean_along(b, axis)
        pairs = list(zip(shifted(a, axis), shifted(b, axis)))
        off = [(weight, in_a - means[0], in_b - means[1])
               for (weight, in_a), (_, in_b) in pairs]
        variance_a, variance_b, covariance = (
            mean_along(inner, axis) + sum(outer) for inner, outer in
            ((variance_a, (weight * x * x for weight, x, _ in off)),
             (variance_b, (weight * y * y for weight, _, y in off)),
             (covariance, (weight * x * y for weight, x, y in off))))
        a, b = means
    return ((2 * a * b + c1) * (2 * covariance + c2) /
            ((a * a + b * b + c1) * (variance_a + variance_b + c2)))


def ssim_band(a, b, data_range):
    """a, b: rows x width x channels; so is the result."""
    if max(np.abs(a).max(), np.abs(b).max()) > LARGEST_FOR_SQUARES * data_range:
        return np.stack([ssim_from_deviations(a[:, :, c], b[:, :, c], data_range)
                         for c in range(a.shape[2])], axis=2)
    _, values = structural_similarity(
        a, b, data_range=data_range, channel_axis=-1, gaussian_weights=True, sigma=SIGMA,
        use_sample_covariance=False, full=True)
    return values


def ssim(a, b, data_range, full_scale=1, colour=None, rows=BAND_ROWS, map_file=None):
    """a, b: arrays of height x width x channels. Returns the object that is printed."""
    height, width, channels = a.shape
    if height < WINDOW or width < WINDOW:
        return {"ssim": None, "per_channel": [],
                "reason": f"the image is smaller than the {WINDOW} x {WINDOW} window"}
    colour = list(range(channels)) if colour is None else colour
    sums = [[] for _ in range(channels)]  # of the rows
    for start, end in bands(height, rows):
        low, high = max(0, start - RADIUS), min(height, end + RADIUS)
        part_a = a[low:high].astype(np.float64) / full_scale
        part_b = b[low:high].astype(np.float64) / full_scale
        if not (np.isfinite(part_a).all() and np.isfinite(part_b).all()):
            return {"ssim": None, "per_channel": [], "reason": "there are NaN or infinite values"}
        with np.errstate(over="ignore", invalid="ignore"):
            values = ssim_band(part_a, part_b, data_range)
        if not np.isfinite(values).all():
            return {"ssim": None, "per_channel": [], "reason": "there are values too large to square"}
        if map_file is not None:
            rows_of_map = values[start - low:end - low][:, :, colour].mean(axis=2)
            map_file.write(np.ascontiguousarray(rows_of_map, dtype=np.float32).tobytes())
        inner_start, inner_end = max(start, RADIUS), min(end, height - RADIUS)
        inner = values[inner_start - low:inner_end - low, RADIUS:width - RADIUS]
        # A sum along the last axis is pairwise, and that of the rows exact: bands do not matter.
        for channel, rows_of_it in zip(sums, np.ascontiguousarray(inner.transpose(2, 0, 1))):
            channel += rows_of_it.sum(axis=1).tolist()
    count = (height - 2 * RADIUS) * (width - 2 * RADIUS)
    per_channel = [math.fsum(channel) / count for channel in sums]
    return {"ssim": math.fsum(per_channel[c] for c in colour) / len(colour),
            "per_channel": per_channel}


def answer(request, folder):
    shape = (request["height"], request["width"], request["channels"])
    a, b = (np.memmap(folder / request[name], dtype=request["type"], mode="r", shape=shape)
            for name in ("a", "b"))
    wanted = request.get("map")
    with (folder / wanted).open("wb") if wanted else contextlib.nullcontext() as map_file:
        return ssim(a, b, request["data_range"], request["full_scale"], request["colour"],
                    map_file=map_file)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("requests", type=pathlib.Path)
    parser.add_argument("--json", type=pathlib.Path)
    options = parser.parse_args()
    folder = options.requests.parent
    text = json.dumps([answer(request, folder)
                       for request in json.loads(options.requests.read_text())])
    if options.json:
        options.json.write_text(text + "\n")
    else:
        print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
