"""Which cases of the hard scenes are run: the whole product, and a few dealt out over the scenes.

A group is one picture cut by one grid: its runs, by other ranks and schedules, must have the same
bits. Groups are called SEAMS.SHAPE.SIZE.TYPE.AA; no processes here.
"""

import itertools
import re
from dataclasses import dataclass

BLOCK = 32  # edge of POV-Ray's render blocks: aligned sections are made of them
SEAMS = ("aligned", "halo")
SHAPES = ("columns", "rows", "tiles")
SIZES = ("full", "one_pixel")
TYPES = {"png8": "+FN8", "png16": "+FN16", "exr": "+FE"}
ANTIALIASING = ("AM1", "off")
RANKS = (1, 2, 4)
SCHEDULES = ("static", "dynamic")
GROUP_NAME = re.compile(r"(aligned|halo)\.(columns|rows|tiles)\.(full|one_pixel)\."
                        r"(png8|png16|exr)\.(AM1|off)")
# Where sections are to be one pixel wide or high. Aligned ones are where the 32-pixel grid leaves
# one pixel over; a halo allows that everywhere, in tiles of single pixels too.
ALIGNED_ONE_PIXEL = ((65, 33), {"columns": 3, "rows": 2, "tiles": 6})
HALO_ONE_PIXEL = {"columns": ((16, 12), 16), "rows": ((16, 12), 12), "tiles": ((5, 4), 20)}
FULL_SECTIONS = {"columns": 4, "rows": 3, "tiles": 6}


@dataclass(frozen=True)
class Group:
    seams: str
    shape: str
    size: str
    type: str
    aa: str

    @staticmethod
    def parse(name):
        match = GROUP_NAME.fullmatch(name)
        if not match:
            raise ValueError(f"'{name}' is no group: SEAMS.SHAPE.SIZE.TYPE.AA")
        return Group(*match.groups())

    def name(self):
        return f"{self.seams}.{self.shape}.{self.size}.{self.type}.{self.aa}"

    def exact(self):
        """Whether sections must be as the serial render: method 1 looks across a halo's edges."""
        return self.seams == "aligned" or self.aa == "off"

    def grid(self, scene):
        """Width and height of the picture, and the number of its sections."""
        if self.size == "full":
            unit = BLOCK if self.seams == "aligned" else 1
            across, down = (-(-side // unit) for side in scene.size)
            most = {"columns": across, "rows": down, "tiles": across * down}[self.shape]
            return scene.size, min(most, FULL_SECTIONS[self.shape])
        if self.seams == "aligned":
            size, sections = ALIGNED_ONE_PIXEL
            return size, sections[self.shape]
        return HALO_ONE_PIXEL[self.shape]

    def picture(self, scene):
        """The arguments that POV-Ray and mpipov get alike."""
        (width, height), _ = self.grid(scene)
        off = ["-A"] if self.aa == "off" else []
        return [scene.file, f"+W{width}", f"+H{height}", *scene.options, *off, TYPES[self.type]]

    def serial(self, scene):
        """What the serial render gets besides: a halo stands for antialiasing in one block."""
        return [f"+BS{max(self.grid(scene)[0])}"] if self.seams == "halo" else []

    def cutting(self, scene):
        return ["--seams", self.seams, "--shape", self.shape, "--sections", self.grid(scene)[1]]


@dataclass(frozen=True)
class Run:
    schedule: str
    ranks: int

    def name(self):
        return f"{self.schedule}.np{self.ranks}"


def whole_product():
    for values in itertools.product(SEAMS, SHAPES, SIZES, TYPES, ANTIALIASING):
        yield Group(*values)


def all_runs(group):
    """Cut by cost the sections are others, by what was measured: the same bits only if aligned."""
    schedules = (*SCHEDULES, "cost") if group.seams == "aligned" else SCHEDULES
    return [Run(schedule, ranks) for schedule in schedules for ranks in RANKS]


def dealt_part():
    """A part of the product that takes an hour: all groups but for the file type, which goes round,
    and for aligned ones without antialiasing; each with every number of ranks, schedules in turns."""
    types = tuple(TYPES)
    groups = [values for values in itertools.product(SEAMS, SHAPES, SIZES, ANTIALIASING)
              if (values[0], values[3]) != ("aligned", "off")]
    for index, (seams, shape, size, aa) in enumerate(groups):
        runs = [Run(SCHEDULES[(index + turn) % 2], ranks) for turn, ranks in enumerate(RANKS)]
        yield Group(seams, shape, size, types[(index + index // 3) % 3], aa), runs


def cases_of(scenes, scene):
    """(group, runs) of the default test run: two groups a scene, one with either kind of seams;
    what else varies goes round, so that all pairs of values occur over the scenes."""
    index = scenes.index(scene)
    types, shape = tuple(TYPES), SHAPES[index % 3]
    kind = "exr" if "exr" in scene.output else types[index // 3 % 3]
    first = Group("aligned", shape, SIZES[index % 2], kind, ANTIALIASING[index // 2 % 8 == 3])
    second = Group("halo", SHAPES[(index + 1) % 3], SIZES[(index + 1) % 2],
                   types[(index // 3 + 1) % 3], ANTIALIASING[index // 2 % 2])
    alternate = ("dynamic", "cost")[index % 4 == 3]
    turned = index // 3 % 2
    few, many, other = ((1, 4, 2), (2, 4, 1), (1, 2, 4))[index // 2 % 3]
    yield first, [Run(("static", alternate)[turned], few), Run((alternate, "static")[turned], many)]
    yield second, [Run(SCHEDULES[turned], other), Run(SCHEDULES[1 - turned], few)]


def missing_pairs(scenes):
    """Pairs of values of two factors that no case of the default test run has."""
    factors = {"seams": SEAMS, "shape": SHAPES, "size": SIZES, "type": tuple(TYPES),
               "aa": ANTIALIASING, "schedule": SCHEDULES, "ranks": RANKS}
    seen = set()
    for scene in scenes:
        for group, runs in cases_of(scenes, scene):
            for run in runs:
                values = {**vars(group), **vars(run)}
                seen.update((one, values[one], other, values[other])
                            for one, other in itertools.combinations(factors, 2))
    return [(one, a, other, b) for one, other in itertools.combinations(factors, 2)
            for a, b in itertools.product(factors[one], factors[other])
            if (one, a, other, b) not in seen]
