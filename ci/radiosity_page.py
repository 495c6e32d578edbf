"""The tables of docs/radiosity.md, from the records that radiosity.py leaves."""

import statistics

from markdown_table import table


def verdict(case):
    if case["failure"]:
        return case["failure"]
    return case["verdict"]["verdict"]


def largest_step(case):
    found = case["verdict"].get("step_test")
    return f"{found['largest']:.1f} of {found['critical']:.1f}" if found else "-"


def cpu_seconds(case):
    return f"{case['run']['totals']['cpu_seconds']:.1f}"


def seam_rows(name, found):
    for grid in found["grids"]:
        judged = grid["judged"]
        noise = judged["noise"]["renders"]
        serial = judged["references"]["default"]["cpu_seconds"]
        means = [one["mean"] for one in noise]
        yield [name, f"{grid['sections']} {grid['shape']}", "*noise, serial*",
               f"{min(means):.2f} to {max(means):.2f}", "", "", f"{serial:.1f}"]
        for case in judged["cases"]:
            yield [name, f"{grid['sections']} {grid['shape']}", case["radiosity"],
                   f"{case['comparison']['mean_abs']['levels']:.2f}", largest_step(case),
                   verdict(case), cpu_seconds(case)]


def seams_show(found, sharing):
    return [(name, grid["shape"], grid["sections"])
            for name, parts in found.items() for grid in parts["grids"]
            for case in grid["judged"]["cases"]
            if case["radiosity"] == sharing and not case["verdict"]["ok"]]


def speed_rows(name, speed, ranks):
    serial = statistics.median(speed["seconds"]["serial"])
    for sharing, rows in speed["simulated"].items():
        seconds = speed["seconds"][sharing]
        simulated = {row["ranks"]: row["speedup"] for row in rows}
        yield [name, "x".join(map(str, speed["size"])), speed["sections"], sharing, f"{serial:.1f}",
               f"{statistics.median(seconds):.1f} ({min(seconds):.1f} to {max(seconds):.1f})",
               f"{serial / statistics.median(seconds):.2f}",
               *(f"{simulated[count]:.2f}" for count in ranks)]


def page(found, ranks):
    seams = table(["scene", "sections", "sharing", "mean difference", "largest step, sigma of allowed",
                   "verdict", "CPU s"],
                  [row for name, parts in found.items() for row in seam_rows(name, parts)])
    speed = table(["scene", "size", "sections", "sharing", "serial, s", "2 ranks, s", "speed-up measured",
                   *(f"simulated, {count}" for count in ranks)],
                  [row for name, parts in found.items() for speed in parts["speed"]
                   for row in speed_rows(name, speed, ranks)])
    return f"""## Seams

Levels of 255 against the serial render. *Noise*: what other serial renders, equally right, differ by.
The step is that of the signed error at the seam where it is most significant, in standard deviations of
what equally right renders have there, and how many of those are allowed to the largest of so many seams.
The other tests of the verdict are those of docs/seams.md. CPU seconds are of all of a run, its
probe included.

{seams}

## Speed-up

With antialiasing, on the grid that `mpipov` chooses. Median of the turns, least and most; simulated from
a run with 2 ranks against the serial render that was measured.

{speed}
"""
