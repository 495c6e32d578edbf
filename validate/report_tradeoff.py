"""A tradeoff.json as the page shows it: its numbers, its front, what was left out."""

from report_text import (
    NONE, at, command, count, fixed, listing, mapping, number, rounded, text, texts)


def median_of(row, key):
    return number(at(row, f"{key}_seconds", "median"))


def points_of(data, key):
    """What a plot of error against `key` (cpu, wall) seconds shows."""
    points = []
    for row in listing(at(data, "rows")):
        seconds, error = median_of(row, key), number(at(row, "against_truth", "rms"))
        if not seconds or not error or seconds <= 0 or error <= 0:
            continue
        low, high = (number(at(row, f"{key}_seconds", end)) for end in ("low", "high"))
        points.append({"name": text(at(row, "name"), "?"), "sweep": text(at(row, "sweep"), "?"),
                       "seconds": seconds, "error": error,
                       "low": min(seconds, low) if low and low > 0 else seconds,
                       "high": max(seconds, high) if high else seconds})
    return points


LAW = ("seconds_at_1", "exponent", "halving_costs", "from_error", "to_error")


def law_of(data, key):
    law = {part: number(at(data, "front", key, "law", part)) for part in LAW}
    positive = [law[part] for part in LAW if part != "exponent"]
    return law if None not in law.values() and min(positive) > 0 else None


def panels_of(data):
    """For tradeoff_plot.draw; empty where nothing was measured."""
    panels = [{"points": points_of(data, key), "front": texts(at(data, "front", key, "settings")),
               "law": law_of(data, key) if key == "cpu" else None,
               "truth_error": number(at(data, "truth", "error")), "label": label}
              for key, label in (("cpu", "CPU seconds"), ("wall", "wall seconds"))]
    return [found for found in panels if found["points"]]


def spread_of(row, key):
    low, high = (number(at(row, f"{key}_seconds", end)) for end in ("low", "high"))
    return "" if low is None or high is None or low == high else f"{low:.2f}..{high:.2f}"


def error_of(found):
    if found is None:
        return NONE
    return "identical" if at(found, "identical") is True else rounded(at(found, "rms"))


def row_of(row, front):
    identical = at(row, "against_truth", "identical") is True
    notes = ["another picture each time"] if at(row, "varies") is True else []
    if text(at(row, "failure")):
        notes.append(row["failure"])
    return {"what": text(at(row, "what"), text(at(row, "name"), "?")),
            "sweep": text(at(row, "sweep"), "?"), "front": text(at(row, "name")) in front,
            "cpu": fixed(median_of(row, "cpu"), 2), "cpu_spread": spread_of(row, "cpu"),
            "wall": fixed(median_of(row, "wall"), 2), "wall_spread": spread_of(row, "wall"),
            "error": error_of(at(row, "against_truth")),
            "ssim": NONE if identical else fixed(at(row, "against_truth", "ssim"), 5),
            "serial": error_of(at(row, "against_serial")), "notes": "; ".join(notes),
            "command": text(at(row, "command"), "")}


def truth_text(data):
    truth = mapping(at(data, "truth"))
    if not truth:
        return None
    share = number(at(truth, "share_of_best"))
    parts = [f"Truth: {count(at(truth, 'samples_per_pixel'))} samples a pixel"]
    parts.append("averaged in linear light" if at(data, "averaging") == "linear" else
                 "averaged in encoded values")
    own = f"its own error is {rounded(at(truth, 'error'))} levels of 255"
    if share is not None:
        own += f", {100 * share:.0f} % of the best setting’s"
    if stopped := text(at(truth, "stopped")):
        own += f" ({stopped})"
    return f"{', '.join(parts)}; {own}."


def problems_of(data):
    """[(verdict, line)] of what a tradeoff.json tells itself."""
    if at(data, "complete") is False:
        why = text(at(data, "failure"))
        yield "incomplete", "not complete" + (f": {why}" if why else "")
    for row in listing(at(data, "rows")):
        if text(at(row, "failure")):
            yield "failed", f"{text(at(row, 'name'), '?')}: {row['failure']}"


def facts_of(data):
    """All of the section's text and numbers; pictures are the caller's."""
    front = set(texts(at(data, "front", "cpu", "settings")))
    rows = listing(at(data, "rows"))
    image = mapping(at(data, "image"))
    size = (f"{count(at(image, 'width'))} × {count(at(image, 'height'))} pixels; " if image else "")
    return {"size": size, "arguments": command(texts(at(data, "arguments"))),
            "rows": [row_of(row, front) for row in rows], "truth": truth_text(data),
            "sentence": text(at(data, "sentence")), "notes": texts(at(data, "notes")),
            "left_out": [(text(at(one, "what"), "?"), text(at(one, "why"), "?"))
                         for one in listing(at(data, "left_out"))],
            "picks": [{"limit": f"{text(at(pick, 'limit'), '?')} {rounded(at(pick, 'value'))}",
                       "command": text(at(pick, "command"))}
                      for pick in listing(at(data, "picks"))]}
