"""Error against time of a tradeoff.json, with its Pareto front: for a page, and as a file."""

# Colour and shape of each sweep, so that neither alone must tell them apart.
MARKS = {"antialiasing": ("#3b86c8", "o"), "decomposition": ("#df8a0c", "s"),
         "radiosity": ("#2a9d72", "^"), "threads": ("#c9588f", "D")}


def log_axis(axis, values):
    """A logarithmic axis over the values with a few plain numbers at it."""
    from matplotlib.ticker import FuncFormatter, NullFormatter
    low, high = min(values), max(values)
    inside = []
    for steps in ((1, 2, 5), (1, 3), (1,)):  # the finest that leaves room
        ticks = [step * 10.0 ** e for e in range(-6, 7) for step in steps]
        inside = [t for t in ticks if low * 0.85 <= t <= high * 1.18]
        if len(inside) <= 7:
            break
    if len(inside) < 2:
        inside = [low, high] if high > low * 1.02 else [low]
    axis.set_major_formatter(FuncFormatter(lambda v, p: f"{v:.3g}"))
    axis.set_minor_formatter(NullFormatter())
    axis.set_ticks(inside)
    axis.set_ticks([], minor=True)


def panel(axes, found, ink):
    """found: {"points": [{"name", "sweep", "seconds", "low", "high", "error"}], "front": [name],
    "law": as in tradeoff.json | None, "truth_error": levels | None, "label": of the seconds}."""
    points = found["points"]
    by_name = {point["name"]: point for point in points}
    front = [by_name[name] for name in found["front"] if name in by_name]
    if len(front) > 1:
        axes.plot([p["seconds"] for p in front], [p["error"] for p in front], "-", color=ink,
                  alpha=0.55, linewidth=1.2, zorder=1, drawstyle="steps-post",
                  label="Pareto front")
    for sweep, (colour, mark) in MARKS.items():
        of_sweep = [p for p in points if p["sweep"] == sweep]
        if not of_sweep:
            continue
        spread = [[p["seconds"] - p["low"] for p in of_sweep],
                  [p["high"] - p["seconds"] for p in of_sweep]]
        axes.errorbar([p["seconds"] for p in of_sweep], [p["error"] for p in of_sweep],
                      xerr=spread, color=colour, marker=mark, markersize=4.5, linestyle="none",
                      elinewidth=0.7, alpha=0.85, label=sweep, zorder=2)
    if front:
        axes.plot([p["seconds"] for p in front], [p["error"] for p in front], "o", markersize=9,
                  markerfacecolor="none", markeredgecolor=ink, markeredgewidth=0.9, zorder=3,
                  linestyle="none")
    errors = [p["error"] for p in points]
    if law := found["law"]:
        ends = (law["from_error"], law["to_error"])
        axes.plot([law["seconds_at_1"] * error ** -law["exponent"] for error in ends], ends, "--",
                  color=ink, alpha=0.6, linewidth=1, zorder=1,
                  label=f"halving costs {law['halving_costs']:.2f} times")
    if found["truth_error"]:
        errors_shown = [*errors, found["truth_error"]]
        axes.axhline(found["truth_error"], color=ink, alpha=0.5, linewidth=0.9, linestyle=":",
                     label="the truth's own error")
    else:
        errors_shown = errors
    axes.set_xscale("log")
    axes.set_yscale("log")
    log_axis(axes.xaxis, [p["low"] for p in points] + [p["high"] for p in points])
    log_axis(axes.yaxis, errors_shown)
    axes.set_xlabel(found["label"])
    axes.grid(color=ink, alpha=0.1, linewidth=0.6)
    axes.set_axisbelow(True)


def draw(pyplot, panels, ink):
    """A figure of one or more panels side by side, for the same settings against other seconds."""
    figure, all_axes = pyplot.subplots(1, len(panels), figsize=(4.3 * len(panels), 4.0),
                                       sharey=True, squeeze=False)
    figure.subplots_adjust(left=0.62 / (4.3 * len(panels)), right=0.985, top=0.97, bottom=0.235,
                           wspace=0.07)
    for axes, found in zip(all_axes[0], panels):
        panel(axes, found, ink)
    all_axes[0][0].set_ylabel("error, levels of 255 (RMS)")
    handles, labels = all_axes[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, fontsize=8.5, loc="lower center", ncol=4)
    return figure
