#!/usr/bin/env python3
"""One self-contained HTML page out of the results of mpipov-validate.

    report.py INPUT.json --output PAGE.html

INPUT.json is what the subcommand `report` collected: {"root", "entries": [{"kind": seams | speedup
| noise | tradeoff | stability, "file", "folder", "problems": [text], "data": object | null}]}. Whatever the results lack,
a page is written that says so. Names and messages in them are not trusted: they are escaped, and
pictures are read from below the results' own folder only.
"""

import argparse
import datetime
import functools
import json
import os
import pathlib
import sys

import jinja2

sys.dont_write_bytecode = True
import report_plots as plots  # noqa: E402
import report_stability  # noqa: E402
import report_tradeoff  # noqa: E402
from report_cases import VERDICTS, severity  # noqa: E402
from report_images import Unreadable, data_uri  # noqa: E402
from report_scenes import noise_of, scene_view  # noqa: E402
from report_text import (  # noqa: E402
    NONE, at, count, listing, number, plural, rounded, text, texts, whole)


def hopeless_scene(entry, problem):
    """Of a file that passed all checks and still cannot be shown."""
    return scene_view({**entry, "data": None,
                       "problems": [*texts(at(entry, "problems")),
                                    f"cannot be shown: {type(problem).__name__}: {problem}"]})


def scenes_of(entries):
    scenes = []
    for entry in entries:
        if at(entry, "kind") != "seams":
            continue
        try:
            scene = scene_view(entry)
        except Exception as problem:  # one scene less is no reason for no page
            scene = hopeless_scene(entry, problem)
        if not scene["title"]:
            scene["title"] = pathlib.PurePath(text(at(entry, "folder"), "?")).name
        scenes.append(scene)
    scenes.sort(key=lambda s: (s["ok"], s["failed_whole"] is None, s["title"]))
    for index, scene in enumerate(scenes):
        scene["id"] = f"scene-{index + 1}"
        for number, group in enumerate(scene["groups"], 1):
            group["id"] = f"{scene['id']}-{number}"
            for view in group["views"]:
                view["anchor"] = group["id"]
    return scenes


def table_of(scenes, others):
    """Rows of the table over all: what failed as a whole, then cases, failures first."""
    rows = [{"scene": result, "case": None, "mark": VERDICTS[result["failed_whole"]]}
            for result in [*scenes, *others] if result["failed_whole"]]
    cases = [{"scene": scene, "case": view} for scene in scenes for view in scene["views"]]
    cases.sort(key=lambda row: severity(row["case"])[:3])  # else by scene, then as in it
    return rows + cases


def tally_of(rows):
    verdicts = [row["case"]["verdict"] if row["case"] else row["scene"]["failed_whole"]
                for row in rows]
    return [(verdict, VERDICTS[verdict], verdicts.count(verdict)) for verdict in VERDICTS
            if verdict in verdicts]


def view_of(entry, index):
    """Of a result that compares no cases. As of a scene, `failed_whole` says what is wrong."""
    kind, problems = at(entry, "kind"), texts(at(entry, "problems"))
    return {"id": f"{kind}-{index}", "file": at(entry, "file"),
            "title": text(at(entry, "data", "scene"), at(entry, "file")),
            "problems": problems, "failure": None, "failed_whole": "damaged" if problems else None}


def speedup_plot_of(rows):
    """Speed-up against serial by ranks, a curve for each way to render; None without any."""
    curves = {}
    for row in rows:
        ranks, found = whole(at(row, "ranks")), number(at(row, "speedup"))
        if ranks is None or ranks < 1 or found is None or at(row, "kind") == "serial":
            continue
        low, high = (number(at(row, key)) for key in ("speedup_low", "speedup_high"))
        point = (ranks, found, min(found, found if low is None else low),
                 max(found, found if high is None else high))
        curves.setdefault(text(at(row, "what"), "?"), []).append(point)
    if not curves:
        return None
    return plots.speedup_by_ranks([(what, sorted(points)) for what, points in curves.items()])


def image_note(row):
    """Whether the image was the serial one."""
    if at(row, "identical") is True:
        return "identical"
    differing = count(at(row, "differing"))
    return f"{differing} pixels differ" if at(row, "identical") is False else NONE


def speedup_spread(row):
    low, high = at(row, "speedup_low"), at(row, "speedup_high")
    return "" if number(low) is None or number(high) is None else f"{rounded(low)}..{rounded(high)}"


def found_wrong(data):
    """[(verdict, line)] of what a speedup.json tells itself."""
    rows = listing(at(data, "rows"))
    if at(data, "complete") is False:
        why = text(at(data, "failure"))
        yield "incomplete", "not complete" + (f": {why}" if why else "")
    for row in rows:
        name = text(at(row, "name"), "?")
        if text(at(row, "failure")):
            yield "failed", f"{name}: {at(row, 'failure')}"
        # Of POV-Ray's own threads and of bands nothing is promised.
        if (at(row, "kind") == "mpipov" and at(row, "identical") is False
                and at(data, "order_dependent") is False):
            yield "differs", f"{name}: the image is not the serial one"


def speedup_of(entry, index):
    rows = listing(at(entry, "data", "rows"))
    view = view_of(entry, index)
    for verdict, line in found_wrong(at(entry, "data")):
        view["failed_whole"] = view["failed_whole"] or verdict
        view["problems"].append(line)
    return {**view, "plot": speedup_plot_of(rows),
            "rows": [{"what": text(at(row, "what"), "?"), "ranks": count(at(row, "ranks")),
                      "image": image_note(row),
                      "spread": speedup_spread(row),
                      **{key: rounded(at(row, key)) for key in (
                          "median_seconds", "low", "high", "speedup", "efficiency")}}
                     for row in rows]}


def noise_page_of(entry, index):
    return {**view_of(entry, index), "noise": noise_of(at(entry, "data", "noise"))}


def tradeoff_crops_of(entry):
    """The front's pictures side by side, or why there are none."""
    import tradeoff_crops
    try:
        labelled, (x0, y0, x1, y1) = tradeoff_crops.crops_of(text(at(entry, "folder"), "."),
                                                            at(entry, "data"))
    except Unreadable as problem:
        return [], str(problem)
    where = f"x {x0}..{x1 - 1}, y {y0}..{y1 - 1}"
    return [{"src": data_uri(pixels), "label": label, "where": where, "width": x1 - x0,
             "height": y1 - y0} for label, pixels in labelled], None


def tradeoff_of(entry, index):
    data, view = at(entry, "data"), view_of(entry, index)
    for verdict, line in report_tradeoff.problems_of(data):
        view["failed_whole"] = view["failed_whole"] or verdict
        view["problems"].append(line)
    panels = report_tradeoff.panels_of(data)
    crops, no_crops = tradeoff_crops_of(entry) if panels else ([], None)
    return {**view, **report_tradeoff.facts_of(data), "crops": crops, "no_crops": no_crops,
            "plot": plots.error_by_seconds(panels) if panels else None}


def stability_of(entry, index):
    data, view = at(entry, "data"), view_of(entry, index)
    for verdict, line in report_stability.problems_of(data):
        view["failed_whole"] = view["failed_whole"] or verdict
        view["problems"].append(line)
    return {**view, **report_stability.facts_of(data, text(at(entry, "folder"), "."))}


def headline(rows, bad, others):
    """others: {what: its views}"""
    if bad:
        good_others = sum(not view["failed_whole"] for views in others.values() for view in views)
        return f"{bad} of {len(rows) + good_others} results to look at"
    if rows:
        return (f"All {len(rows)} cases are as they should be" if len(rows) > 1 else
                "The case is as it should be")
    measured = [plural(len(views), what) for what, views in others.items() if views]
    return f"{' and '.join(measured)} measured" if measured else "No scene was compared"


@functools.cache
def template():
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(pathlib.Path(__file__).parent), autoescape=True,
        undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    return environment.get_template("report.html.j2")


def page_of(request):
    entries = listing(at(request, "entries"))
    scenes = scenes_of(entries)
    speedups, noises, tradeoffs, stabilities = ([view(entry, index) for index, entry in enumerate(
        (entry for entry in entries if at(entry, "kind") == kind), 1)]
        for kind, view in (("speedup", speedup_of), ("noise", noise_page_of),
                             ("tradeoff", tradeoff_of), ("stability", stability_of)))
    others = {"speed-up": speedups, "noise floor": noises, "trade-off": tradeoffs,
              "conditioning": stabilities}
    rows = table_of(scenes, [view for views in others.values() for view in views])
    bad = sum(not (row["case"] and row["case"]["ok"]) for row in rows)
    return template().render(
        scenes=scenes, rows=rows, tally=tally_of(rows),
        bad=bad, headline=headline(rows, bad, others),
        speedups=speedups, noises=noises, tradeoffs=tradeoffs, stabilities=stabilities,
        versions=sorted({(s["mpipov"], s["povray"]) for s in scenes
                         if s["mpipov"] and s["povray"]}),
        made=datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC"),
        root=text(at(request, "root"), "?")).lstrip()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("input", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    options = parser.parse_args()
    try:
        page = page_of(json.loads(options.input.read_text()))
        part = options.output.with_name(options.output.name + ".part")
        part.write_text(page, encoding="utf-8", errors="replace")
        os.replace(part, options.output)
    except OSError as error:
        print(f"cannot write '{options.output}': {error.strerror}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
