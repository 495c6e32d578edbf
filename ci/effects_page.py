"""docs/effects.md, from the verdicts of ci/effects."""


from markdown_table import table as markdown_table


HOW = [
    ("antialiasing", "POV-Ray's options as it resolved them",
     "the small render against the same with -A, by the cost model"),
    ("radiosity", "\"Radiosity Time\" is printed",
     "that time of the small render, which every launch takes again; what it takes in tracing is "
     "told beside it"),
    ("photons", "\"Photon Time\" is printed", "as radiosity"),
    ("media", "Media Samples", "+Q9 against +Q8"),
    ("reflection", "Reflected Rays", "+Q8 against +Q6 (bumps of normals too)"),
    ("transparency", "Refracted and Transmitted Rays", "+Q6 against +Q5"),
    ("area_light", "Shadow Ray Tests differ between +Q5 and +Q4", "+Q5 against +Q4"),
    ("focal_blur", "more rays than pixels at +Q4, where no others are traced",
     "all but one ray of each pixel"),
    ("subsurface", "rays or Shadow Ray Tests differ between +Q9 and +Q8, and no other effect of "
     "+Q9 is on; else it is left out", "+Q9 against +Q8"),
    ("isosurface", "Isosurface roots", "not known: POV-Ray has no switch that leaves them out"),
    ("order_dependent", "the same small render in three block orders", "none of tracing: launches "
     "have one thread and a fixed grid"),
    ("render", "", "tracing all: the small render by area and antialiasing"),
]

HOW_TEXT = """All by numbers that POV-Ray prints of small renders of the whole picture, never by the scene's text.
*Counters* are those of its statistics. What an effect costs is the difference of the trace times of
two renders without antialiasing, one of which has the effect, scaled to the whole render: their part
of the small render, times what the cost model expects of the render. So effects and antialiasing
together are never more than the render. What antialiasing takes more includes the effects in its
samples; photons and radiosity are timed before tracing and are not part of `render`.

A difference of less than a tick of POV-Ray's clock (1 ms) and 5 % of the small render is not told:
the cost is null, and `why` says how much it may be. So it is where media, photons and radiosity
meet, between which POV-Ray has no level, and for isosurfaces. An effect that is off costs 0.

The renders at +Q4, +Q5, +Q6 and +Q8 come after the probe, and only with `--dry-run` or where they
take less than 1 % of the predicted wall time, in the size of the probe's or in half of it (from about
45 s on two cores; 0.32 s of them is POV-Ray's start-up). A short run is not made longer: its
`run.json` has no `area_light`, `focal_blur` and `subsurface`, since nobody asked (leaving them out
says that; `"on": false` would not be true), and the costs of the others but antialiasing are null.
With `--dry-run` they are larger than the probe's where those are over within 0.1 s. The plan itself
is the probe's alone: a dry run plans what the run does.

Fog, bumps of normals and crand have neither a counter nor a level of their own, so mpipov has no
name for them; that crand makes pixels depend on the order is found as such.

The three renders in other orders and sizes of blocks are the renders of the same region that differ
only in what was traced before. They are three because two are not enough: where random numbers are
drawn in few blocks, one other order may leave those as they were ([povray.md](povray.md)).

What it saves to follow the plan: [savings.md](savings.md).
"""


def words(names):
    return ", ".join(sorted(names)) or "-"


def found_of(verdict):
    """Each with what it costs, where that is told."""
    said = []
    for name, effect in sorted(verdict.found.items()):
        if effect["on"]:
            cost = effect["cpu_seconds"]
            said.append(name if cost is None else f"{name} {cost:.2g}")
    return ", ".join(said) or "-"


def row(verdict):
    scene = verdict.scene
    known = [f"{name} (known)" for name in verdict.known]
    return (scene.name, words(scene.effects), f"{verdict.render:.2g}", found_of(verdict),
            words(verdict.missed + known), words(verdict.vain))


def table(verdicts):
    return markdown_table(("scene", "called for", "render", "found, with its CPU s", "missed",
                           "found in vain"), map(row, verdicts))


def by_effect(verdicts):
    rows = []
    for name in sorted({name for verdict in verdicts for name in verdict.found}):
        called = [verdict for verdict in verdicts if name in verdict.scene.effects]
        missed = sum(name in verdict.missed + verdict.known for verdict in called)
        vain = sum(name in verdict.vain for verdict in verdicts)
        rows.append((name, len(called), len(called) - missed, missed, vain))
    return markdown_table(("effect", "scenes that call for it", "found there", "missed",
                           "found in vain"), rows)


def explained(verdicts):
    """Each miss and each find in vain, with what mpipov gives as its reason."""
    lines = []
    for verdict in verdicts:
        lines += [f"- {line}" for line in verdict.lines()]
    return lines or ["None."]


def unnamed(verdicts):
    counts = {}
    for verdict in verdicts:
        for name in verdict.unnamed:
            counts[name] = counts.get(name, 0) + 1
    return ", ".join(f"{name} ({count})" for name, count in sorted(counts.items()))


def notes(verdicts):
    return [f"- {verdict.scene.name}: {verdict.scene.note}" for verdict in verdicts
            if verdict.scene.note]


def page(parts, totals, size, costs):
    """Of {heading: verdicts}."""
    everything = [verdict for verdicts in parts.values() for verdict in verdicts]
    width, height = (option[2:] for option in size)
    lines = [
        "# What mpipov finds in a scene, and what it should find", "",
        "Made by `ci/effects table`: `mpipov --dry-run` of every scene of our own, with the",
        "options of `scenes/scenes.json`, of the examples of Debian's that",
        "`scenes/debian_effects.json` lists, and of scenes whose effect is small",
        f"(`ci/small_effects.py`), {width} x {height} pixels: the probe renders 32 x 24. What a",
        "scene calls for was written down by hand, from its text. The tests `effects.*` compare",
        "the same, and fail where an effect is missed that is not known to be.",
        "", f"{totals(everything)}.", "",
        by_effect(everything), "",
        "Called for, but without a name in mpipov's answer, with the number of scenes:", "",
        f"{unnamed(everything)}.", "",
        "Those of them that make pixels depend on the order of rendering are answered as",
        "order_dependent.", "",
        "## How each is found and what it costs", "",
        markdown_table(("effect", "found by", "its cost"), HOW), "", HOW_TEXT, *costs, "",
        "## Not as expected", "", *explained(everything), ""]
    for heading, verdicts in parts.items():
        lines += [f"## {heading}", "", f"{totals(verdicts)}.", "", table(verdicts), ""]
    return "\n".join([*lines, "## Notes on the scenes", "", *notes(everything)]) + "\n"
