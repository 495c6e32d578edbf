#!/usr/bin/python3
"""Are images that were rendered in sections bit-identical to the serial render?

The scenes are Debian's examples (package povray-examples); exactness_cases.json lists them. A case
is called SCHEDULE.npRANKS.SHAPE.SEAMS.AA, the reference of a scene AA.KIND, where KIND is `default`
(povray +WT1) or `oneblock` (povray +WT1 +BSn, n the longer side), which is what halo reproduces.

    exactness.py list                  the tests of the default run, as CMakeLists.txt reads them
    exactness.py reference SCENE REF   render a reference (a fixture of the cases)
    exactness.py case SCENE CASE       render in sections and compare; CASE:differs: must differ
    exactness.py pin SCENE             render an order-dependent scene on its grid (a fixture)
    exactness.py pinned SCENE CASE     render it with other ranks or schedule: the same bits?
    exactness.py matrix SCENE [--only KEY=VALUE,...] [--resume]
                                       the whole product; writes SCENE.json; --resume: renders only
                                       the cases that an interrupted run left out
    exactness.py summary FILE...       a table of such files

Exit codes: 0 ok, 1 a difference where none may be, 2 usage, 77 the scenes are not installed.
"""

import itertools
import json
import re

from exactness_cases import CASES, Case, scene_arguments, scene_named, whole_product
from exactness_results import describe, earlier_results, summary_command, write_results
from program_runs import (TestFailure, argument_parser, fresh_folder, programs_of, report,
                          require_same_chunks, require_success)


def reference_folder(options, scene):
    return options.work / "references" / scene["name"]


def render_reference(options, scene, reference):
    """The serial image. Other references of the scene may be rendered beside it meanwhile."""
    aa, kind = reference.split(".")
    block = [f"+BS{max(scene['size'])}"] if kind == "oneblock" else []
    folder = reference_folder(options, scene) / reference
    arguments = scene_arguments(scene, aa)
    fresh_folder(folder)
    programs_of(options).serial([*arguments, *block, "+Oserial.png"], folder)
    return folder / "serial.png"


def render_case(options, scene, case, serial, folder):
    """Renders in sections and compares: what matrix writes of a case."""
    arguments = scene_arguments(scene, case.aa)
    programs = programs_of(options)
    fresh_folder(folder)
    done = require_success(programs.mpi(
        case.ranks, [*arguments, *case.arguments(scene["size"]), "--progress", "none",
                     "+Osections.png"], folder))
    compared, _ = programs.compare(serial, folder / "sections.png", folder)
    require_same_chunks(serial, folder / "sections.png")
    run = json.loads((folder / "run.json").read_text())
    largest = compared["largest"]
    return {"case": case.name(), "identical": compared["identical"],
            "differing": compared["differing"], "differing_box": compared["differing_box"],
            "max_difference": abs(largest["levels"]) if largest else 0, "largest": largest,
            "sections": run["plan"]["grid"]["sections"], "wall_seconds": round(done.seconds, 3),
            "promise": case.promise(), "command": done.command()}


def reference_command(options):
    render_reference(options, scene_named(options.scene, "exact"), options.name)


def case_command(options):
    scene = scene_named(options.scene, "exact")
    name, _, expected = options.name.partition(":")
    case = Case.parse(name)
    serial = reference_folder(options, scene) / case.reference() / "serial.png"
    folder = options.work / scene["name"] / name
    result = render_case(options, scene, case, serial, folder)
    print(result["command"])
    # Once more for the reader of the log, with the record: where the seams are.
    print(programs_of(options).compare(serial, folder / "sections.png", folder, "run.json")[1])
    if expected == "differs":
        # Without this a comparison that sees nothing would pass all the others.
        if result["identical"]:
            raise TestFailure("identical, where the seams of these sections must show")
    elif not result["identical"]:
        raise TestFailure(f"{result['differing']} pixels differ from {serial}, by up to "
                          f"{result['max_difference']}/255; the images are in {folder}")


def pin_render(options, scene, schedule, ranks, folder):
    arguments = scene_arguments(scene, scene["antialiasing"])
    fresh_folder(folder)
    done = require_success(programs_of(options).mpi(
        ranks, [*arguments, "--schedule", schedule, "--shape", scene["shape"], "--seams",
                "aligned", "--sections", scene["sections"], "--progress", "none",
                "+Osections.png"], folder))
    print(done.command())
    record = json.loads((folder / "run.json").read_text())
    if len(record["sections"]) != scene["sections"]:
        raise TestFailure(f"{len(record['sections'])} sections, not {scene['sections']}")
    if not record["plan"]["effects"]["order_dependent"]["on"]:
        raise TestFailure("the plan takes the scene for one that does not depend on the order")
    return record["output"]["pixel_sha1"]


def pin_command(options):
    scene = scene_named(options.scene, "pinned")
    pin_render(options, scene, "static", 1, reference_folder(options, scene) / "pinned")


def pinned_command(options):
    scene = scene_named(options.scene, "pinned")
    schedule, ranks = re.fullmatch(r"(static|dynamic)\.np(\d+)", options.name).groups()
    first = reference_folder(options, scene) / "pinned"
    folder = options.work / scene["name"] / options.name
    found = pin_render(options, scene, schedule, int(ranks), folder)
    expected = json.loads((first / "run.json").read_text())["output"]["pixel_sha1"]
    compared, text = programs_of(options).compare(first / "sections.png",
                                                  folder / "sections.png", folder, "run.json")
    print(text)
    if found != expected or not compared["identical"]:
        raise TestFailure(f"pixel_sha1 {found}, and {expected} on one rank with the same grid; "
                          f"the images are in {first} and {folder}")


def matrix_command(options):
    if any(scene["name"] == options.scene for scene in CASES["pinned"]):
        return pinned_matrix(options)
    scene = scene_named(options.scene, "exact")
    only = {key: values.split(",") for key, values in
            (given.split("=") for given in options.only)}
    references = {}
    file = options.work / f"{scene['name']}.json"
    results = earlier_results(file, scene) if options.resume else []
    known = {result["case"] for result in results}
    for case in whole_product(only):
        if case.name() in known:
            continue
        name = case.reference()
        if name not in references:
            references[name] = render_reference(options, scene, name)
        result = render_case(options, scene, case, references[name],
                                options.work / scene["name"] / case.name())
        results.append(result)
        write_results(file, scene, results)  # after each: an interruption loses one
        print(describe(result), flush=True)
    broken = any(result["promise"] == "exact" and not result["identical"] for result in results)
    print(f"{len(results)} cases in {file}")
    return 1 if broken or not results else 0


def pinned_matrix(options):
    scene = scene_named(options.scene, "pinned")
    pin_command(options)
    for schedule, ranks in itertools.product(CASES["schedules"], CASES["ranks"]):
        options.name = f"{schedule}.np{ranks}"
        pinned_command(options)
    print(f"{scene['name']}: the same bits for every number of ranks and schedule")
    return 0


def list_command(_options):
    """One test a line: kind, scene, case, ranks, and the reference that it needs."""
    for scene in CASES["exact"]:
        cases = [Case.parse(name.partition(":")[0]) for name in scene["cases"]]
        for reference in sorted({case.reference() for case in cases}):
            print(f"reference {scene['name']} {reference} 1 -")
        for name, case in zip(scene["cases"], cases):
            print(f"case {scene['name']} {name} {case.ranks} {case.reference()}")
        print(f"matrix {scene['name']} - {max(CASES['ranks'])} -")
    for scene in CASES["pinned"]:
        print(f"pin {scene['name']} - 1 -")
        for name in scene["cases"]:
            print(f"pinned {scene['name']} {name} {name.rpartition('np')[2]} -")
        print(f"matrix {scene['name']} - {max(CASES['ranks'])} -")


def main():
    parser = argument_parser(__doc__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for name, command, arguments in (
            ("list", list_command, []), ("reference", reference_command, ["scene", "name"]),
            ("case", case_command, ["scene", "name"]), ("pin", pin_command, ["scene"]),
            ("pinned", pinned_command, ["scene", "name"]), ("matrix", matrix_command, ["scene"]),
            ("summary", summary_command, [])):
        sub = commands.add_parser(name)
        for argument in arguments:
            sub.add_argument(argument)
        if name == "matrix":
            sub.add_argument("--only", action="append", default=[], metavar="KEY=VALUE,...",
                             help="a part of the product: schedule, ranks, shape, seams, aa")
            sub.add_argument("--resume", action="store_true",
                             help="keep what SCENE.json has, render the rest")
        if name == "summary":
            sub.add_argument("files", nargs="+", metavar="FILE")
        sub.set_defaults(command=command)
    options = parser.parse_args()
    options.work = options.work.resolve()
    return options.command(options) or 0


if __name__ == "__main__":
    report(main)
