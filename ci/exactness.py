#!/usr/bin/python3
"""Are images that were rendered in sections bit-identical to the serial render?

The scenes are Debian's examples (package povray-examples); exactness_cases.json lists them, the
values of every dimension, and the cases of the default test run. A case is called
SCHEDULE.npRANKS.SHAPE.SEAMS.AA, the reference of a scene AA.KIND, where KIND is `default`
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
import os
import re
import sys
from dataclasses import dataclass
from pathlib import Path

from program_runs import (Skip, TestFailure, argument_parser, fresh_folder, programs_of, report,
                          require_same_chunks, require_success)

CASES = json.loads(Path(__file__).with_name("exactness_cases.json").read_text())
EXAMPLES = Path(os.environ.get("MPIPOV_EXAMPLES", "/usr/share/doc/povray/examples"))
BLOCK = 32  # edge of POV-Ray's render blocks: aligned sections are made of them
CASE_NAME = re.compile(r"(static|dynamic)\.np(\d+)\.(columns|rows|tiles)\."
                       r"(aligned|halo|plain)\.(off|AM1|AM2)")


@dataclass(frozen=True)
class Case:
    schedule: str
    ranks: int
    shape: str
    seams: str
    aa: str

    @staticmethod
    def parse(name):
        match = CASE_NAME.fullmatch(name)
        if not match:
            sys.exit(f"exactness: '{name}' is no case: SCHEDULE.npRANKS.SHAPE.SEAMS.AA")
        schedule, ranks, shape, seams, aa = match.groups()
        return Case(schedule, int(ranks), shape, seams, aa)

    def name(self):
        return f"{self.schedule}.np{self.ranks}.{self.shape}.{self.seams}.{self.aa}"

    def reference(self):
        return f"{self.aa}.{'oneblock' if self.seams == 'halo' else 'default'}"

    def promise(self):
        """`exact`, but with method 1, which looks at neighbouring pixels, where the edges lie off
        the block grid: an overlap comes `close`, without one the seams show (`none`)."""
        if self.seams == "aligned" or self.aa != "AM1":
            return "exact"
        return "close" if self.seams == "halo" else "none"

    def sections(self, size):
        """One a rank with static, more than ranks with dynamic, as far as the image has them."""
        unit = BLOCK if self.seams == "aligned" else 1
        across, down = (-(-side // unit) for side in size)
        most = {"columns": across, "rows": down, "tiles": across * down}[self.shape]
        wanted = self.ranks if self.schedule == "static" else 2 * self.ranks + 1
        return min(most, max(2, wanted))

    def arguments(self, size):
        return ["--schedule", self.schedule, "--shape", self.shape, "--seams", self.seams,
                "--sections", str(self.sections(size))]


def scene_named(name, kind):
    for scene in CASES[kind]:
        if scene["name"] == name:
            return scene
    sys.exit(f"exactness: no scene '{name}' under '{kind}' in exactness_cases.json")


def scene_arguments(scene, aa):
    file = EXAMPLES / scene["file"]
    if not file.is_file():
        raise Skip(f"'{file}' is not there: install povray-examples (see ci/install-deps)")
    width, height = scene["size"]
    # Some include files that lie beside them, where POV-Ray does not look by itself.
    return [file, f"+L{file.parent}", f"+W{width}", f"+H{height}", *CASES["antialiasing"][aa]]


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


def whole_product(only):
    for schedule, ranks, shape, seams, aa in itertools.product(
            CASES["schedules"], CASES["ranks"], CASES["shapes"], CASES["seams"],
            CASES["antialiasing"]):
        case = Case(schedule, ranks, shape, seams, aa)
        if all(str(getattr(case, key)) in values for key, values in only.items()):
            yield case


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


def earlier_results(file, scene):
    if not file.exists():
        return []
    matrix = json.loads(file.read_text())
    if matrix["size"] != scene["size"]:
        sys.exit(f"exactness: '{file}' is of another size, {matrix['size']}: remove it")
    return matrix["results"]


def pinned_matrix(options):
    scene = scene_named(options.scene, "pinned")
    pin_command(options)
    for schedule, ranks in itertools.product(CASES["schedules"], CASES["ranks"]):
        options.name = f"{schedule}.np{ranks}"
        pinned_command(options)
    print(f"{scene['name']}: the same bits for every number of ranks and schedule")
    return 0


def write_results(file, scene, results):
    part = file.with_name(file.name + ".part")
    part.write_text(json.dumps({"format": "mpipov-exactness", "version": 1,
                                "scene": scene["name"], "size": scene["size"],
                                "results": results}, indent=1) + "\n")
    part.replace(file)


def describe(result):
    if result["identical"]:
        return f"{result['case']}: identical"
    at = result["largest"]
    return (f"{result['case']}: {result['differing']} pixels differ, by up to "
            f"{result['max_difference']:g} (x {at['x']}, y {at['y']}, {at['channel']})")


def summary_command(options):
    print(f"{'scene':<13}{'seams':<9}{'AA':<5}{'cases':>6}{'identical':>11}{'most pixels':>13}"
          f"{'largest':>9}")
    differing = {"exact": [], "close": [], "none": []}
    for file in options.files:
        matrix = json.loads(Path(file).read_text())
        groups = {}
        for result in matrix["results"]:
            case = Case.parse(result["case"])
            groups.setdefault((case.seams, case.aa), []).append(result)
            if not result["identical"]:
                differing[case.promise()].append(f"{matrix['scene']}.{describe(result)}")
        for (seams, aa), group in sorted(groups.items()):
            print(f"{matrix['scene']:<13}{seams:<9}{aa:<5}{len(group):>6}"
                  f"{sum(r['identical'] for r in group):>11}"
                  f"{max(r['differing'] for r in group):>13}"
                  f"{max(r['max_difference'] for r in group):>9g}")
    for title, cases in (("Differ with an overlap", differing["close"]),
                         ("Differ where none may", differing["exact"])):
        print("\n".join(["", f"{title}: {len(cases)}", *cases]))
    return 1 if differing["exact"] else 0


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
