#!/usr/bin/python3
"""What sharing radiosity samples between sections does to the seams and what it costs.

    radiosity.py measure    takes up an interrupted run; about 40 minutes on 2 cores
    radiosity.py page       docs/radiosity.md's tables from the records

Verdicts are those of `mpipov-validate seams`. Speed-up with 2 ranks is measured in turns with the
serial render; with 8 and 64 it is simulated from one of those runs (docs/simulation.md).

Exit codes: 0 ok, 1 the default's seams show, 2 usage, 77 nothing to measure.
"""

import json
import statistics
import time
from dataclasses import dataclass
from pathlib import Path

from PIL import Image

from page_script import page_script
from program_runs import (ROOT, Skip, fresh_folder, programs_of, report,
                          require_success, run)
from radiosity_page import page, seams_show
from scene_list import EXAMPLES
from simulation_check import simulation

SHARING = ("independent", "shared", "shared:2", "joined", "joined:3")
TIMED = ("independent", "shared", "joined")
GRIDS = (("columns", 4), ("tiles", 16))
SIMULATED_RANKS = (2, 8, 64)
REPEAT = 2
PICTURED, PICTURE_GAP = "effects/radiosity", 8  # of our own, pixels
MARK = "<!-- what follows is written by ci/radiosity.py -->"


@dataclass(frozen=True)
class Scene:
    file: Path
    judged: tuple = ("+W320", "+H240", "-A")
    timed: tuple = ()  # sizes; empty: it is not


TIMED_SIZES = ((640, 480), (1600, 1200))
TIMED_OPTIONS = ("+A0.3",)
SCENES = {
    "radiosity/cornell": Scene(EXAMPLES / "radiosity" / "cornell.pov", timed=TIMED_SIZES),
    "effects/radiosity": Scene(ROOT / "scenes" / "effects" / "radiosity.pov", timed=TIMED_SIZES),
    "radiosity/radiosity2": Scene(EXAMPLES / "radiosity" / "radiosity2.pov"),
    "radiosity/radiosity_36": Scene(EXAMPLES / "radiosity" / "radiosity_36.pov",
                                    judged=("+W224", "+H144", "-A")),
    "radiosity/rad_def_test_37": Scene(EXAMPLES / "radiosity" / "rad_def_test_37.pov",
                                       judged=("+W224", "+H144", "-A")),
}


def write(file, found):
    file.write_text(json.dumps(found, indent=2) + "\n")


def judge(scene, folder, programs):
    """One seams.json for each grid."""
    common = [scene.file, f"+L{scene.file.parent}", *scene.judged, "-D"]
    serial = folder / "serial"
    if not (serial / "noise.json").exists():
        require_success(run([programs.validate, "noise", *common, "--out", serial, "--povray",
                             programs.povray], fresh_folder(folder), seconds=3600))
    found = []
    for shape, sections in GRIDS:
        out = folder / f"{shape}{sections}"
        done = run([programs.validate, "seams", *common, "--out", out, "--serial", serial,
                    "--ranks", 2, "--seams", "plain", "--shape", shape, "--sections", sections,
                    "--radiosity", ",".join(SHARING), "--povray", programs.povray,
                    "--mpiexec", programs.mpiexec], folder, seconds=3600)
        if done.code not in (0, 1):
            require_success(done)
        judged = json.loads((out / "seams.json").read_text())
        for case in judged["cases"]:
            case["run"] = json.loads((out / case["run"]).read_text())
        found.append({"shape": shape, "sections": sections, "judged": judged})
    return found


def timed_once(scene, size, sharing, folder, programs):
    """Wall seconds, and the record where mpipov rendered."""
    common = [scene.file, f"+L{scene.file.parent}", f"+W{size[0]}", f"+H{size[1]}", *TIMED_OPTIONS,
              "-D"]
    begin = time.monotonic()
    if sharing == "serial":
        require_success(programs.serial([*common, "+WT1", "+Oserial.png"], folder))
        return time.monotonic() - begin, None
    require_success(programs.mpi(2, [*common, "--slots", 1, "--radiosity", sharing, "--record",
                                     "run.json", "--progress", "none", "+Oimage.png"], folder))
    return time.monotonic() - begin, json.loads((folder / "run.json").read_text())


def measure_speed(scene, size, folder, programs):
    fresh_folder(folder)
    seconds = {sharing: [] for sharing in ("serial", *TIMED)}
    for turn in range(REPEAT):
        for sharing in sorted(seconds, reverse=turn % 2 == 1):
            taken, record = timed_once(scene, size, sharing, folder, programs)
            seconds[sharing].append(taken)
            if record:
                write(folder / f"{sharing}.json", record)
            print(f"{scene.file.name} {sharing}: {taken:.2f} s", flush=True)
    serial = statistics.median(seconds["serial"])
    simulated = {}
    for sharing in TIMED:
        said = simulation(programs, folder, ["--run", folder / f"{sharing}.json", "--ranks",
                                           ",".join(map(str, SIMULATED_RANKS)), "--against",
                                           f"{serial:.3f}"])
        simulated[sharing] = said["rows"]
    sections = json.loads((folder / "joined.json").read_text())["plan"]["grid"]["sections"]
    return {"size": size, "seconds": seconds, "simulated": simulated, "sections": sections}


def measure_command(options):
    programs = programs_of(options)
    for name, scene in SCENES.items():
        if not scene.file.exists():
            raise Skip(f"there is no '{scene.file}': install povray-examples (see ci/install-deps)")
        folder = options.work / name.replace("/", "_")
        folder.mkdir(parents=True, exist_ok=True)
        parts = {"grids": lambda place, scene=scene: judge(scene, place, programs)}
        for size in scene.timed:
            parts[f"speed{size[0]}x{size[1]}"] = lambda place, scene=scene, size=size: \
                measure_speed(scene, size, place, programs)
        for part, measure in parts.items():
            file = folder / f"{part}.json"
            if not file.exists():
                write(file, measure(folder / part))
    return 0


def write_picture(folder, file):
    """The columns of the first grid, with samples of their own and with shared ones."""
    shape, sections = GRIDS[0]
    images = [Image.open(folder / "grids" / f"{shape}{sections}" /
                         f"dynamic.np2.{shape}.plain.g{sections}.{sharing}" / "image.png")
              for sharing in ("independent", "joined")]
    width, height = images[0].size
    both = Image.new("RGB", (2 * width + PICTURE_GAP, height), "white")
    for place, image in enumerate(images):
        both.paste(image, (place * (width + PICTURE_GAP), 0))
    file.parent.mkdir(exist_ok=True)
    both.save(file, optimize=True)


def page_command(options):
    found = {}
    for name in SCENES:
        folder = options.work / name.replace("/", "_")
        if (folder / "grids.json").exists():
            found[name] = {"grids": json.loads((folder / "grids.json").read_text()),
                           "speed": [json.loads(file.read_text())
                                     for file in sorted(folder.glob("speed*x*.json"),
                                                        key=lambda file: file.stat().st_mtime)]}
    if not found:
        raise Skip(f"nothing in '{options.work}': radiosity.py measure makes it")
    written_by_hand, _, _ = options.page.read_text().partition(MARK)
    write_picture(options.work / PICTURED.replace("/", "_"),
                  options.page.parent / options.page.stem / "seams.png")
    options.page.write_text(f"{written_by_hand}{MARK}\n\n{page(found, SIMULATED_RANKS)}")
    print(options.page)
    return 1 if seams_show(found, "joined") else 0


def main():
    return page_script(__doc__, "radiosity", measure_command, page_command)


if __name__ == "__main__":
    report(main)
