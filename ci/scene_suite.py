#!/usr/bin/python3
"""Every scene of our own, serially and in sections: is the verdict what scenes.json promises?

A scene that does not depend on the order of rendering must come out bit-identical with aligned
seams, and with plain ones where antialiasing does not see the sections; one that does depend on it
must be within its own noise. What is known to be otherwise must be so: a few pixels that the shadow
cache decides (docs/povray.md), and radiosity whose sections share no samples. SCENE is as in
effects.fog; suite_cases.py has the cases.

    scene_suite.py list                 the tests, as CMakeLists.txt reads them
    scene_suite.py begin                an empty folder for the results of this run
    scene_suite.py serial SCENE         render it serially, as often as its noise asks for
    scene_suite.py case SCENE CASE      render it in sections, and judge
    scene_suite.py report               one page of all results, whatever failed
    scene_suite.py failed_scene         is there a page when a scene cannot be rendered?

Results lie in the work folder: scenes/SCENE/serial and scenes/SCENE/CASE; scenes/report.html.
Exit codes: 0 ok, 1 a verdict is not as promised, 2 usage.
"""

import json
import re
import sys
from dataclasses import replace

from program_runs import (TestFailure, argument_parser, fresh_folder, measurement, programs_of,
                          report, run)
from scene_list import scene_named
from suite_cases import NOT_SHARED, cases_of, suite_scenes

RENDERS = 12  # serial renders that tell a scene's noise
# The fewer renders, the more damage passes for noise: more of the scene that mutations.py damages.
# Of corner_jitter most are alike: to find many that differ would take long.
RENDERS_OF = {"effects.area_light_jitter": 20, "effects.corner_jitter": 8}
RARE = 1000  # one pixel in so many, at the most, with rare_pixels
NO_SHADOWS = "+Q3"
# What mpipov tells of a scene, besides whether it depends on the order of rendering.
EFFECTS = ("antialiasing", "radiosity", "photons", "media", "isosurface", "transparency",
           "reflection")


def renders_of(scene):
    return RENDERS_OF.get(scene.name, RENDERS)


def results_folder(options):
    return options.work / "scenes"


def serial_folder(options, scene):
    return results_folder(options) / scene.name / "serial"


def with_serial(folder):
    """What makes `seams` take the serial renders that lie there."""
    return ["--serial", folder]


def run_validate(options, command, scene, folder, more):
    """`mpipov-validate noise` or `seams` of a scene; what it says is printed."""
    programs = programs_of(options)
    done = run([programs.validate, command, *scene.arguments(), "--renders", renders_of(scene),
                "--povray", programs.povray, "--out", folder, *more], folder)
    print(done.command())
    print(done.stdout)
    return done


def write_failure(scene, folder, failure):
    """As `seams` itself tells of a scene that cannot be rendered: for the page."""
    (folder / "seams.json").write_text(json.dumps(
        {"format": "mpipov-seams", "version": 1, "scene": scene.name, "complete": False,
         "failure": failure, "cases": []}))


def begin_command(options):
    # Results of an earlier run must not be told as those of this one.
    fresh_folder(results_folder(options))


def serial_command(options):
    scene = scene_named(options.scene, suite_scenes())
    folder = fresh_folder(serial_folder(options, scene))
    try:
        render_serially(options, scene, folder)
    except TestFailure as failure:
        write_failure(scene, folder, str(failure))  # its cases are not run
        raise


def render_serially(options, scene, folder):
    done = run_validate(options, "noise", scene, folder, [])
    if done.code != 0:
        raise TestFailure(f"the serial renders: exit code {done.code}\n{done.stderr[-2000:]}")
    found = json.loads((folder / "noise.json").read_text())
    measurement("wall seconds", done.seconds)
    measurement("noise renders", len(found["noise"].get("renders", [])))
    measurement("sigma", found["noise"].get("sigma"))
    if found["exact"] == scene.order_dependent:
        raise TestFailure("serial renders in other orders " +
                          ("are all alike" if found["exact"] else "differ") +
                          f", and scenes.json says order_dependent: {scene.order_dependent}")
    too_few = found["noise"].get("why_not") or found["noise"].get("why_not_enough")
    if scene.order_dependent and too_few:
        raise TestFailure(too_few)


def case_command(options):
    scene = scene_named(options.scene, suite_scenes())
    case = next((one for one in cases_of(scene) if one.name() == options.name), None)
    if case is None:
        sys.exit(f"scene_suite: no case '{options.name}' of {scene.name}: see scene_suite.py list")
    folder = fresh_folder(results_folder(options) / scene.name / case.name())
    done = run_validate(options, "seams", scene, folder,
                        [*with_serial(serial_folder(options, scene)), *case.arguments(),
                         "--mpiexec", options.mpiexec])
    file = folder / "seams.json"
    if not file.is_file():
        write_failure(scene, folder, f"exit code {done.code}: {done.stderr[-2000:]}")
    found = json.loads(file.read_text())
    if done.code not in (0, 1) or not found["complete"]:
        raise TestFailure(f"exit code {done.code}: {found['failure']}\n{done.stderr[-2000:]}")
    measure(found)
    if scene.rare_pixels:
        wrong = not_the_shadow_cache(options, scene, case, found, folder)
    else:
        wrong = wrong_verdicts(scene, case, found, done.code)
    wrong += missed_effects(scene, folder, found)
    if wrong:
        raise TestFailure("\n".join([*wrong, f"images and records are in {folder}"]))


def not_the_shadow_cache(options, scene, case, found, folder):
    """Lines that say why pixels that differ are not those few of the shadow cache: without shadows
    no pixel may differ."""
    wrong = [f"{one['name']}: {one['comparison']['differing']} pixels differ, and one in {RARE} may"
             for one in found["cases"]
             if one["comparison"]["differing"] * RARE > one["comparison"]["pixels"]]
    without = replace(scene, options=(*scene.options, NO_SHADOWS))
    plain = fresh_folder(folder / "no_shadows")
    done = run_validate(options, "seams", without, plain,
                        [*case.arguments(), "--mpiexec", options.mpiexec])
    if done.code != 0:
        wrong.append(f"sections differ without shadows ({NO_SHADOWS}) too: not the shadow cache")
    return wrong


def measure(found):
    for one in found["cases"]:
        # A test has one case, but where plain seams are promised to be exact too.
        of = f"{one['seams']}: " if len(found["cases"]) > 1 else ""
        compared = one["comparison"]
        if compared is None:
            continue
        level = "full_scale" if compared["unit"] == "value" else "levels"
        measurement(f"{of}differing pixels", compared["differing"])
        measurement(f"{of}largest difference", abs((compared["largest"] or {}).get(level, 0)))
        measurement(f"{of}mean", (compared["mean_abs"] or {}).get(level))
        measurement(f"{of}rms", (compared["rms"] or {}).get(level))
        measurement(f"{of}psnr", compared["psnr"])  # none where nothing differs
        measurement(f"{of}ssim", (compared["ssim"] or {}).get("value"))
        measurement(f"{of}step at seams", compared["run"]["step"]["seams"]["mean_step"])
        measurement(f"{of}wall seconds", one["seconds"])


def wrong_verdicts(scene, case, found, code):
    """Lines that say which verdicts are not what scenes.json promises."""
    known = case.radiosity == NOT_SHARED
    promised = ("beyond noise",) if known else \
        ("identical", "within noise") if scene.order_dependent else ("identical",)
    wrong = [f"{one['name']}: {one['verdict']['verdict']}, not {' or '.join(promised)}: "
             f"{one['verdict']['why']}"
             for one in found["cases"] if one["verdict"]["verdict"] not in promised]
    judged = {one["name"] for one in found["cases"]}
    if judged != case.verdicts():
        wrong.append(f"judged were {sorted(judged)}, and not {sorted(case.verdicts())}; left out: "
                     f"{found['skipped']}")
    if (code != 0) != known and not wrong:
        wrong.append(f"exit code {code}, though every verdict is right")
    return wrong


def missed_effects(scene, folder, found):
    """An effect that mpipov does not see makes it promise what it cannot keep. One that it sees in
    vain costs time only: it is counted."""
    promised = {name: scene.effects.get(name, False) for name in EFFECTS}
    promised["order_dependent"] = scene.order_dependent
    wrong, in_vain = [], set()
    for one in found["cases"]:
        if one["run"] is None:
            continue
        record = json.loads((folder / one["run"]).read_text())["plan"]["effects"]
        for name, called_for in promised.items():
            if name not in record:
                wrong.append(f"{one['name']}: the record does not tell of {name}")
            elif called_for and not record[name]["on"]:
                wrong.append(f"{one['name']}: {name} is missed: {record[name]['why']}")
            elif record[name]["on"] and not called_for:
                in_vain.add(name)
                print(f"{one['name']}: {name} is found in vain: {record[name]['why']}")
    measurement("effects found in vain", len(in_vain))
    return wrong


def report_command(options):
    folder = results_folder(options)
    print_summary(folder)
    page = folder / "report.html"
    page.unlink(missing_ok=True)
    done = run([programs_of(options).validate, "report", folder], folder)
    if done.code not in (0, 1) or not page.is_file():
        raise TestFailure(f"{done.command()}\nno page, exit code {done.code}: {done.stderr}")
    measurement("bytes of the page", page.stat().st_size)
    print(f"{page}")
    return page


def print_summary(folder):
    for file in sorted(folder.rglob("seams.json")):
        found = json.loads(file.read_text())
        verdicts = [one["verdict"]["verdict"] for one in found["cases"]]
        print(f"{file.parent.relative_to(folder)}: "
              f"{', '.join(verdicts) or 'failed: ' + (found['failure'] or 'no case')[:200]}")


def failed_scene_command(options):
    """The page is there when CTest runs none of a scene's cases, since its fixture failed."""
    options.work = fresh_folder(options.work / "failed_scene")
    options.scene, options.povray = "effects.none", "/bin/false"
    begin_command(options)
    try:
        serial_command(options)
    except TestFailure as failure:
        print(f"as it must: {failure}")
    else:
        raise TestFailure("a POV-Ray that renders nothing passes")
    page = report_command(options).read_text()
    if options.scene not in page or not re.search(r"\bfailed\b", page):
        raise TestFailure(f"the page does not say that {options.scene} failed")


def list_command(_options):
    """One test a line: kind, scene, case, ranks."""
    for scene in suite_scenes():
        print(f"serial {scene.name} - 1")
        for case in cases_of(scene):
            print(f"case {scene.name} {case.name()} {case.ranks}")


def main():
    parser = argument_parser(__doc__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for name, command, arguments in (
            ("list", list_command, []), ("begin", begin_command, []),
            ("serial", serial_command, ["scene"]), ("case", case_command, ["scene", "name"]),
            ("report", report_command, []), ("failed_scene", failed_scene_command, [])):
        sub = commands.add_parser(name)
        for argument in arguments:
            sub.add_argument(argument)
        sub.set_defaults(command=command)
    options = parser.parse_args()
    options.work = options.work.resolve()
    options.command(options)
    return 0


if __name__ == "__main__":
    report(main)
