#!/usr/bin/python3
"""How stable hard cases are: measures how well-conditioned scenes are, and writes docs/stability.md.

    stability.py measure [--only GROUP]   takes up an interrupted run; half an hour on two cores;
                                          writes docs/stability/conditioning.json
    stability.py page                     docs/stability.md from the records in docs/stability

GROUP: hard, ours or debian. Measured are scenes/hard, the other scenes of ours and Debian's examples
(package povray-examples) that render within a limit of CPU seconds. The page's other records are made
by hard_cases.py, peers.py and the fuzzers (docs/stability/*.json); what lacks is said on the page.

Exit codes: 0 ok, 2 usage, 77 nothing to measure.
"""

import json
import os
import subprocess
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import seams_survey
from page_script import page_script
from program_runs import ROOT, Skip, fresh_folder, programs_of, report
from scene_list import all_scenes, hard_scenes
from stability_page import page

RECORDS = ROOT / "docs" / "stability"
DEBIAN_SIZE = (128, 96)
DEBIAN_OPTIONS = ("+A0.3", "+AM1")
KEPT = ("scene", "complete", "failure", "order_dependent", "moved_by", "cameras", "noise_mean",
        "verdict")  # of a stability.json
KEPT_OF_MOVE = ("move", "pixels", "differing", "answering", "mean", "rms", "largest", "nonfinite",
                "amplification")


@dataclass(frozen=True)
class Scene:
    group: str
    name: str
    file: Path
    arguments: tuple


def own(group, scenes):
    return [Scene(group, scene.name.replace(".", "/", 1), scene.file,
                  tuple(map(str, scene.arguments()))) for scene in scenes]


def debian():
    """Every eighth first: an interrupted run has seen all kinds of them."""
    width, height = DEBIAN_SIZE
    listed = list(seams_survey.debian_scenes(1))
    return [Scene("debian", scene.name, scene.file,
                  (str(scene.file), f"+L{scene.file.parent}", f"+W{width}", f"+H{height}",
                   *DEBIAN_OPTIONS))
            for first in range(8) for scene in listed[first::8]]


GROUPS = {"hard": lambda: own("hard", hard_scenes()), "ours": lambda: own("ours", all_scenes()),
          "debian": debian}


def why_too_long(scene, povray, folder):
    """None where the scene renders within the limit that docs/seams.md has too."""
    argv = [povray, *scene.arguments, "+WT1", "-D", "-P", "+Otry.png"]
    done = subprocess.run(argv, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True,
                          preexec_fn=seams_survey.limit_cpu, check=False)
    if done.returncode < 0:
        return f"takes more than {seams_survey.MOST_CPU_SECONDS} CPU seconds"
    return f"POV-Ray alone fails on it (exit code {done.returncode})" if done.returncode else None


def finished(folder):
    """What is to be said of a scene; None where it was not measured to the end."""
    try:
        return json.loads((folder / "found.json").read_text())
    except (OSError, ValueError):
        return None


def measure_scene(scene, options):
    folder = options.work / scene.group / scene.name
    if finished(folder):
        return
    fresh_folder(folder)
    programs = programs_of(options)
    found = {"group": scene.group, "name": scene.name}
    why = why_too_long(scene, programs.povray, folder) if scene.group == "debian" else None
    if why:
        found["left_out"] = why
    else:
        argv = [programs.validate, "stability", *scene.arguments, "--povray", programs.povray,
                "--out", folder]
        done = subprocess.run([str(word) for word in argv], cwd=folder, capture_output=True,
                              text=True, stdin=subprocess.DEVNULL, check=False)
        (folder / "log.txt").write_text(done.stdout + done.stderr)
        record = json.loads((folder / "stability.json").read_text())
        found |= {key: record[key] for key in KEPT}
        found["moves"] = [{key: move[key] for key in KEPT_OF_MOVE} for move in record["moves"]]
        found["exit_code"] = done.returncode
    (folder / "found.json").write_text(json.dumps(found, indent=1) + "\n")
    verdict = (found.get("verdict") or {}).get("verdict")
    print(scene.name, why or verdict or found["failure"], sep=": ", flush=True)


def measure_command(options):
    scenes = [scene for name in options.only or GROUPS for scene in GROUPS[name]()]
    with ThreadPoolExecutor(options.jobs) as pool:
        for _ in pool.map(lambda scene: measure_scene(scene, options), scenes):
            pass
    write_record(options)
    return 0


def write_record(options):
    """Of all that was measured so far."""
    found, listed = [], {}
    for name, scenes_of in GROUPS.items():
        try:
            scenes = scenes_of()
        except Skip as reason:
            print(f"{name}: {reason}")
            continue
        listed[name] = len(scenes)
        found += [one for one in (finished(options.work / name / scene.name) for scene in scenes)
                  if one]
    RECORDS.mkdir(parents=True, exist_ok=True)
    part = RECORDS / "conditioning.json.part"
    part.write_text(json.dumps({"format": "mpipov-conditioning", "version": 1,
                                "listed": listed, "debian_size": DEBIAN_SIZE, "debian_options": DEBIAN_OPTIONS,
                                "scenes": found}, indent=1) + "\n")
    os.replace(part, RECORDS / "conditioning.json")


def measure_arguments(parser):
    parser.add_argument("--only", action="append", choices=list(GROUPS))
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), metavar="N",
                        help="scenes measured at once (default: one a core)")


def page_command(options):
    records = {file.stem: json.loads(file.read_text()) for file in sorted(RECORDS.glob("*.json"))}
    if not records:
        raise Skip(f"no records in '{RECORDS}': stability.py measure makes one")
    options.page.write_text(page(records))
    print(options.page)
    return 0


def main():
    return page_script(__doc__, "stability", measure_command, page_command, measure_arguments)


if __name__ == "__main__":
    report(main)
