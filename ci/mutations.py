#!/usr/bin/python3
"""Would mpipov-validate see it, if mpipov did this to an image? And name the right place?

A real image in sections is damaged in ways that a program that goes wrong would damage it
(damage.py). Of a scene that does not depend on the order of rendering, `compare` must name the
sections, seams and pixels that were damaged, and only those. Of a noisy one, `seams` must call the
damage more than the scene's noise. Either must be quiet about the image as it was.

    mutations.py list                 the tests, as CMakeLists.txt reads them
    mutations.py render SCENE         what the tests of a scene damage (their fixture)
    mutations.py exact KIND SCENE     damage it, and compare with the serial image
    mutations.py noisy KIND SCENE     judge it by the scene's noise, of scene_suite.py serial
    mutations.py stale_reference      does update-references --check see what is out of date?

Exit codes: 0 ok, 1 damage is not seen or another place is named, 2 usage, 77 packages are missing.
"""

import json
import re
import shlex
import sys
from pathlib import Path

from program_runs import (Skip, TestFailure, argument_parser, fresh_folder, measurement,
                          programs_of, report, require_success, run)
from scene_list import scene_named
from scene_suite import renders_of, serial_folder, with_serial

try:
    import numpy
    import damage
    from stale_reference import stale_reference
    MISSING = None
except ImportError as error:
    MISSING = error

SECTIONS = 5  # columns of 32 pixels of the width 160: all of one size
DAMAGED = 3
ALL = ("one_level", "swapped", "last_column", "off_by_one", "gamma", "other_camera",
       "blurred_seam")
# Scenes that have something to see in every section, so that no damage is invisible by itself.
EXACT = {"basic.checker": ALL, "effects.media": ("nan",)}
NOISY = {"effects.area_light_jitter": ALL}
TYPE = {"effects.media": ("+FE", ".exr")}
PLACES = {"swapped": {1, 3}, "last_column": {4}, "blurred_seam": {2, 3}}  # of sections; else {3}
GRID = ("--shape", "columns", "--seams", "aligned", "--sections", str(SECTIONS))
MOVED = 0.02  # units of the scene that the other camera stands farther right


def render_command(options):
    """In sections, serially, and by another camera."""
    scene = scene_named(options.scene)
    folder = fresh_folder(renders_folder(options, scene))
    programs = programs_of(options)
    kind, ending = TYPE.get(scene.name, ("+FN", ".png"))
    programs.serial(scene.arguments(kind, f"+Oserial{ending}"), folder)
    done = require_success(programs.mpi(1, scene.arguments(
        *GRID, "--schedule", "static", "--progress", "none", kind, f"+Osections{ending}"), folder))
    print(done.command())
    render_other_camera(programs, scene, kind, folder)
    require_quiet(options, scene, folder)


def render_other_camera(programs, scene, kind, folder):
    text, count = re.subn(r"(camera\s*\{\s*location\s*<)([^,]+),",
                          lambda found: f"{found[1]}{float(found[2]) + MOVED},",
                          scene.file.read_text())
    if count != 1:
        raise TestFailure(f"{scene.file} has {count} cameras as they are looked for")
    (folder / "moved.pov").write_text(text)
    programs.serial(["moved.pov", *scene.arguments(kind)[1:], "+Oother"], folder)


def require_quiet(options, scene, folder):
    """Without it, a comparison that always finds damage would pass all tests."""
    found = compare_damaged(options, scene, "none", folder)[0]
    if not found["identical"]:
        raise TestFailure(f"{found['differing']} pixels differ before there is any damage")


def renders_folder(options, scene):
    return options.work / "mutations" / scene.name


def other_of(folder):
    return next(folder.glob("other.*"))


def compare_damaged(options, scene, kind, folder):
    """What `compare` says, as JSON and as text, and the pixels before and after."""
    renders = renders_folder(options, scene)
    ending = TYPE.get(scene.name, ("+FN", ".png"))[1]
    image = folder / f"{kind}{ending}"
    record = json.loads((renders / "run.json").read_text())
    before, after = damage.damage(kind, record, DAMAGED, other_of(renders),
                                  renders / f"sections{ending}", image)
    found, text = programs_of(options).compare(renders / f"serial{ending}", image, folder,
                                               renders / "run.json")
    return found, text, before, after


def exact_command(options):
    scene = scene_named(options.scene)
    folder = fresh_folder(renders_folder(options, scene) / options.kind)
    require_quiet(options, scene, folder)
    found, text, before, after = compare_damaged(options, scene, options.kind, folder)
    print(text)
    measurement("differing pixels", found["differing"])
    if found["identical"]:
        raise TestFailure(f"{options.kind} is not seen")
    wrong = list(wrong_pixels(found, before, after))
    wrong += wrong_sections(found, text, PLACES.get(options.kind, {DAMAGED}))
    wrong += SPECIAL.get(options.kind, lambda *_: [])(found, text)
    if wrong:
        raise TestFailure("\n".join([*wrong, f"the images are in {folder}"]))


def wrong_pixels(found, before, after):
    """The same by other means: numpy's."""
    differs = (before != after).any(axis=2)
    rows, columns = numpy.nonzero(differs)
    box = {"x0": columns.min(), "x1": columns.max() + 1, "y0": rows.min(), "y1": rows.max() + 1}
    if found["differing"] != len(rows) or found["differing_box"] != box:
        yield (f"{found['differing']} pixels in {found['differing_box']}, and by numpy "
               f"{len(rows)} in {box}")
    error = numpy.abs(after.astype(float) - before)
    finite = numpy.nan_to_num(error, nan=0)
    largest = found["largest"]
    if largest is None:
        if finite.max() > 0:
            yield f"no largest difference, and by numpy {finite.max()}"
        return
    at = largest["y"], largest["x"], "RGBA".index(largest["channel"])
    if error[at] != finite.max() or largest["a"] != before[at] or largest["b"] != after[at]:
        yield f"the largest difference is said to be {largest}, and is by numpy {finite.max()}"


def wrong_sections(found, text, damaged):
    named = {one["id"] for one in found["run"]["sections"] if one["differing"] > 0}
    if named != damaged:
        yield f"the JSON names the sections {sorted(named)}, damaged are {sorted(damaged)}"
    if f"Sections that differ: {len(damaged)} of {SECTIONS}\n" not in text:
        yield f"the table does not count {len(damaged)} of {SECTIONS} sections"
    listed = {int(one) for one in re.findall(r"^  section (\d+) ", text, re.MULTILINE)}
    if listed != damaged:
        yield f"the table names the sections {sorted(listed)}, damaged are {sorted(damaged)}"


def seams_of(section):
    return {section - 1, section} & set(range(SECTIONS - 1))


def wrong_level(found, _text):
    """All differences are of one level; the step shows at the section's own two seams alone."""
    if abs(found["largest"]["levels"]) != 1:
        yield f"the largest difference is {found['largest']}, not one level"
    for index, seam in enumerate(found["run"]["seams"]):
        step = abs(seam["step"]["mean_step"])
        # Less than a level where some pixels are as bright as can be already.
        if (step > 0.5) != (index in seams_of(DAMAGED)):
            yield f"the step at the seam {seam['a']} | {seam['b']} is {step}"


def wrong_column(found, _text):
    box = found["differing_box"]
    if (box["x0"], box["x1"]) != (159, 160) or found["largest"]["b"] != 0:
        yield f"the last column is black, and {box} is named, with {found['largest']}"


def wrong_seam(found, text):
    touched = {index for index, seam in enumerate(found["run"]["seams"])
               if seam["differing_touching"] > 0}
    if touched != {DAMAGED - 1}:
        yield f"the JSON names the seams {sorted(touched)}, blurred is {DAMAGED - 1}"
    first = re.search(r"^Seams with .*\n  (\d+) \| (\d+) ", text, re.MULTILINE)
    if not first or (int(first[1]), int(first[2])) != (DAMAGED - 1, DAMAGED):
        yield f"the table does not name the seam {DAMAGED - 1} | {DAMAGED} first"
    by_distance = {one["distance"] for one in found["run"]["by_distance"]
                   if one["before"]["differing"] + one["after"]["differing"] > 0}
    if by_distance != set(range(damage.BLURRED)):
        yield f"pixels differ at the distances {sorted(by_distance)} from a seam"


def wrong_nan(found, text):
    place = {"image": "b", "x": 32 * DAMAGED + 1, "y": 60, "channel": "G", "value": "nan"}
    said = found["nonfinite"]
    if said["b"] != {"nan": 1, "infinite": 0} or said["a"] != {"nan": 0, "infinite": 0}:
        yield f"one NaN, and counted are {said}"
    if said["first"] != [place]:
        yield f"the NaN is at {place}, and named is {said['first']}"
    if f"B at x {place['x']}, y {place['y']}, channel G: nan" not in text:
        yield "the table does not name the place of the NaN"


SPECIAL = {"one_level": wrong_level, "last_column": wrong_column, "blurred_seam": wrong_seam,
           "nan": wrong_nan}


def damaging_mpiexec(options, scene, kind, folder):
    """A program that stands for mpiexec, and damages what came of it."""
    program = folder / "mpiexec"
    words = [sys.executable, "-B", Path(__file__).with_name("damage.py"), kind, "--section",
             DAMAGED, "--other", folder / "other.png", "--", options.mpiexec]
    program.write_text(f"#!/bin/sh\nexec {shlex.join(map(str, words))} \"$@\"\n")
    program.chmod(0o755)
    render_other_camera(programs_of(options), scene, "+FN", folder)
    return program


def noisy_command(options):
    """The kind `none` is the fixture of all others: the undamaged image, written again."""
    scene = scene_named(options.scene)
    folder = fresh_folder(renders_folder(options, scene) / options.kind)
    mpiexec = damaging_mpiexec(options, scene, options.kind, folder)
    programs = programs_of(options)
    done = run([programs.validate, "seams", *scene.arguments(), "--out", folder / "out", *GRID,
                "--schedule", "static", "--ranks", "1", "--renders", renders_of(scene),
                *with_serial(serial_folder(options, scene)), "--povray", programs.povray,
                "--mpiexec", mpiexec], folder)
    print(done.command())
    print(done.stdout)
    if done.code not in (0, 1):
        raise TestFailure(f"exit code {done.code}: {done.stderr[-2000:]}")
    found = json.loads((folder / "out" / "seams.json").read_text())["cases"][0]
    verdict = found["verdict"]
    for test in ("pixel_test", "step_test"):
        measurement(f"{test}: beyond", verdict[test]["beyond"])
    measurement("largest z", verdict["pixel_test"]["largest_z"])
    measurement("critical z", verdict["pixel_test"]["critical_z"])
    measurement("largest step, in sigma", verdict["step_test"]["largest"])
    measurement("critical step, in sigma", verdict["step_test"]["critical"])
    wrong = list(wrong_verdict(options.kind, verdict, done))
    if wrong:
        raise TestFailure("\n".join([*wrong, f"the images are in {folder}"]))


def wrong_verdict(kind, verdict, done):
    quiet = kind == "none"
    expected = (0, True, "within noise") if quiet else (1, False, "beyond noise")
    if (done.code, verdict["ok"], verdict["verdict"]) != expected:
        yield (f"{kind}: exit code {done.code}, '{verdict['verdict']}': {verdict['why']}; expected "
               f"were exit code {expected[0]} and '{expected[2]}'")
        return
    if quiet:
        return
    if verdict["why"] not in done.stdout:
        yield "the table does not say why"
    damaged = PLACES.get(kind, {DAMAGED})
    pixels, step = verdict["pixel_test"], verdict["step_test"]
    named = set(map(int, pixels["beyond_by_section"]))
    if not named <= damaged:
        yield f"pixels of the sections {sorted(named)} are named, damaged are {sorted(damaged)}"
    near = set().union(*map(seams_of, damaged))
    if step["beyond"] and step["seam"] not in near:
        yield f"the step at the seam {step['seam']} is named, damaged are {sorted(near)}"
    if not named and not step["beyond"]:
        yield "neither a pixel nor a seam is named"


def stale_command(options):
    stale_reference(options.povray, options.work / "mutations" / "stale_reference")


def list_command(_options):
    """One test a line: render SCENE -, exact SCENE KIND, noisy SCENE KIND, stale_reference - -."""
    for scene, kinds in EXACT.items():
        print(f"render {scene} none")
        for kind in kinds:
            print(f"exact {scene} {kind}")
    for scene, kinds in NOISY.items():
        for kind in ("none", *kinds):
            print(f"noisy {scene} {kind}")
    print("stale_reference - -")


def main():
    parser = argument_parser(__doc__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for name, command, arguments in (
            ("list", list_command, []), ("render", render_command, ["scene"]),
            ("exact", exact_command, ["kind", "scene"]),
            ("noisy", noisy_command, ["kind", "scene"]), ("stale_reference", stale_command, [])):
        sub = commands.add_parser(name)
        for argument in arguments:
            sub.add_argument(argument)
        sub.set_defaults(command=command)
    options = parser.parse_args()
    if MISSING and options.command is not list_command:
        raise Skip(f"{MISSING}: install python3-openimageio (see ci/install-deps)")
    options.work = options.work.resolve()
    options.command(options)
    return 0


if __name__ == "__main__":
    report(main)
