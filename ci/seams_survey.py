#!/usr/bin/python3
"""What do seams do to scenes in general? Measures many of them, and writes docs/seams.md.

Every scene of scenes/scenes.json, and Debian's examples (package povray-examples) that render
within a limit of CPU seconds, are rendered serially and by mpipov with plain, aligned and halo
seams, in 2, 8 and 32 tiles, by `mpipov-validate seams`; its seams.json is the record.

    seams_survey.py run [--jobs N] [--every N]   takes up an interrupted run; hours on two cores
    seams_survey.py table                        docs/seams.md from the records

224 x 144 pixels: the fewest of a usual shape that have 32 of POV-Ray's blocks (7 x 5).

Exit codes: 0 ok, 1 a verdict is not ok or a scene failed, 2 usage, 77 nothing to measure.
"""

import json
import os
import resource
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from program_runs import (ROOT, Skip, argument_parser, fresh_folder, programs_of, report)
from scene_list import EXAMPLES
from seams_survey_page import page

SIZE = (224, 144)
OPTIONS = ["+A0.1", "+AM1"]
SEAMS = "plain,aligned,halo:1,halo:2,halo:4"
SECTIONS = "2,8,32"
MOST_CPU_SECONDS = 2
# They come with frames of a clock, or are read by other scenes.
NO_SCENES = {"animations", "portfolio"}


@dataclass(frozen=True)
class Scene:
    name: str
    file: Path
    options: tuple
    limited: bool = True

    def arguments(self):
        # Some include files that lie beside them, where POV-Ray does not look by itself.
        return [self.file, f"+L{self.file.parent}", f"+W{SIZE[0]}", f"+H{SIZE[1]}", *self.options]


def our_scenes():
    for scene in json.loads((ROOT / "scenes" / "scenes.json").read_text())["scenes"]:
        yield Scene(scene["name"], ROOT / "scenes" / scene["file"], tuple(scene["options"]),
                    limited=False)


def debian_scenes(every):
    files = sorted(file for file in EXAMPLES.rglob("*.pov")
                   if file.relative_to(EXAMPLES).parts[0] not in NO_SCENES)
    if not files:
        raise Skip(f"no scenes in '{EXAMPLES}': install povray-examples (see ci/install-deps)")
    for file in files[::every]:
        name = file.relative_to(EXAMPLES).with_suffix("")
        yield Scene(f"debian/{name}", file, tuple(OPTIONS))


def limit_cpu():
    resource.setrlimit(resource.RLIMIT_CPU, (MOST_CPU_SECONDS, MOST_CPU_SECONDS + 1))


def why_left_out(scene, povray, folder):
    """None where the scene renders within the limit."""
    if not scene.limited:
        return None
    argv = [str(word) for word in (povray, *scene.arguments(), "+WT1", "-D", "-P", "+Otry.png")]
    done = subprocess.run(argv, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True,
                          preexec_fn=limit_cpu, check=False)
    (folder / "try.png").unlink(missing_ok=True)
    if done.returncode < 0:
        return f"takes more than {MOST_CPU_SECONDS} CPU seconds"
    return f"POV-Ray alone fails on it (exit code {done.returncode})" if done.returncode else None


def is_complete(folder):
    try:
        return json.loads((folder / "seams.json").read_text())["complete"]
    except (OSError, ValueError, KeyError):
        return False


def measure(scene, options):
    folder = options.work / scene.name
    left_out = folder / "left_out.json"
    if is_complete(folder) or left_out.exists():
        return
    fresh_folder(folder)
    programs = programs_of(options)
    why = why_left_out(scene, programs.povray, folder)
    if why:
        left_out.write_text(json.dumps({"scene": scene.name, "why": why}) + "\n")
        print(f"{scene.name}: {why}", flush=True)
        return
    # One rank: the pixels are the same for any number, which is tested elsewhere.
    argv = [programs.validate, "seams", *scene.arguments(), "--out", folder, "--shape", "tiles",
            "--seams", SEAMS, "--sections", SECTIONS, "--ranks", "1", "--povray", programs.povray,
            "--mpiexec", programs.mpiexec]
    with (folder / "log.txt").open("w") as log:
        code = subprocess.run([str(word) for word in argv], cwd=folder, stdin=subprocess.DEVNULL,
                              stdout=log, stderr=subprocess.STDOUT, check=False).returncode
    print(f"{scene.name}: exit code {code}", flush=True)


def run_command(options):
    scenes = [*our_scenes(), *debian_scenes(options.every)]
    with ThreadPoolExecutor(options.jobs) as pool:
        for _ in pool.map(lambda scene: measure(scene, options), scenes):
            pass
    return 0


def table_command(options):
    records, left_out = [], []
    for file in sorted(options.work.rglob("*.json")):
        name = str(file.parent.relative_to(options.work))
        if file.name == "seams.json":
            record = json.loads(file.read_text())
            records.append((name, file.parent, record))
        elif file.name == "left_out.json":
            left_out.append((name, json.loads(file.read_text())["why"]))
    if not records:
        raise Skip(f"no seams.json in '{options.work}': seams_survey.py run makes them")
    options.page.write_text(page(records, left_out, SIZE))
    print(options.page)
    ok = all(record["complete"] and case["verdict"]["ok"]
             for _, _, record in records for case in record["cases"])
    return 0 if ok else 1


def main():
    parser = argument_parser(__doc__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    run = commands.add_parser("run")
    run.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), metavar="N",
                     help="scenes measured at once (default: one a core)")
    run.add_argument("--every", type=int, default=1, metavar="N",
                     help="only every Nth of Debian's examples, in the order of their names")
    run.set_defaults(command=run_command)
    table = commands.add_parser("table")
    table.add_argument("--page", type=Path, default=ROOT / "docs" / "seams.md", metavar="FILE")
    table.set_defaults(command=table_command)
    options = parser.parse_args()
    options.work = options.work.resolve() / "seams_survey"
    options.work.mkdir(parents=True, exist_ok=True)
    return options.command(options)


if __name__ == "__main__":
    report(main)
