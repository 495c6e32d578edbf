#!/usr/bin/python3
"""Is `mpipov-validate simulate` right? Prints what it says beside what was measured.

    simulation_check.py stand-in [--ranks 8,16,32]
        mpipov on more ranks than there are cores, with a stand-in for POV-Ray that sleeps as long
        as a section is to take: many ranks for one scheduler, one coordinator, real MPI. Compared is
        the time from the first section's start to the last one's end; what a launch takes beside
        sleeping and how long ranks wait for an answer are those of the run itself.
    simulation_check.py scene SPEEDUP.json... [--within 0.1]
        what `mpipov-validate speedup` measured: from the record of a run on the fewest ranks, the
        wall time of the runs on more, and of itself, each with the sections, threads and launches
        in flight that it had. For a quiet machine.

By hand, not in CTest: times are compared. Exit codes: 0 all within the limit, 1 not, 2 usage.
"""

import json
import statistics
from pathlib import Path

from program_runs import (ROOT, TestFailure, argument_parser, fresh_folder, programs_of, report,
                          require_success, run)

SIZE = 512
SCENE = ROOT / "scenes" / "basic" / "spheres.pov"
# Sections take between 0.3 and 1.5 s, by their first column and row.
STAND_IN = """#!/bin/sh
section=
for argument do
    case $argument in
        +SC*) column=${{argument#+SC}} ;;
        +SR*) row=${{argument#+SR}} ;;
        +O*/section*) section=1 ;;
    esac
done
[ "$section" ] || exec {povray} "$@"
ms=$((300 + (column * 37 + row * 101) % 1201))
sleep $((ms / 1000)).$(printf %03d $((ms % 1000)))
exec {fake} "$@"
"""


def sleep_seconds(rect):
    # POV-Ray counts from 1, and is told 0 or 1 for the first one; mpipov says 0.
    column, row = (0 if rect[key] == 0 else rect[key] + 1 for key in ("x0", "y0"))
    return (300 + (column * 37 + row * 101) % 1201) / 1000


def simulation(programs, folder, arguments):
    out = folder / "simulation.json"
    done = run([programs.validate, "simulate", *arguments, "--json", out], folder)
    require_success(done)
    return json.loads(out.read_text())


def simulate(programs, folder, arguments):
    return simulation(programs, folder, arguments)["rows"][0]["wall_seconds"]


def line(what, simulated, measured):
    error = simulated / measured - 1
    print(f"{what:<58} {simulated:8.2f} {measured:8.2f} {100 * error:+7.1f} %", flush=True)
    return abs(error)


def heading():
    print(f"{'':<58} {'said':>8} {'measured':>8} {'error':>9}", flush=True)


def stand_in_case(programs, folder, fake, ranks, schedule, slots):
    folder = fresh_folder(folder)
    povray = folder / "povray-stand-in"
    povray.write_text(STAND_IN.format(povray=programs.povray, fake=fake))
    povray.chmod(0o755)
    sections = 4 * ranks * slots if schedule != "static" else ranks * slots
    own = ["--povray", povray, "--sections", sections, "--shape", "tiles", "--seams", "plain",
           "--schedule", schedule, "--slots", slots, "--in-flight", slots, "--threads", 1,
           "--confine", "off"]  # it runs a program from the build folder
    require_success(programs.mpi(ranks, [SCENE, f"+W{SIZE}", f"+H{SIZE}", "-A", "+FP",
                                         "+Oimage.ppm", *own, "--record", "run.json",
                                         "--progress", "none"], folder))
    record = json.loads((folder / "run.json").read_text())
    done = record["sections"]
    measured = max(s["end"] for s in done) - min(s["start"] for s in done)
    overhead = statistics.median(s["wall_seconds"] - sleep_seconds(s["keep"]) for s in done)
    answer = statistics.median(s["end"] - s["start"] - s["wall_seconds"] for s in done)
    costs = {"format": "mpipov-costs", "version": 1, "width": SIZE, "height": SIZE,
             "rectangles": [{**s["keep"], "cpu_seconds": sleep_seconds(s["keep"])} for s in done]}
    (folder / "costs.json").write_text(json.dumps(costs))
    said = simulate(programs, folder, [
        "--costs", "costs.json", "--ranks", ranks, "--slots", slots, "--in-flight", slots,
        "--schedule", schedule, "--sections", sections, "--shape", "tiles", "--seams", "plain",
        "--bare", 0, "--frame", 0, "--before", 0, "--after", 0,
        "--start-up", max(0.0, overhead), "--answer", max(0.0, answer)])
    return line(f"{ranks} ranks, {schedule}, {slots} at once, {sections} sections "
                f"(launch {1e3 * overhead:.0f} ms, answer {1e3 * answer:.0f} ms)", said, measured)


def stand_in(options, programs):
    fake = options.fake or programs.mpipov.parent.parent / "wrapper" / "fake_povray"
    if not fake.exists():
        raise TestFailure(f"there is no '{fake}': build fake_povray, or say where it is (--fake)")
    heading()
    errors = []
    for ranks in map(int, options.ranks.split(",")):
        for schedule, slots in (("dynamic", 1), ("static", 1), ("dynamic", 2)):
            errors.append(stand_in_case(programs, options.work / "simulation", fake.resolve(),
                                        ranks, schedule, slots))
    return errors


def arguments_of(record, ranks):
    plan = record["plan"]
    slots = max(1, max(rank["slots"] for rank in record["ranks"]))
    grid = plan["grid"]
    seams = ["--seams", grid["seams"]] if grid["seams"] != "halo" else []
    dedicated = ["--dedicated-coordinator"] if record["ranks"][0]["slots"] == 0 else []
    return ["--ranks", ranks, "--slots", slots, "--schedule", plan["schedule"],
            "--sections", grid["sections"], "--shape", grid["shape"], *seams,
            "--threads", plan["threads"], "--in-flight", plan["in_flight"], *dedicated]


def scene(options, programs):
    heading()
    errors = []
    for file in options.speedup:
        found = json.loads(file.read_text())
        if found.get("format") != "mpipov-speedup":
            raise TestFailure(f"'{file}' is not what mpipov-validate speedup writes")
        rows = [row for row in found["rows"] if row["record"] and not row["failure"]]
        folder = fresh_folder(options.work / "simulation")
        for schedule in sorted({(row["schedule"], row["dedicated"]) for row in rows}):
            same = [row for row in rows if (row["schedule"], row["dedicated"]) == schedule]
            source = (file.parent / same[0]["record"]).resolve()
            # Starting and ending MPI, which no record knows of; a row's record is of its last run.
            totals = json.loads(source.read_text())["totals"]
            outside = same[0]["times"][-1] - totals["wall_seconds"]
            for row in same:
                record = json.loads((file.parent / row["record"]).read_text())
                said = simulate(programs, folder, ["--run", source,
                                                   *arguments_of(record, row["ranks"])])
                errors.append(line(f"{found['scene']} {row['name']}, from {same[0]['name']}",
                                   said + outside, row["median_seconds"]))
    return errors


def main():
    parser = argument_parser(__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    many = commands.add_parser("stand-in")
    many.add_argument("--ranks", default="8,16,32", metavar="LIST")
    many.add_argument("--fake", type=Path, help="the program fake_povray of the build")
    many.add_argument("--within", type=float, default=0.1, metavar="PART")
    real = commands.add_parser("scene")
    real.add_argument("speedup", type=Path, nargs="+", help="speedup.json of a quiet machine")
    real.add_argument("--within", type=float, default=0.1, metavar="PART")
    options = parser.parse_args()
    programs = programs_of(options)
    options.work = options.work.resolve()
    errors = (stand_in if options.command == "stand-in" else scene)(options, programs)
    if not errors:
        raise TestFailure("there is nothing to compare")
    print(f"largest error {100 * max(errors):.1f} %, limit {100 * options.within:.0f} %")
    return 0 if max(errors) <= options.within else 1


if __name__ == "__main__":
    report(main)
