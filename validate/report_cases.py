"""One case of a seams.json as the page shows it: its verdict, its numbers, how to repeat it."""

import json
import re

from report_images import Unreadable, inside
from report_text import (at, command, count, fixed, listing, mapping, number, plural, rounded,
                         seam_place, seconds, text, texts, whole)

# What differs, and may: seams that promise no more.
EXPECTED = "differs as expected"
# Verdicts, worst first: how they are marked besides their colour.
VERDICTS = {"damaged": "✕", "failed": "✕", "incomplete": "…", "differs": "≠", "beyond noise": "!",
            "no verdict": "?", EXPECTED: "≠", "ill-conditioned": "∿", "within noise": "≈", "identical": "="}
GOOD = (EXPECTED, "ill-conditioned", "within noise", "identical")


def fits(verdict, comparison):
    """Whether the numbers say what the verdict does."""
    identical, differing = at(comparison, "identical"), number(at(comparison, "differing"))
    return (identical is True and differing == 0 if verdict == "identical" else
            identical is False and differing is not None and differing > 0)


def verdict_of(case):
    if text(at(case, "failure")):
        return "failed"
    found = text(at(case, "verdict", "verdict"))
    if not fits(found, at(case, "comparison")):
        return "no verdict"
    if found == "differs" and at(case, "verdict", "ok") is True:
        return EXPECTED
    return found if found in VERDICTS else "no verdict"


def is_ok(case):
    return at(case, "verdict", "ok") is True and verdict_of(case) in GOOD


def has_infinite_psnr(comparison):
    reason = text(at(comparison, "psnr_reason"))
    return reason.startswith("infinite") if reason else at(comparison, "identical") is True


def largest_of(comparison):
    largest = at(comparison, "largest")
    signed = stored(comparison, "largest")
    if signed is None:
        return None
    return {"value": abs(signed), "shown": rounded(abs(signed)), "a": rounded(at(largest, "a")),
            "b": rounded(at(largest, "b")), "x": whole(at(largest, "x")),
            "y": whole(at(largest, "y")), "channel": text(at(largest, "channel"), "?")}


def recorded_command(folder, case):
    """What was run, out of its record, or None."""
    name = text(at(case, "run"))
    if not name:
        return None
    try:
        found = texts(at(json.loads(inside(folder, name).read_text()), "command"))
    except (OSError, ValueError, RecursionError, Unreadable):
        return None
    return found or None


def reproduce(folder, data, case):
    """The command lines that make and judge the case again."""
    argv = recorded_command(folder, case)
    if argv is None:
        argv = ["mpipov"]
        for option in ("schedule", "shape", "sections"):
            if isinstance(at(case, option), (str, int)):
                argv += [f"--{option}", at(case, option)]
        if seams := text(at(case, "seams")):
            halo = whole(at(case, "halo"))
            argv += ["--seams", f"halo:{halo}" if seams == "halo" and halo else seams]
        arguments = texts(at(data, "arguments"))
        file = text(at(data, "file")) or text(at(data, "scene"), "SCENE")
        argv += arguments if file in arguments else [file, *arguments]
    ranks = whole(at(case, "ranks"))
    lines = [command((["mpiexec", "-n", ranks] if ranks else []) + argv)]
    serial = text(at(data, "references", text(at(case, "reference"), ""), "image"))
    if serial and text(at(case, "image")):
        run = ["--run", case["run"]] if text(at(case, "run")) else []
        lines.append(command(["mpipov-validate", "compare", serial, case["image"], *run]))
    return lines


def self_check_text(check):
    seams, checked = (whole(at(check, key)) for key in ("seams", "checked"))
    if seams is None:
        return None
    if not checked:
        return f"none: no overlap was rendered at {plural(seams, 'seam')}"
    return (f"{count(checked)} of {plural(seams, 'seam')} checked, "
            f"{count(at(check, 'disagreed'))} disagreed, "
            f"{count(at(check, 'repaired'))} rendered again; against the serial render "
            f"{count(at(check, 'would_catch'))} differ")


def pixel_test_text(test):
    if not isinstance(test, dict):
        return None
    place = at(test, "at")
    where = "" if not place else (
        f" (x {count(at(place, 'x'))}, y {count(at(place, 'y'))}, channel "
        f"{text(at(place, 'channel'), '?')}: {rounded(at(place, 'value'))} where serial renders "
        f"give {rounded(at(place, 'mean'))} ± {rounded(at(place, 'sigma'))})")
    return (f"{count(at(test, 'beyond'))} of {count(at(test, 'samples'))} beyond "
            f"z = {rounded(at(test, 'critical_z'))}; largest z = {rounded(at(test, 'largest_z'))}"
            f"{where}; {plural(whole(at(test, 'renders')) or 0, 'noise render')}, "
            f"α = {rounded(at(test, 'alpha'))} over all pixels")


def step_test_text(test):
    if not isinstance(test, dict):
        return None
    parts = [f"{count(at(test, 'beyond'))} beyond a score of {rounded(at(test, 'critical'))}",
             f"largest score {rounded(at(test, 'largest'))}"]
    if at(test, "line"):
        parts[-1] += f" at {seam_place(at(test, 'line'))}"
    if number(at(test, "step")) is not None:
        parts[-1] += (f", where the step is {rounded(at(test, 'step'))} and serial renders give "
                      f"{rounded(at(test, 'expected'))}")
    if together := mapping(at(test, "together")):
        parts.append(f"all seams together {rounded(at(together, 'mean'))} against "
                     f"{rounded(at(together, 'expected'))}, score {rounded(at(together, 'z'))}, "
                     f"allowed {rounded(at(together, 'critical'))}")
    parts.append(f"{plural(whole(at(test, 'renders')) or 0, 'noise render')}, "
                 f"α = {rounded(at(test, 'alpha'))}")
    return "; ".join(parts)


def quiet_text(quiet):
    if whole(at(quiet, "renders")) is None:
        return None
    return (f"the same tests raise an alarm at {count(at(quiet, 'alarms'))} of "
            f"{plural(whole(at(quiet, 'renders')), 'serial render')}, each judged by the others")


def stored(comparison, key):
    """A number that compare gives in levels and as part of full scale, in stored units."""
    levels = number(at(comparison, key, "levels"))
    return levels if levels is not None else number(at(comparison, key, "full_scale"))


def layout_text(case):
    sections, ranks = whole(at(case, "sections")), whole(at(case, "ranks"))
    parts = [sections and f"{sections} {text(at(case, 'shape'), 'sections')}",
             text(at(case, "seams")), text(at(case, "schedule")), ranks and plural(ranks, "rank")]
    return " · ".join(part for part in parts if part)


def error_text(comparison):
    mean, rms = stored(comparison, "mean_abs"), stored(comparison, "rms")
    if mean is None:
        return None
    return f"{rounded(mean)} {text(at(comparison, 'unit'), 'level')}s, RMS {rounded(rms)}"


def step_text(step):
    seams, controls = at(step, "seams"), at(step, "controls")
    if not seams:
        return None
    return (f"{rounded(at(seams, 'mean_step'))} at "
            f"{plural(whole(at(seams, 'lines')) or 0, 'seam')}, "
            f"{rounded(at(controls, 'mean_step'))} at "
            f"{plural(whole(at(controls, 'lines')) or 0, 'control line')} inside sections; locally "
            f"{rounded(at(seams, 'local_step'))} and {rounded(at(controls, 'local_step'))}")


def facts_of(case, comparison):
    """[(what, text)] that the table does not hold."""
    no_ssim = number(at(comparison, "ssim", "value")) is None
    identical = at(comparison, "identical") is True
    facts = [("layout", layout_text(case)),
             ("mean difference", error_text(comparison)),
             ("step across a seam", step_text(at(comparison, "run", "step"))),
             ("pixels against noise", pixel_test_text(at(case, "verdict", "pixel_test"))),
             ("steps against noise", step_test_text(at(case, "verdict", "step_test"))),
             ("false alarms", quiet_text(at(case, "verdict", "quiet"))),
             ("neighbours’ self-check", self_check_text(at(case, "self_check"))),
             ("PSNR", None if identical else text(at(comparison, "psnr_reason"))),
             ("SSIM", text(at(comparison, "ssim", "reason")) if no_ssim else None)]
    return [(what, value) for what, value in facts if value]


def case_view(folder, data, case):
    """All of it is text or numbers; `sort` holds what the table's columns sort by."""
    case = mapping(case)
    comparison = mapping(at(case, "comparison"))
    verdict = verdict_of(case)
    largest = largest_of(comparison)
    step = at(comparison, "run", "step")
    pixels, differing = (number(at(comparison, key)) for key in ("pixels", "differing"))
    view = {
        "anchor": None,
        "name": text(at(case, "name"), "unnamed case"), "verdict": verdict,
        "mark": VERDICTS[verdict], "ok": is_ok(case), "why": text(at(case, "verdict", "why")),
        "failure": text(at(case, "failure")),
        "differing": count(differing),
        "share": f"{100 * differing / pixels:.2g} %" if pixels and differing else None,
        "largest": largest, "no_error": has_infinite_psnr(comparison), "unit": text(at(comparison, "unit"), "level"),
        "ssim": fixed(at(comparison, "ssim", "value"), 5),
        "psnr": "∞" if has_infinite_psnr(comparison) else fixed(at(comparison, "psnr"), 1),
        "step": rounded(at(step, "seams", "mean_step")),
        "controls": rounded(at(step, "controls", "mean_step")),
        "seconds": seconds(at(case, "seconds")),
        "facts": facts_of(case, comparison),
        "reproduce": reproduce(folder, data, case),
    }
    view["sort"] = {
        "verdict": list(VERDICTS).index(verdict), "differing": differing,
        "largest": largest and largest["value"], "ssim": number(at(comparison, "ssim", "value")),
        "psnr": 1e9 if has_infinite_psnr(comparison) else number(at(comparison, "psnr")),
        "step": number(at(step, "seams", "mean_step")), "seconds": number(at(case, "seconds"))}
    return view


def severity(view):
    """Worst first, then by name, numbers in it by their value."""
    name = [(int(part) if part.isdecimal() else 0, part)
            for part in re.split(r"(\d+)", view["name"])]
    return view["ok"], view["sort"]["verdict"], -(view["sort"]["differing"] or 0), name


def curve_of(case):
    """([(distance, mean difference on both sides of the seams)], farther away | None)."""
    points = []
    for entry in listing(at(case, "comparison", "run", "by_distance")):
        sides = [at(entry, side) for side in ("before", "after")]
        known = [(number(at(s, "pixels")), number(at(s, "mean_abs"))) for s in sides]
        known = [(n, mean) for n, mean in known if n and mean is not None]
        distance = number(at(entry, "distance"))
        if known and distance is not None:
            points.append((distance, sum(n * m for n, m in known) / sum(n for n, _ in known)))
    return points, number(at(case, "comparison", "run", "interior", "mean_abs"))
