"""Plots of a report, as SVG data URIs that follow the page into light and dark."""

import base64
import io
import os
import re
import tempfile

import tradeoff_plot

INK = "#010203"  # stands for the text colour, which the picture's own style sheet decides
COLOURS = ["#3b86c8", "#df8a0c", "#2a9d72", "#c9588f", "#8573d6", "#8f8a2c"]
FAR = 35  # where the pixels farther than every distance are drawn
STYLE = ("<style>svg{color:#33383f}"
         "@media(prefers-color-scheme:dark){svg{color:#c9ced6}}</style>")


def pyplot_for(backend):
    # Where the home folder cannot be written matplotlib warns and makes a folder of its own.
    if "MPLCONFIGDIR" not in os.environ and not os.access(os.path.expanduser("~"), os.W_OK):
        os.environ["MPLCONFIGDIR"] = os.path.join(tempfile.gettempdir(), f"mpl-{os.getuid()}")
    import matplotlib
    matplotlib.use(backend)
    from matplotlib import pyplot
    pyplot.rcParams.update({
        "text.parse_math": False,  # names are not formulas
        "svg.hashsalt": "mpipov", "font.size": 9.5, "font.family": "DejaVu Sans",
        "text.color": INK, "axes.labelcolor": INK, "xtick.color": INK, "ytick.color": INK,
        "axes.edgecolor": INK, "axes.spines.top": False, "axes.spines.right": False,
        "axes.linewidth": 0.7, "lines.linewidth": 1.7, "legend.frameon": False})
    return pyplot


def _pyplot():
    return pyplot_for("svg")


def _data_uri(figure, pyplot):
    buffer = io.BytesIO()
    figure.savefig(buffer, format="svg", transparent=True, metadata={"Date": None})
    pyplot.close(figure)
    svg = buffer.getvalue().decode().replace(INK, "currentColor")
    svg = re.sub(r"(<svg[^>]*>)", lambda match: match.group(1) + STYLE, svg, count=1)
    return "data:image/svg+xml;base64," + base64.b64encode(svg.encode()).decode()


def error_by_distance(curves, band, unit, band_label):
    """curves: [(label, [(distance, mean error)], mean error farther away | None)];
    band: [(distance, low, high)], empty where the scene has no noise."""
    pyplot = _pyplot()
    figure, axes = pyplot.subplots(figsize=(6.6, 3.2 + 0.17 * len(curves)), layout="constrained")
    if band:
        distances, low, high = zip(*band)
        axes.fill_between(distances, low, high, color="#8d95a0", alpha=0.35, linewidth=0,
                          label=band_label)
    far_shown = False
    for i, (label, points, far) in enumerate(curves):
        colour = COLOURS[i % len(COLOURS)]
        style = ["-", "--", ":"][i // len(COLOURS) % 3]
        distances, errors = zip(*points)
        axes.plot(distances, errors, style, color=colour, label=label, marker="o", markersize=2.4)
        if far is not None:
            far_shown = True
            axes.plot([FAR], [far], marker="D", markersize=4.5, color=colour, linestyle="none")
    ticks = [0, 5, 10, 15, 20, 25, 30]
    axes.set_xticks(ticks + ([FAR] if far_shown else []),
                    [str(t) for t in ticks] + (["farther"] if far_shown else []))
    axes.set_ylim(bottom=0)
    axes.set_xlabel("distance from the nearest seam, pixels (0: touches it)")
    axes.set_ylabel(f"mean |difference|, {unit}s")
    axes.grid(axis="y", color=INK, alpha=0.13, linewidth=0.7)
    axes.set_axisbelow(True)
    axes.legend(fontsize=8.5, loc="upper center", bbox_to_anchor=(0.5, -0.2), ncol=2)
    return _data_uri(figure, pyplot)


def speedup_by_ranks(curves):
    """curves: [(label, [(ranks, speed-up, lowest, highest)])], not empty, sorted by ranks."""
    pyplot = _pyplot()
    figure, axes = pyplot.subplots(figsize=(6.6, 3.4 + 0.17 * len(curves)), layout="constrained")
    ranks = sorted({point[0] for _, points in curves for point in points} | {1})
    axes.plot([0, ranks[-1]], [0, ranks[-1]], ":", color=INK, alpha=0.5, linewidth=1.2,
              label="ideal")
    for i, (label, points) in enumerate(curves):
        n, found, low, high = zip(*points)
        spread = [[f - w for f, w in zip(found, low)], [h - f for f, h in zip(found, high)]]
        axes.errorbar(n, found, yerr=spread, color=COLOURS[i % len(COLOURS)], label=label,
                      linestyle=["-", "--", ":"][i // len(COLOURS) % 3], marker="o", markersize=3.5,
                      capsize=3, elinewidth=0.9)
    if len(ranks) <= 12:
        axes.set_xticks(ranks)
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    axes.set_xlabel("processors")
    axes.set_ylabel("speed-up against povray +WT1")
    axes.grid(axis="y", color=INK, alpha=0.13, linewidth=0.7)
    axes.set_axisbelow(True)
    axes.legend(fontsize=8.5, loc="upper center", bbox_to_anchor=(0.5, -0.2), ncol=2)
    return _data_uri(figure, pyplot)


def error_by_seconds(panels):
    """panels: as tradeoff_plot.draw takes them, not empty."""
    pyplot = _pyplot()
    return _data_uri(tradeoff_plot.draw(pyplot, panels, INK), pyplot)
