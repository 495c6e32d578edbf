"""The cases of scene_suite.py: how each scene of our own is rendered in sections.

A case is called SCHEDULE.npRANKS, and .independent with samples not shared; what else varies (ranks,
shape) is dealt out over the scenes, so that all values occur and no scene runs them all.
"""

from dataclasses import dataclass, replace

from scene_list import all_scenes

SHAPES = ("columns", "rows", "tiles")
SCHEDULES = ("static", "dynamic")
RANKS = (1, 2, 1, 3)  # a test with more than one has the machine to itself
MOST_SECONDS = 2  # of CPU: scenes that take longer are rendered at half their size
BLOCK = 32  # edge of POV-Ray's render blocks: aligned sections are made of them
# Sections with samples of their own show at the seams (docs/radiosity.md): a verdict that did not see
# them would see no other seam like them.
NOT_SHARED = "independent"


@dataclass(frozen=True)
class Case:
    schedule: str
    ranks: int
    shape: str
    seams: tuple
    sections: int
    radiosity: str = "auto"

    def name(self):
        return f"{self.schedule}.np{self.ranks}{self.suffix()}"

    def suffix(self):
        return "" if self.radiosity == "auto" else f".{self.radiosity}"

    def arguments(self):
        return ["--radiosity", self.radiosity, "--schedule", self.schedule, "--ranks", self.ranks,
                "--shape", self.shape, "--seams", ",".join(self.seams),
                "--sections", self.sections]

    def verdicts(self):
        """What the cases are called in seams.json."""
        return {f"{self.schedule}.np{self.ranks}.{self.shape}.{kind}.g{self.sections}{self.suffix()}"
                for kind in self.seams}


def suite_scenes():
    def half(scene):
        return replace(scene, size=tuple(side // 2 for side in scene.size))

    return [half(scene) if scene.serial_seconds > MOST_SECONDS else scene
            for scene in all_scenes()]


def cases_of(scene):
    """One a schedule. Ranks and shape go round with the scene's place in the list."""
    index = suite_scenes().index(scene)
    seams = ("aligned",) if scene.order_dependent or scene.sees_sections() \
        else ("aligned", "plain")
    cases = []
    for turn, schedule in enumerate(SCHEDULES):
        ranks = RANKS[(index + turn) % len(RANKS)]
        shape = SHAPES[index % len(SHAPES)]
        across, down = (-(-side // BLOCK) for side in scene.size)
        most = {"columns": across, "rows": down, "tiles": across * down}[shape]
        # More sections than ranks with dynamic, so that there is something to hand out.
        wanted = max(2, ranks) if schedule == "static" else 2 * ranks + 1
        cases.append(Case(schedule, ranks, shape, seams, min(most, wanted)))
    if scene.effects.get("radiosity"):
        cases.append(replace(cases[-1], radiosity=NOT_SHARED))
    return cases
