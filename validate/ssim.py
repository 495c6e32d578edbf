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
"""

import argparse
import contextlib
import json
import pathlib
import sys

import numpy as np
from skimage.metrics import structural_similarity

RADIUS = 5  # of the Gaussian, truncated at 3.5 sigma
WINDOW = 2 * RADIUS + 1
BAND_ROWS = 256


def bands(height, rows=BAND_ROWS):
    """Half-open ranges that cover `height`; none is thinner than the radius, if it can be helped."""
    start = 0
    while start < height:
        end = start + rows
        if height - end < WINDOW:
            end = height
        yield start, end
        start = end


def ssim_band(a, b, data_range):
    _, values = structural_similarity(
        a, b, data_range=data_range, channel_axis=-1, gaussian_weights=True, sigma=1.5,
        use_sample_covariance=False, full=True)
    return values


def ssim(a, b, data_range, full_scale=1, colour=None, rows=BAND_ROWS, map_file=None):
    """a, b: arrays of height x width x channels. Returns the object that is printed."""
    height, width, channels = a.shape
    if height < WINDOW or width < WINDOW:
        return {"ssim": None, "per_channel": [],
                "reason": f"the image is smaller than the {WINDOW} x {WINDOW} window"}
    colour = list(range(channels)) if colour is None else colour
    sums = np.zeros(channels)
    for start, end in bands(height, rows):
        low, high = max(0, start - RADIUS), min(height, end + RADIUS)
        part_a = a[low:high].astype(np.float64) / full_scale
        part_b = b[low:high].astype(np.float64) / full_scale
        if not (np.isfinite(part_a).all() and np.isfinite(part_b).all()):
            return {"ssim": None, "per_channel": [], "reason": "there are NaN or infinite values"}
        values = ssim_band(part_a, part_b, data_range)
        if map_file is not None:
            rows_of_map = values[start - low:end - low][:, :, colour].mean(axis=2)
            map_file.write(np.ascontiguousarray(rows_of_map, dtype=np.float32).tobytes())
        inner_start, inner_end = max(start, RADIUS), min(end, height - RADIUS)
        inner = values[inner_start - low:inner_end - low, RADIUS:width - RADIUS]
        sums += inner.sum(axis=(0, 1), dtype=np.float64)
    per_channel = sums / ((height - 2 * RADIUS) * (width - 2 * RADIUS))
    return {"ssim": float(per_channel[colour].mean()), "per_channel": per_channel.tolist()}


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
