#!/usr/bin/python3
"""What does it save to follow the scene plan? Measures it, and writes docs/savings.md.

Each scene is rendered with mpipov and judged against a serial render, twice:

  with the plan       what the plan says of the scene decides: mpipov's own choice of grid, seams and
                      threads; a radiosity cache is made where there is radiosity; the noise floor is
                      measured, and SSIM computed, where pixels depend on the order of rendering, else
                      one serial render must be met bit for bit
  everything on       as if nothing was known of the scene: halo seams, one thread a launch and the
                      pinned grid, a radiosity cache, the noise floor, SSIM

    savings.py measure   takes up an interrupted run; a quarter of an hour on two cores
    savings.py page      docs/savings.md from the record

Exit codes: 0 ok, 1 a step failed, 2 usage, 77 nothing to measure.
"""

import json
import os
import resource
import time
from dataclasses import dataclass
from pathlib import Path

from page_script import page_script
from program_runs import (ROOT, Skip, TestFailure, fresh_folder, programs_of,
                          report, require_success, run)
from savings_page import page
from scene_list import all_scenes
from scene_list import EXAMPLES
from seams_survey import OPTIONS

WIDTH, HEIGHT = 224, 144
CACHE_SCALE = 4  # a cache of radiosity is made at a quarter of the size
TOO_LONG = {"subsurface/subsurface.pov"}  # its noise alone takes many minutes
EVERY = 3  # of the Debian scenes of scenes/debian_effects.json
PINNED_PIXELS, FEWEST_PINNED, MOST_PINNED = 40000, 4, 64  # as scene_plan.cpp
PROBE_LAUNCHES, RESOLVE_LAUNCHES = 5, 1


@dataclass(frozen=True)
class Scene:
    name: str
    file: Path
    options: tuple

    def arguments(self, width=WIDTH, height=HEIGHT):
        return [self.file, f"+L{self.file.parent}", f"+W{width}", f"+H{height}", *self.options,
                "-D"]


class Spent:
    """Launches of POV-Ray, CPU seconds of all processes, wall seconds."""

    def __init__(self):
        self.launches, self.cpu, self.wall = 0, 0.0, 0.0

    def run(self, argv, folder, launches=0, codes=(0,)):
        cpu = children_cpu()
        done = run(argv, folder)
        self.cpu += children_cpu() - cpu
        self.wall += done.seconds
        self.launches += launches
        if done.code not in codes:
            require_success(done)
        return done

    def as_json(self):
        return {"launches": self.launches, "cpu_seconds": self.cpu, "wall_seconds": self.wall}


def children_cpu():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def scenes():
    own = [Scene(scene.name, scene.file, scene.options) for scene in all_scenes()
           if scene.name.startswith("effects.")]
    listed = json.loads((ROOT / "scenes" / "debian_effects.json").read_text())["scenes"]
    debian = [Scene(one["file"].removesuffix(".pov"), EXAMPLES / one["file"], tuple(OPTIONS))
              for one in listed[::EVERY] if one["file"] not in TOO_LONG]
    if not EXAMPLES.is_dir():
        raise Skip(f"no scenes in '{EXAMPLES}': install povray-examples (see ci/install-deps)")
    return own + debian


def make_cache(spent, programs, scene, folder):
    """What makes sections read it; nothing where POV-Ray wrote none."""
    cache = folder / "cache.rca"
    spent.run([programs.povray, *scene.arguments(WIDTH // CACHE_SCALE, HEIGHT // CACHE_SCALE),
               "+RFO", f'+RF"{cache}"', "-P", "+Osmall"], folder, launches=1)
    return ["+RFI", f'+RF"{cache}"', "-RVP"] if cache.exists() and cache.stat().st_size else []


def render(spent, programs, scene, folder, more):
    spent.run([programs.mpipov, *scene.arguments(), *more, "--record", "run.json", "--progress",
               "none", "+Oimage"], folder)
    record = json.loads((folder / "run.json").read_text())
    spent.launches += record["totals"]["launches"]
    return record


def image_of(folder):
    return folder / "image.png"


def compare(spent, programs, reference, folder, ssim):
    spent.run([programs.validate, "compare", reference, image_of(folder),
               "--ssim" if ssim else "--no-ssim", "--json", "compare.json"], folder, codes=(0, 1))
    return json.loads((folder / "compare.json").read_text())["identical"]


def judge_by_noise(spent, programs, scene, folder):
    spent.run([programs.validate, "noise", *scene.arguments(), "--povray", programs.povray,
               "--out", "noise"], folder)
    found = json.loads((folder / "noise" / "noise.json").read_text())
    tried = found["noise"].get("tried", found["wanted"])
    spent.launches += len(found["references"]) + tried
    reference = folder / "noise" / found["references"]["default"]["image"]
    return compare(spent, programs, reference, folder, ssim=True)


def judge_bits(spent, programs, scene, folder):
    spent.run([programs.povray, *scene.arguments(), "+WT1", "-P", "+Oserial"], folder, launches=1)
    return compare(spent, programs, folder / "serial.png", folder, ssim=False)


def with_plan(programs, scene, folder):
    # The run's own probe says the same, but not before the run: this is not counted.
    done = require_success(run([programs.mpipov, *scene.arguments(), "--dry-run", "+Oimage"],
                               folder))
    effects = json.loads(done.stdout)["effects"]
    spent = Spent()
    more = make_cache(spent, programs, scene, folder) if effects["radiosity"]["on"] else []
    render(spent, programs, scene, folder, more)
    judge = judge_by_noise if effects["order_dependent"]["on"] else judge_bits
    identical = judge(spent, programs, scene, folder)
    return {**spent.as_json(), "identical": identical,
            "on": sorted(name for name, one in effects.items() if one["on"] and name != "render")}


def everything_on(programs, scene, folder):
    spent = Spent()
    cache = make_cache(spent, programs, scene, folder)
    sections = min(MOST_PINNED, max(FEWEST_PINNED, round(WIDTH * HEIGHT / PINNED_PIXELS)))
    record = render(spent, programs, scene, folder,
                    [*cache, "--seams", "halo", "--threads", 1, "--sections", sections])
    # Whoever makes no plan needs no small renders, only what the result will be.
    spent.launches -= PROBE_LAUNCHES - RESOLVE_LAUNCHES
    sections_cpu = sum(one["cpu_seconds"] for one in record["sections"] + record["repairs"])
    spent.cpu -= max(0, record["totals"]["cpu_seconds"] - sections_cpu)
    identical = judge_by_noise(spent, programs, scene, folder)
    return {**spent.as_json(), "identical": identical}


def measure(programs, scene, turn, folder):
    found = {"scene": scene.name}
    ways = {"plan": with_plan, "everything": everything_on}
    for name in sorted(ways, reverse=turn % 2 == 1):
        found[name] = ways[name](programs, scene, fresh_folder(folder / name))
        print(scene.name, name, json.dumps(found[name]), flush=True)
    return found


def measure_command(options):
    programs = programs_of(options)
    record = options.work / "savings.json"
    options.work.mkdir(parents=True, exist_ok=True)
    found = json.loads(record.read_text()) if record.exists() else []
    failed = False
    for turn, scene in enumerate(scenes()):
        if any(one["scene"] == scene.name for one in found):
            continue
        try:
            found.append(measure(programs, scene, turn, options.work / "scene"))
        except TestFailure as failure:
            print(f"{scene.name}: {failure}", flush=True)
            failed = True
            continue
        record.with_suffix(".new").write_text(json.dumps(found, indent=2) + "\n")
        os.replace(record.with_suffix(".new"), record)
    return 1 if failed else 0


def page_command(options):
    record = options.work / "savings.json"
    if not record.exists():
        raise Skip(f"no '{record}': savings.py measure makes it")
    options.page.write_text(page(json.loads(record.read_text()), (WIDTH, HEIGHT)))
    print(options.page)
    return 0


def main():
    return page_script(__doc__, "savings", measure_command, page_command)


if __name__ == "__main__":
    report(main)
