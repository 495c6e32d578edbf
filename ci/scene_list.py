"""The scenes of our own, as scenes.json and hard.json list them, and where Debian's examples are; for
the scripts beside this file."""

import json
import os
import re
import sys
from dataclasses import dataclass
from pathlib import Path

from program_runs import ROOT

FOLDER = ROOT / "scenes"
# Of the package povray-examples.
EXAMPLES = Path(os.environ.get("MPIPOV_EXAMPLES", "/usr/share/doc/povray/examples"))


@dataclass(frozen=True)
class Scene:
    name: str  # with a dot for the slash, as tests are called: effects.fog
    file: Path
    size: tuple
    options: tuple
    effects: dict
    order_dependent: bool
    serial_seconds: float  # of CPU, at that size
    rare_pixels: bool  # a few depend on the order all the same: POV-Ray's shadow cache

    def arguments(self, *more):
        """What POV-Ray, mpipov and mpipov-validate are told alike."""
        width, height = self.size
        return [self.file, f"+W{width}", f"+H{height}", *self.options, *more]

    def sees_sections(self):
        """Antialiasing of method 1, POV-Ray's default, looks at the pixels next to its own."""
        on = any(re.match(r"\+A(?!M)", option) for option in self.options)
        return on and "+AM2" not in self.options


def all_scenes():
    listed = json.loads((FOLDER / "scenes.json").read_text())["scenes"]
    return [Scene(one["name"].replace("/", "."), FOLDER / one["file"], tuple(one["size"]),
                  tuple(one["options"]), one["effects"], one["order_dependent"],
                  one["serial_seconds"], one.get("rare_pixels", False))
            for one in listed]


@dataclass(frozen=True)
class HardScene(Scene):
    hard: str  # what is, in a sentence: the scene's first line
    limit_seconds: float  # of wall clock, for one run of mpipov on a busy machine
    not_finite: bool  # its EXR file holds infinities, or what is no number
    output: tuple  # png8, png16, exr
    exact_with: tuple  # options with which no pixel depends on the order: what that is due to


def hard_scenes():
    """Those of scenes/hard, whose tests are hard_cases.py's."""
    scenes = []
    for one in json.loads((FOLDER / "hard.json").read_text())["scenes"]:
        first = (FOLDER / one["file"]).read_text().partition("\n")[0]
        scenes.append(HardScene(
            one["name"].replace("/", "."), FOLDER / one["file"], tuple(one["size"]),
            tuple(one["options"]), one["effects"], one["order_dependent"], one["serial_seconds"],
            one.get("rare_pixels", False), first.removeprefix("// Hard: "), one["limit_seconds"],
            one.get("not_finite", False), tuple(one["output"]), tuple(one.get("exact_with", []))))
    return scenes


def scene_named(name, scenes=None):
    for scene in scenes or all_scenes():
        if scene.name == name:
            return scene
    sys.exit(f"no scene '{name}' in scenes.json: names are as in effects.fog")
