#!/usr/bin/python3
"""How fast is mpipov? Measures it on this machine, and writes docs/speed.md.

    speed.py measure [CASE...]   takes up an interrupted run; all cases: about an hour on 2 cores
    speed.py page                docs/speed.md from the records

The machine must have nothing else to do. Everything is measured in turns, and judged by ratios within
one run. Cases: SCENES below by name, in_flight (many small sections on one core), simulation (what
`mpipov-validate simulate` says of two ranks from a run on one, against two real ranks).

Exit codes: 0 ok, 1 a bar is missed, 2 usage, 77 nothing to measure.
"""

import json
import subprocess
from dataclasses import dataclass
from pathlib import Path

from page_script import page_script
from program_runs import (ROOT, Skip, fresh_folder, programs_of, report,
                          require_success)
from scene_list import EXAMPLES
from simulation_check import arguments_of, simulate
from speed_page import missed, page

BASIC = ROOT / "scenes" / "basic"


@dataclass(frozen=True)
class Scene:
    file: Path
    options: tuple
    repeat: int
    schedules: str = "static,dynamic,cost"


SCENES = {
    "second": Scene(BASIC / "spheres.pov", ("+W640", "+H480", "+A0.1", "+R4"), 7, "dynamic"),
    "corner": Scene(BASIC / "corner.pov", ("+W640", "+H480", "+A0.3", "+AM1"), 2),
    "uniform": Scene(BASIC / "uniform.pov", ("+W480", "+H360", "+A0.3", "+AM1"), 3),
    "benchmark": Scene(EXAMPLES / "advanced" / "benchmark" / "benchmark.pov",
                       ("+W512", "+H512", "+A0.3"), 1, "dynamic"),
}
SIMULATED = {
    "spheres": (BASIC / "spheres.pov", "+W1280", "+H960", "+A0.1", "+R4"),
    "corner": (BASIC / "corner.pov", "+W320", "+H240", "+A0.3", "+AM1"),
    "uniform": (BASIC / "uniform.pov", "+W320", "+H240", "+A0.3", "+AM1"),
    "chess2": (EXAMPLES / "advanced" / "chess2.pov", "+W320", "+H240", "+A0.3"),
    "woodbox": (EXAMPLES / "advanced" / "woodbox.pov", "+W640", "+H480", "+A0.3"),
}
SIMULATED_SECTIONS = 16
REPEAT = 3
IN_FLIGHT_REPEAT = 5
TRIVIAL = "camera { location -4*z } light_source { <3, 5, -4>, 1 } sphere { 0, 1 pigment { rgb 1 } }\n"


def write(file, found):
    file.write_text(json.dumps(found, indent=2) + "\n")


def measure_scene(name, options, programs):
    scene = SCENES[name]
    if not scene.file.exists():
        raise Skip(f"there is no '{scene.file}': install povray-examples (see ci/install-deps)")
    folder = options.work / name
    file = folder / "speedup.json"
    if file.exists() and json.loads(file.read_text())["complete"]:
        return
    fresh_folder(folder)
    argv = [programs.validate, "speedup", scene.file, *scene.options, "-D", "--ranks", 2,
            "--slots", "auto", "--repeat", scene.repeat, "--schedule", scene.schedules,
            "--out", folder, "--povray", programs.povray, "--mpiexec", programs.mpiexec]
    subprocess.run([str(word) for word in argv], cwd=folder, check=True)


def record_of(programs, ranks, arguments, folder):
    require_success(programs.mpi(ranks, [*arguments, "-D", "--record", "run.json", "--progress",
                                         "none", "+Oimage.png"], folder))
    return json.loads((folder / "run.json").read_text())


def measure_in_flight(options, programs):
    file = options.work / "in_flight.json"
    if file.exists():
        return
    folder = fresh_folder(options.work / "in_flight")
    (folder / "trivial.pov").write_text(TRIVIAL)
    seconds = {"1": [], "auto": []}
    for turn in range(IN_FLIGHT_REPEAT):
        for under_way in sorted(seconds, reverse=turn % 2 == 1):
            record = record_of(programs, 0, ["trivial.pov", "+W160", "+H120", "--slots", 1,
                                             "--sections", 16, "--seams", "plain", "--in-flight",
                                             under_way], folder)
            sections = record["sections"]
            seconds[under_way].append(max(s["end"] for s in sections) -
                                      min(s["start"] for s in sections))
            print(f"in flight {under_way}: {seconds[under_way][-1]:.2f} s", flush=True)
            if under_way == "auto":
                chosen = record["plan"]["in_flight"]
    write(file, {"sections": 16, "chosen": chosen, "seconds": seconds})


def simulate_scene(name, options, programs):
    """In each turn a run on one rank and one on two; what is said of both from the first one's record,
    and of the second from its own, which knows how fast the cores were meanwhile."""
    scene, *arguments = SIMULATED[name]
    folder = fresh_folder(options.work / "simulation" / name)
    turns = []
    for turn in range(REPEAT):
        runs = {}
        for ranks in (1, 2) if turn % 2 == 0 else (2, 1):
            runs[ranks] = record_of(programs, ranks, [scene, *arguments, "--slots", 1, "--threads", 1,
                                                      "--shape", "tiles", "--sections",
                                                      SIMULATED_SECTIONS], folder)
            write(folder / f"run{turn}-{ranks}.json", runs[ranks])
        found = {}
        for source, ranks in ((1, 1), (1, 2), (2, 2)):
            said = simulate(programs, folder, ["--run", folder / f"run{turn}-{source}.json",
                                               *arguments_of(runs[ranks], ranks)])
            found[f"{source}-{ranks}"] = {
                "said": said, "measured": runs[ranks]["totals"]["wall_seconds"],
                "cpu_seconds": sum(s["cpu_seconds"] for s in runs[ranks]["sections"])}
        turns.append(found)
        print(name, {key: f"{f['said']:.2f} {f['measured']:.2f}" for key, f in found.items()},
              flush=True)
    return {"scene": name, "arguments": arguments, "turns": turns}


def measure_simulation(options, programs):
    file = options.work / "simulation.json"
    found = json.loads(file.read_text()) if file.exists() else []
    for name in SIMULATED:
        if all(entry["scene"] != name for entry in found):
            found.append(simulate_scene(name, options, programs))
            write(file, found)


def measure_command(options):
    programs = programs_of(options)
    options.work.mkdir(parents=True, exist_ok=True)
    for case in options.case or [*SCENES, "in_flight", "simulation"]:
        if case in SCENES:
            measure_scene(case, options, programs)
        elif case == "in_flight":
            measure_in_flight(options, programs)
        else:
            measure_simulation(options, programs)
    return 0


def page_command(options):
    found = {name: json.loads((options.work / name / "speedup.json").read_text())
             for name in SCENES if (options.work / name / "speedup.json").exists()}
    if not found:
        raise Skip(f"no speedup.json in '{options.work}': speed.py measure makes them")
    more = {name: json.loads((options.work / f"{name}.json").read_text())
            for name in ("in_flight", "simulation") if (options.work / f"{name}.json").exists()}
    options.page.write_text(page(found, more))
    print(options.page)
    return 1 if missed(found, more) else 0


def measure_arguments(parser):
    parser.add_argument("case", nargs="*", choices=[*SCENES, "in_flight", "simulation"],
                        metavar="CASE")


def main():
    return page_script(__doc__, "speed", measure_command, page_command, measure_arguments)


if __name__ == "__main__":
    report(main)
