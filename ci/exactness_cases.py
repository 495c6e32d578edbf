"""The cases of exactness.py: a way to render a scene in sections, and what it promises.

exactness_cases.json lists the scenes, the values of every dimension, and the cases of the default
test run.
"""

import itertools
import json
import re
import sys
from dataclasses import dataclass
from pathlib import Path

from program_runs import Skip
from scene_list import EXAMPLES

CASES = json.loads(Path(__file__).with_name("exactness_cases.json").read_text())
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


def whole_product(only):
    for schedule, ranks, shape, seams, aa in itertools.product(
            CASES["schedules"], CASES["ranks"], CASES["shapes"], CASES["seams"],
            CASES["antialiasing"]):
        case = Case(schedule, ranks, shape, seams, aa)
        if all(str(getattr(case, key)) in values for key, values in only.items()):
            yield case
