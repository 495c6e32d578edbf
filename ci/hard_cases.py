#!/usr/bin/python3
"""Scenes that are hard for the arithmetic (scenes/hard): is what mpipov promises kept there too?

Every run ends within the scene's time and with 0. All runs of a group (hard_design.py) have the same
bits, whatever the ranks and schedule. Those bits are the serial render's where sections cannot be
seen: on the block grid, or without antialiasing. A halo with antialiasing comes close to it, and how
close is told. Order-dependent scenes have the same bits on the same grid. SCENE is as in
hard.coincident.

    hard_cases.py list                 the tests of the default run, as CMakeLists.txt reads them
    hard_cases.py design               do these have all pairs of values of two factors?
    hard_cases.py serial SCENE         twice the same? finite, or the places told?
    hard_cases.py group SCENE GROUP    the runs of a group that are dealt to this scene
    hard_cases.py matrix SCENE [--dealt] [--resume]
                                       the whole product, or the part of it that goes round the file
                                       types; writes hard/SCENE.json; --resume: only what is missing
    hard_cases.py record FILE...       docs/stability/hard.json of such files
    hard_cases.py summary [FILE]       a table of that

Exit codes: 0 ok, 1 a promise is not kept, 2 usage.
"""

import json
import sys
from dataclasses import replace
from pathlib import Path

import numpy
from hard_design import (Group, all_runs, cases_of, dealt_part, missing_pairs, whole_product)
from hard_record import RARE, broken, entry_of, summary_table, write_json
from image_pixels import read_image
from program_runs import (ROOT, TestFailure, argument_parser, fresh_folder, measurement,
                          programs_of, report, require_success)
from scene_list import hard_scenes, scene_named

RECORD = ROOT / "docs" / "stability" / "hard.json"
SUFFIX = {"png8": ".png", "png16": ".png", "exr": ".exr"}
# Other orders of rendering that together find every scene here whose pixels depend on the order,
# without antialiasing, which depends on where blocks end.
ORDERS = ("+RP1", "+RP3", "+BS128")


def scenes_folder(options, scene):
    return options.work / "hard" / scene.name


def largest_of(compared):
    """The largest difference, where white is 1: values of a float file as they are."""
    largest = compared["largest"]
    return abs(largest["full_scale"]) if largest else 0


def render_serially(options, scene, group, folder, name="serial", more=()):
    file = f"{name}{SUFFIX[group.type]}"
    programs_of(options).serial([*group.picture(scene), *group.serial(scene), *more, f"+O{file}"],
                                folder)
    return folder / file


def render_group(options, scene, group, runs, folder):
    """Renders and compares: what the record keeps of every run."""
    fresh_folder(folder)
    programs = programs_of(options)
    serial = render_serially(options, scene, group, folder)
    results = []
    first = None
    for run in runs:
        own = fresh_folder(folder / run.name())
        image = f"sections{SUFFIX[group.type]}"
        result = {"case": f"{group.name()}.{run.name()}"}
        try:
            done = programs.mpi(run.ranks, [*group.picture(scene), *group.cutting(scene),
                                            "--schedule", run.schedule, "--progress", "none",
                                            f"+O{image}"], own, seconds=scene.limit_seconds)
            print(done.command())
            require_success(done)
        except TestFailure as failure:
            results.append({**result, "failure": str(failure)})
            continue
        compared, _ = programs.compare(serial, own / image, own)
        record = json.loads((own / "run.json").read_text())
        sha1 = record["output"]["pixel_sha1"]
        first = first or sha1
        results.append({**result, "seconds": round(done.seconds, 2), "same_bits": sha1 == first,
                        "identical": compared["identical"], "pixels": compared["differing"],
                        "max": largest_of(compared),
                        "order_dependent": record["plan"]["effects"]["order_dependent"]["on"],
                        "sections": len(record["sections"])})
    return results


def serial_command(options):
    """EXR, which holds what other files clip: the same bits twice, finite or the places told."""
    scene = scene_named(options.scene, hard_scenes())
    folder = fresh_folder(scenes_folder(options, scene) / "serial")
    group = Group("aligned", "columns", "full", "exr", "AM1")
    images = [render_serially(options, scene, group, folder, name) for name in ("one", "two")]
    compared, text = programs_of(options).compare(*images, folder)
    print(text)
    if not compared["identical"]:
        raise TestFailure(f"{compared['differing']} pixels differ between two serial renders")
    check_orders(options, scene, replace(group, aa="off"), folder)
    found = nonfinite_of(images[0])
    told = told_places(compared)
    measurement("samples not finite", found["count"] if found else 0)
    if bool(found) != scene.not_finite:
        raise TestFailure(f"not finite: {found}, and hard.json says not_finite: "
                          f"{scene.not_finite}")
    if found != told:
        raise TestFailure(f"not finite: {found}, and mpipov-validate compare says {told}")
    return found


def check_orders(options, scene, group, folder):
    """Do pixels depend on the order of rendering just where hard.json says so?"""
    def differing(more=()):
        first = render_serially(options, scene, group, folder, "first", more)
        return [programs_of(options).compare(
            first, render_serially(options, scene, group, folder, "order", [*more, order]),
            folder)[0]["differing"] for order in ORDERS]

    pixels = differing()
    print(f"{' and '.join(ORDERS)}: {' and '.join(map(str, pixels))} pixels differ")
    if any(pixels) != (scene.order_dependent or scene.rare_pixels):
        raise TestFailure(f"hard.json says order_dependent: {scene.order_dependent}, rare_pixels: "
                          f"{scene.rare_pixels}")
    width, height = scene.size
    if scene.rare_pixels and max(pixels) * RARE > width * height:
        raise TestFailure(f"more than one pixel in {RARE}: not rare")
    if scene.exact_with and any(differing(scene.exact_with)):
        raise TestFailure(f"pixels differ with {' '.join(scene.exact_with)} too: they are due to "
                          "something else than hard.json says")


def nonfinite_of(image):
    """How many samples are infinite or no number, and the first in reading order."""
    pixels, spec = read_image(image)
    rows, columns, channels = numpy.nonzero(~numpy.isfinite(pixels))
    if not len(rows):
        return None
    return {"count": len(rows),
            "first": [int(columns[0]), int(rows[0]), spec.channelnames[channels[0]]]}


def told_places(compared):
    """The same, as `mpipov-validate compare` tells it of image A."""
    told = compared["nonfinite"]
    first = [place for place in told["first"] if place["image"] == "a"]
    if not first:
        return None
    return {"count": told["a"]["nan"] + told["a"]["infinite"],
            "first": [first[0]["x"], first[0]["y"], first[0]["channel"]]}


def group_command(options):
    scene = scene_named(options.scene, hard_scenes())
    group = Group.parse(options.name)
    runs = next((runs for one, runs in cases_of(hard_scenes(), scene) if one == group), None)
    if runs is None:
        sys.exit(f"hard_cases: no group '{options.name}' of {scene.name}: see hard_cases.py list")
    folder = scenes_folder(options, scene) / group.name()
    results = render_group(options, scene, group, runs, folder)
    for result in results:
        print(json.dumps(result))
    done = [result for result in results if "failure" not in result]
    if done:
        measurement("differing pixels", max(result["pixels"] for result in done))
        measurement("largest difference", max(result["max"] for result in done))
        measurement("wall seconds", max(result["seconds"] for result in done))
    wrong = broken(scene, group, results)
    if wrong:
        raise TestFailure("\n".join([*wrong, f"images and records are in {folder}"]))


def matrix_command(options):
    scene = scene_named(options.scene, hard_scenes())
    parts = list(dealt_part()) if options.dealt else \
        [(group, all_runs(group)) for group in whole_product()]
    file = options.work / "hard" / f"{scene.name}.json"
    kept = json.loads(file.read_text())["groups"] if options.resume and file.exists() else {}
    wrong = []
    nonfinite = serial_command(options)
    for group, runs in parts:
        name = group.name()
        if name not in kept:
            folder = scenes_folder(options, scene) / "matrix" / name
            kept[name] = render_group(options, scene, group, runs, folder)
            lines = broken(scene, group, kept[name])
            if not lines:
                fresh_folder(folder).rmdir()  # what can be looked into is what is wrong
            write_json(file, {"scene": scene.name, "dealt": options.dealt, "groups": kept,
                              "nonfinite": nonfinite})
        lines = broken(scene, group, kept[name])
        print("\n".join([f"{name}: {len(kept[name])} runs", *lines]), flush=True)
        wrong += lines
    print(f"{sum(map(len, kept.values()))} cases in {file}")
    return 1 if wrong else 0


def record_command(options):
    found = {one["scene"]: one for one in (json.loads(Path(file).read_text())
                                           for file in options.files)}
    entries = [entry_of(scene, found[scene.name]) for scene in hard_scenes()
               if scene.name in found]
    write_json(RECORD, {"format": "mpipov-hard", "version": 1, "scenes": entries})
    print(f"{len(entries)} scenes in {RECORD}")
    return 1 if any(entry["broken"] for entry in entries) else 0


def summary_command(options):
    print(summary_table(json.loads(Path(options.file).read_text())))


def design_command(_options):
    missing = missing_pairs(hard_scenes())
    if missing:
        raise TestFailure(f"no case has {missing}")


def list_command(_options):
    """One test a line: kind, scene, group, ranks."""
    scenes = hard_scenes()
    for scene in scenes:
        print(f"serial {scene.name} - 1")
        for group, runs in cases_of(scenes, scene):
            print(f"group {scene.name} {group.name()} {max(run.ranks for run in runs)}")
        print(f"matrix {scene.name} - 4")


def main():
    parser = argument_parser(__doc__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for name, command, arguments in (
            ("list", list_command, []), ("design", design_command, []),
            ("serial", serial_command, ["scene"]), ("group", group_command, ["scene", "name"]),
            ("matrix", matrix_command, ["scene"]), ("record", record_command, []),
            ("summary", summary_command, [])):
        sub = commands.add_parser(name)
        for argument in arguments:
            sub.add_argument(argument)
        if name == "matrix":
            sub.add_argument("--dealt", action="store_true", help="the part, not the product")
            sub.add_argument("--resume", action="store_true", help="render what is missing")
        if name == "record":
            sub.add_argument("files", nargs="+", metavar="FILE")
        if name == "summary":
            sub.add_argument("file", nargs="?", default=RECORD, metavar="FILE")
        sub.set_defaults(command=command)
    options = parser.parse_args()
    options.work = options.work.resolve()
    result = options.command(options)
    return result if isinstance(result, int) else 0


if __name__ == "__main__":
    report(main)
