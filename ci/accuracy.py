#!/usr/bin/python3
"""What accuracy costs in eight scenes: measures it on this machine, and writes docs/accuracy.md.

    accuracy.py measure [SCENE...]   goes on from an interrupted run; all scenes: about 40 minutes
    accuracy.py page                 docs/accuracy.md and its pictures from the records

Scenes: SCENES below by name. Only CPU seconds and errors mean anything where the machine has other
things to do meanwhile.

Exit codes: 0 ok, 2 usage, 77 nothing to measure.
"""

import json
import shutil
import subprocess
from dataclasses import dataclass

from accuracy_page import page
from page_script import page_script
from program_runs import ROOT, Skip, programs_of, report

PICTURES = ("tradeoff.png", "crops.png")


@dataclass(frozen=True)
class Scene:
    title: str
    file: str  # from the top of the repository
    options: tuple
    more: tuple = ()  # of mpipov-validate


SCENES = {
    "edges": Scene("Edges", "scenes/effects/reflection.pov", ("+W320", "+H240", "+A0.1", "+AM1")),
    "horizon": Scene("Textures to the horizon", "scenes/basic/checker.pov",
                     ("+W320", "+H240", "+A0.1", "+AM1")),
    "radiosity": Scene("Radiosity", "scenes/effects/radiosity.pov",
                       ("+W160", "+H120", "+A0.1", "+AM1")),
    "soft_shadows": Scene("Soft shadows", "scenes/effects/area_light.pov",
                          ("+W320", "+H240", "+A0.1", "+AM1")),
    "focal_blur": Scene("Focal blur", "scenes/effects/focal_blur.pov",
                        ("+W128", "+H96", "+A0.1", "+AM1")),
    "media": Scene("Media", "scenes/effects/media.pov", ("+W160", "+H120", "+A0.1", "+AM1")),
    "photons": Scene("Photons", "scenes/effects/photons.pov", ("+W160", "+H120", "+A0.1", "+AM1")),
    "isosurface": Scene("Isosurface", "scenes/effects/isosurface.pov",
                        ("+W160", "+H120", "+A0.1", "+AM1")),
}
REPEAT = 2
TRUTH_SECONDS = 300


def measure_scene(name, options, programs):
    scene = SCENES[name]
    folder = options.work / name
    argv = [programs.validate, "tradeoff", scene.file, *scene.options, *scene.more,
            "--repeat", REPEAT, "--truth-seconds", TRUTH_SECONDS, "--out", folder,
            "--povray", programs.povray, "--mpiexec", programs.mpiexec]
    print(f"--- {name}", flush=True)
    subprocess.run([str(word) for word in argv], cwd=ROOT, check=True)


def measure_command(options):
    programs = programs_of(options)
    options.work.mkdir(parents=True, exist_ok=True)
    for name in options.scene or SCENES:
        measure_scene(name, options, programs)
    return 0


def page_command(options):
    found = {}
    pictures = options.page.parent / "accuracy"
    for name, scene in SCENES.items():
        folder = options.work / name
        if not (folder / "tradeoff.json").exists():
            continue
        data = json.loads((folder / "tradeoff.json").read_text())
        if not data["complete"]:
            continue
        found[name] = (scene.title, data)
        (pictures / name).mkdir(parents=True, exist_ok=True)
        for picture in PICTURES:
            shutil.copyfile(folder / picture, pictures / name / picture)
    if not found:
        raise Skip(f"no tradeoff.json in '{options.work}': accuracy.py measure makes them")
    options.page.write_text(page(found))
    print(options.page)
    return 0


def measure_arguments(parser):
    parser.add_argument("scene", nargs="*", choices=list(SCENES), metavar="SCENE")


def main():
    return page_script(__doc__, "accuracy", measure_command, page_command, measure_arguments)


if __name__ == "__main__":
    report(main)
