"""What a case of ci/hostile is: a scene, what is around it, and what must come of it."""

from dataclasses import dataclass, field

KEY = "the-key-that-nobody-may-see"
PICTURE = """camera { location <0, 0, -4> look_at 0 }
light_source { <5, 8, -6> 1 }
sphere { 0, 1 pigment { rgb x } }
"""
HEAD = "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n"
SAY = '#fopen F "{}" read\n#read (F, Text)\n#warning concat("read ", Text)\n#fclose F\n'
SMALL = ["+W64", "+H48", "-A", "+Oimage.png", "--progress", "none"]
RUN_SECONDS = 240


@dataclass
class Case:
    scene: str = ""                              # work/scene.pov; {home} is the home folder
    arguments: list = field(default_factory=lambda: ["scene.pov"])
    more: list = field(default_factory=list)     # options besides
    code: int = 3
    says: str = ""                               # a pattern that standard error must match
    files: dict = field(default_factory=dict)    # by name within the home folder
    links: dict = field(default_factory=dict)    # to what, within the home folder
    made: list = field(default_factory=list)     # files that the run makes, besides the image
    same_as_serial: bool = False
    may_tell: bool = False                       # the key was allowed
    seconds: float = RUN_SECONDS
    folder: str = "work"                         # of the run, within the home folder
    environment: dict = field(default_factory=dict)
    programs: dict = field(default_factory=dict)  # scripts; of no text: a copy of POV-Ray
    pipes: list = field(default_factory=list)
    validate: list = field(default_factory=list)  # subcommand and options: mpipov-validate, not mpipov


READ = "may not be read by a scene"
PROPOSED = "--allow-read '"


def refused_read(name, **more):
    return Case(SAY.format(name) + PICTURE, says=READ, **more)


def refused(statement, says, **more):
    return Case(statement + PICTURE, says=says, **more)
