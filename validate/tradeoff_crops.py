"""The place where the pictures of a Pareto front differ most, cut out of each of them."""

import numpy as np

from report_images import crop_box, cut, load, to_bytes
from report_text import at, count, listing, number, text, texts

MOST = 5  # pictures beside the truth: the first, the last, and some between


def spread_out(names, most=MOST):
    """At most `most` of them, evenly from the first to the last."""
    if len(names) <= most:
        return names
    return [names[round(i * (len(names) - 1) / (most - 1))] for i in range(most)]


def summed(errors, size):
    """Sums over all windows of `size` (height, width), by cumulative sums."""
    height, width = size
    total = np.pad(errors, ((1, 0), (1, 0))).cumsum(0).cumsum(1)
    return (total[height:, width:] - total[:-height, width:] - total[height:, :-width]
            + total[:-height, :-width])


def worst_place(pixels, truth):
    """The middle (x, y) of the window in which the pictures are farthest from the truth."""
    errors = sum(np.square(p.astype(np.float64) - truth).sum(axis=2) for p in pixels)
    height, width = errors.shape
    x0, y0, x1, y1 = crop_box(0, 0, width, height)
    sums = summed(errors, (y1 - y0, x1 - x0))
    y, x = np.unravel_index(np.argmax(sums), sums.shape)
    return int(x) + (x1 - x0) // 2, int(y) + (y1 - y0) // 2


def crops_of(folder, data):
    """[(label, uint8 pixels)], the truth last, and the box; raises Unreadable."""
    rows = {text(at(row, "name")): row for row in listing(at(data, "rows"))}
    names = [n for n in spread_out(texts(at(data, "front", "cpu", "settings"))) if n in rows]
    pictures = [to_bytes(load(folder, at(rows[name], "image"))) for name in names]
    truth = to_bytes(load(folder, at(data, "truth", "image")))
    height, width = truth.shape[:2]
    same = [(n, p) for n, p in zip(names, pictures) if p.shape == truth.shape]
    x, y = worst_place([p for _, p in same] or [truth], truth)
    box = crop_box(x, y, width, height)
    labelled = []
    for name, pixels in same:
        error, seconds = number(at(rows[name], "against_truth", "rms")), number(
            at(rows[name], "cpu_seconds", "median"))
        label = [text(at(rows[name], "what"), name)]
        if error is not None and seconds is not None:
            label.append(f"error {error:.3g}, {seconds:.2f} CPU s")
        labelled.append((label, cut(pixels, box)))
    samples = count(at(data, "truth", "samples_per_pixel"))
    labelled.append((["truth", f"{samples} samples a pixel"], cut(truth, box)))
    return labelled, box
