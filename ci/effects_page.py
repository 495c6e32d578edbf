"""docs/effects.md, from the verdicts of ci/effects."""


from markdown_table import table as markdown_table


def words(names):
    return ", ".join(sorted(names)) or "-"


def row(verdict):
    scene = verdict.scene
    found = {name for name, effect in verdict.found.items() if effect["on"]}
    known = [f"{name} (known)" for name in verdict.known]
    return (scene.name, words(scene.effects), words(found), words(verdict.missed + known),
            words(verdict.vain))


def table(verdicts):
    return markdown_table(("scene", "called for", "found", "missed", "found in vain"),
                          map(row, verdicts))


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


def page(parts, totals, size):
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
        "## Not as expected", "", *explained(everything), ""]
    for heading, verdicts in parts.items():
        lines += [f"## {heading}", "", f"{totals(verdicts)}.", "", table(verdicts), ""]
    return "\n".join([*lines, "## Notes on the scenes", "", *notes(everything)]) + "\n"
