"""docs/speed.md out of the records of speed.py: what is said there, its bars and its tables."""

import shlex
from pathlib import Path
from statistics import median

from markdown_table import table

WITHIN = 0.1  # of the simulator
# Where two threads of POV-Ray gain less, the second core was not free, and nothing can be said.
LEAST_GAIN = 1.6

# Case, what is divided by what (its rows), how much at most, in words.
RATIOS = (
    ("benchmark", "mpipov-dynamic-2", "threads-2", 1.02, "benchmark.pov: of `povray +WT2`"),
    ("corner", "mpipov-dynamic-2", "threads-2", 1.00, "all the cost in one corner: of `povray +WT2`"),
    ("corner", "mpipov-dynamic-2", "bands-2", 0.75, "the same: of equal bands"),
    ("corner", "mpipov-dynamic-2", "mpipov-static-2", 0.80, "the same: of our static"),
    ("uniform", "mpipov-dynamic-2", "mpipov-static-2", 1.03, "the same cost everywhere: of our static"),
    ("uniform", "mpipov-dynamic-2", "serial", 1 / 1.85, "the same: of serial (speed-up 1.85)"),
)


def row_of(case, name):
    return next((row for row in case["rows"] if row["name"] == name), None)


def gain(case):
    serial, threads = row_of(case, "serial"), row_of(case, "threads-2")
    return serial["median_seconds"] / threads["median_seconds"]


def ratios(case, one, other):
    """Of two rows, repetition by repetition."""
    a, b = row_of(case, one), row_of(case, other)
    return [x / y for x, y in zip(a["times"], b["times"])] if a and b else []


def spread(values, digits=2):
    text = f"{median(values):.{digits}f}"
    return f"{text} ({min(values):.{digits}f}..{max(values):.{digits}f})" if len(values) > 1 else text


def bars(found, more):
    """(words, at most, values) for each."""
    for name, one, other, most, words in RATIOS:
        if name in found and ratios(found[name], one, other):
            yield words, most, ratios(found[name], one, other)
    if "second" in found:
        case = found["second"]
        times = zip(row_of(case, "mpipov-dynamic-2")["times"], row_of(case, "threads-2")["times"])
        yield "a scene of a second: seconds more than `povray +WT2`", 0.5, [a - b for a, b in times]
    if "in_flight" in more:
        seconds = more["in_flight"]["seconds"]
        yield ("16 sections of a trivial scene on one core: of one after another", 0.4,
               [a / b for a, b in zip(seconds["auto"], seconds["1"])])


def missed(found, more):
    return [words for words, most, values in bars(found, more) if median(values) > most]


def bar_table(found, more):
    rows = [(words, f"{most:.2f}", spread(values), "yes" if median(values) <= most else "**no**")
            for words, most, values in bars(found, more)]
    return table(("two ranks, wall time", "at most", "measured", "met"), rows)


def case_section(name, case):
    options = shlex.join(case["arguments"][1:])
    rows = []
    for row in case["rows"]:
        if row["failure"]:
            rows.append((row["what"], row["failure"], "", "", ""))
            continue
        pixels = "the serial ones" if row["identical"] else f"{row['differing']} differ"
        rows.append((row["what"].replace("+WTn", "+WT2"),
                     f"{row['median_seconds']:.2f} ({row['low']:.2f}..{row['high']:.2f})",
                     f"{row['speedup']:.2f} ({row['speedup_low']:.2f}..{row['speedup_high']:.2f})",
                     f"{row['efficiency']:.2f}", pixels))
    # The processors of a row are in its number: 1 for serial, else 2.
    lines = [f"### {name}: {Path(case['file']).name} {options}", "",
             f"{case['repeat']} repetition{'s' * (case['repeat'] > 1)}.", ""]
    if gain(case) < LEAST_GAIN and name != "second":
        lines += [f"**Void**: two threads of POV-Ray were only {gain(case):.2f} times as fast as one, "
                  "so the second core was not free.", ""]
    lines.append(table(("2 processors but for serial", "seconds", "speed-up", "efficiency", "pixels"),
                       rows))
    return "\n".join(lines)


def in_flight_section(found):
    return "\n".join([
        "## Many small sections", "",
        f"{found['sections']} sections of a sphere, 160x120, one rank on one core, first start to last "
        f"end. `--in-flight auto` chooses {found['chosen']}.", "",
        table(("launches under way", "seconds"),
              [(name, spread(values)) for name, values in found["seconds"].items()])])


FROM = {"1-1": "1, from its own record", "1-2": "2, from the record of the run on 1",
        "2-2": "2, from its own record"}


def simulation_section(found):
    rows, worst = [], dict.fromkeys(FROM, 0)
    for entry in found:
        for key, words in FROM.items():
            turns = [turn[key] for turn in entry["turns"]]
            errors = [turn["said"] / turn["measured"] - 1 for turn in turns]
            worst[key] = max(worst[key], abs(median(errors)))
            rows.append((f"{entry['scene']} {' '.join(entry['arguments'])}", words,
                         spread([turn["said"] for turn in turns]),
                         spread([turn["measured"] for turn in turns]),
                         spread([turn["cpu_seconds"] for turn in turns]),
                         f"{100 * median(errors):+.1f} %"))
    verdicts = "; ".join(
        f"{words}: {100 * worst[key]:.1f} %, {'within' if worst[key] <= WITHIN else '**not** within'} "
        f"{100 * WITHIN:.0f} %" for key, words in FROM.items())
    return "\n".join([
        "## What the simulator says of it", "",
        "`mpipov-validate simulate` from a run's record, 16 tiles, ranks of one core. In each turn a run on "
        "one rank and one on two; the error is that of a turn, the median of the turns. A record on one "
        "rank cannot know how fast the cores are a minute later: what the same sections took in both is in "
        f"the column of CPU seconds. Largest errors, by ranks: {verdicts}.", "",
        table(("scene", "ranks", "said, s", "measured, s", "CPU s of the sections", "error"), rows)])


def page(found, more):
    any_case = next(iter(found.values()))
    host = any_case["host"]
    parts = [
        "# Speed", "",
        "Made by `ci/speed.py measure` and `ci/speed.py page`. Everything in a table was measured in "
        f"turns, in one run, on a shared virtual machine of {host['cores']} cores ({host['cpu']}); read "
        "the ratios, not the seconds. Median (smallest..largest) of the repetitions; a ratio is taken "
        "within each repetition. Times are those of a user: from the start of mpiexec to its end.", "",
        "## The bars", "", bar_table(found, more), "",
        "## Measured", "",
        "\n\n".join(case_section(name, case) for name, case in found.items()), ""]
    if "in_flight" in more:
        parts += [in_flight_section(more["in_flight"]), ""]
    if "simulation" in more:
        parts += [simulation_section(more["simulation"]), ""]
    return "\n".join([*parts, WHY])


WHY = """`benchmark.pov` takes half an hour a repetition: its record is of an earlier state, in which mpipov still
waited for POV-Ray's last 0.3 s of sleep, and which loaded OpenImageIO at the end.

## Why dynamic does not lose to static here

In 1999 handing out strips dynamically (MPIPOV2) was slower than dealing them out (MPIPOV1) everywhere:
3 instead of 6.66 times on 8 processors. Its reasons, from [simulation.md](simulation.md): its coordinator
did not render; every line of the picture waited for the last strip of it; with n + 1 strips on n ranks a
line took two rounds; each strip cost two messages. Here rank 0 renders too, no section waits for another,
sections are large against a message (25 ms against seconds), and where one host does all the work its
cores share one launch in POV-Ray's own blocks, which is as dynamic as it gets.

## Why two ranks are as fast as POV-Ray's own threads

On one host, where the pixels do not depend on the order, the plan is one launch with all cores, begun
beside the probe. What mpipov adds is the probe (its CPU seconds are in `run.json`) and starting MPI;
what it takes away is the 0.3 s that POV-Ray sleeps at its end ([povray.md](povray.md)).
"""
