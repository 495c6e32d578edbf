"""docs/savings.md, from the record of savings.py."""

from statistics import median

from markdown_table import table

MEASURES = (("launches", "launches"), ("cpu_seconds", "CPU s"), ("wall_seconds", "wall s"))
TEXT = """Made by `ci/savings.py measure` and `ci/savings.py page`: {number} scenes of `scenes/effects` and, every
third, of Debian's in `scenes/debian_effects.json` (without subsurface/subsurface, which takes too long),
{width} x {height} pixels, rendered by `mpipov` and judged against a serial render. *With the plan* is what mpipov's probe says of the scene followed:
mpipov's own grid and threads; a radiosity cache, at a quarter of the size, where there is radiosity; the
noise floor and SSIM where pixels depend on the order, else one serial render, which must be met bit for
bit. *Everything on* is what is needed where nothing is known: halo seams, one thread a launch and the
pinned grid, a radiosity cache, the noise floor, SSIM. A noise floor takes 12 serial renders in other
orders (`mpipov-validate noise`), but four where those are alike.

Included with the plan is the run's probe, five small launches. Of everything on, the launches and CPU
seconds of mpipov's own small renders are taken out: who plans nothing needs only the launch that says
what the result will be; its wall time is left as it is. Each scene once each way, one after the other,
in turns. Wall seconds are those of a machine with two cores that others used too: read the ratios.
Whether the image is the serial one bit for bit is said too; that of everything on is a halo render,
whose reference is the serial render in one block, while it is compared here with the default one."""


def ratio(one, name):
    return one["plan"][name] / one["everything"][name]


def cell(value):
    return str(value) if isinstance(value, int) else f"{value:.1f}"


def row(one):
    cells = [f"{cell(one['plan'][name])} / {cell(one['everything'][name])}" for name, _ in MEASURES]
    same = " / ".join("yes" if one[way]["identical"] else "no" for way in ("plan", "everything"))
    return (one["scene"], ", ".join(one["plan"]["on"]) or "-", *cells,
            f"{ratio(one, 'cpu_seconds'):.2f}", same)


def depends_on_order(one):
    return "order_dependent" in one["plan"]["on"]


def total_rows(found):
    groups = (("all", found),
              ("pixels depend on the order", [one for one in found if depends_on_order(one)]),
              ("they do not", [one for one in found if not depends_on_order(one)]))
    for name, group in groups:
        if not group:
            continue
        sums = [f"{cell(sum(one['plan'][key] for one in group))} / "
                f"{cell(sum(one['everything'][key] for one in group))}" for key, _ in MEASURES]
        ratios = [f"{median(ratio(one, key) for one in group):.2f}" for key, _ in MEASURES]
        yield name, len(group), *sums, *ratios


def page(found, size):
    names = [name for _, name in MEASURES]
    return "\n".join([
        "# What it saves to follow the plan", "",
        TEXT.format(width=size[0], height=size[1], number=len(found)), "",
        "Sums, with the plan / everything on, and the median of the ratios of each scene.", "",
        table(("scenes", "number", *names, *(f"{name}, ratio" for name in names)),
              total_rows(found)), "",
        table(("scene", "effects that the plan says", *names, "CPU, ratio", "the serial bits"),
              map(row, found)), ""])
