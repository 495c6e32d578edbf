#!/usr/bin/env python3
"""The pictures of a trade-off, beside its tradeoff.json: tradeoff.png, the plot of error against
time with the Pareto front, and crops.png, the front's pictures side by side at their worst place.

    tradeoff_pictures.py TRADEOFF.json
"""

import argparse
import json
import os
import pathlib
import sys

sys.dont_write_bytecode = True
from report_images import Unreadable  # noqa: E402
from report_plots import pyplot_for  # noqa: E402
from report_tradeoff import panels_of  # noqa: E402
import tradeoff_crops  # noqa: E402
import tradeoff_plot  # noqa: E402

INK = "#33383f"
COLUMNS = 3  # of crops


def save(figure, file, pyplot):
    """Whole or not at all, and in few colours: such pictures lose nothing by it but size."""
    from PIL import Image
    part = file.with_name(f".part-{file.name}")
    figure.savefig(part, dpi=110, metadata={"Software": None})
    pyplot.close(figure)
    with Image.open(part) as drawn:
        small = drawn.convert("RGB").quantize(colors=255, method=Image.Quantize.MEDIANCUT,
                                              dither=Image.Dither.NONE)
    small.save(part, "PNG", optimize=True)
    os.replace(part, file)


def plot(data, file, pyplot):
    panels = panels_of(data)
    if panels:
        save(tradeoff_plot.draw(pyplot, panels, INK), file, pyplot)


def crops(folder, data, file, pyplot):
    labelled, (x0, y0, x1, y1) = tradeoff_crops.crops_of(folder, data)
    columns = min(COLUMNS, len(labelled))
    rows = -(-len(labelled) // columns)
    height = 2.8 * (y1 - y0) / (x1 - x0) + 0.45
    figure, all_axes = pyplot.subplots(rows, columns, figsize=(2.8 * columns, height * rows),
                                       layout="constrained", squeeze=False)
    for axes in all_axes.flat:
        axes.set_axis_off()
    for axes, (label, pixels) in zip(all_axes.flat, labelled):
        axes.imshow(pixels, interpolation="nearest")
        axes.set_title("\n".join(label), fontsize=8, color=INK)
    save(figure, file, pyplot)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tradeoff", type=pathlib.Path)
    options = parser.parse_args()
    folder = options.tradeoff.resolve().parent
    try:
        data = json.loads(options.tradeoff.read_text())
        pyplot = pyplot_for("agg")
        plot(data, folder / "tradeoff.png", pyplot)
        crops(folder, data, folder / "crops.png", pyplot)
    except (OSError, Unreadable, ValueError) as error:
        print(f"no pictures of '{options.tradeoff}': {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
