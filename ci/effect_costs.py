"""What effects cost: what mpipov says against renders in full; for ci/effects.

Each scene is rendered by POV-Ray alone at full size, with one thread: as it is, without
antialiasing, and without antialiasing at lower quality levels. What an effect cost is the
difference of two of these in CPU seconds of tracing, by POV-Ray's own statistics. Focal blur has no
option: the scene's text is rendered without its aperture.
"""

import json
import re

from markdown_table import table
from program_runs import fresh_folder, require_success, run
from scene_list import scene_named

SIZE = ("+W480", "+H360")
SCENES = ("basic.uniform", "basic.corner", "basic.demo", "effects.reflection",
          "effects.refraction", "effects.area_light", "effects.area_light_jitter",
          "effects.focal_blur", "effects.media", "effects.subsurface")
# Effect: the renders that have it and have it not. Without antialiasing "9" is all of it.
DIFFERENCES = {"antialiasing": ("all", "9"), "area_light": ("5", "4"), "transparency": ("6", "5"),
               "reflection": ("8", "6"), "media": ("9", "8"), "subsurface": ("9", "8"),
               "focal_blur": ("9", "unblurred")}


def trace_seconds(programs, file, more, folder):
    done = require_success(run([programs.povray, file, f"+L{file.parent}", *SIZE, *more, "+WT1",
                                "-D", "-P", "+Orender"], folder))
    return float(re.findall(r"with ([0-9.]+) CPU-seconds", done.stderr)[-1])


def levels_of(effects):
    return {level for name in effects for level in DIFFERENCES.get(name, ()) if level.isdigit()}


def measured(programs, scene, effects, folder):
    """CPU seconds: {effect: cost}, and of the whole."""
    options = [*scene.options]
    seconds = {"all": trace_seconds(programs, scene.file, options, folder)}
    for level in sorted(levels_of(effects)):
        seconds[level] = trace_seconds(programs, scene.file, [*options, "-A", f"+Q{level}"], folder)
    if "focal_blur" in effects:
        unblurred = folder / "unblurred.pov"
        unblurred.write_text(re.sub(r"\baperture\s+\S+", "", scene.file.read_text()))
        seconds["unblurred"] = trace_seconds(programs, unblurred,
                                             [*options, f"+L{scene.file.parent}", "-A"], folder)
    costs = {name: seconds[DIFFERENCES[name][0]] - seconds[DIFFERENCES[name][1]]
             for name in effects if name in DIFFERENCES}
    return costs, seconds["all"]


def rows_of(programs, name, folder):
    scene = scene_named(name)
    done = require_success(programs.mpi(0, [scene.file, f"+L{scene.file.parent}", *SIZE,
                                            *scene.options, "-D", "--dry-run"], folder))
    said = json.loads(done.stdout)["effects"]
    on = [effect for effect in said if said[effect]["on"] and effect != "render"]
    costs, whole = measured(programs, scene, on, folder)
    yield name, "all", f"{said['render']['cpu_seconds']:.2f}", f"{whole:.2f}"
    for effect in on:
        if effect in costs:
            cost = said[effect]["cpu_seconds"]
            yield ("", effect, "not told" if cost is None else f"{cost:.2f}",
                   f"{costs[effect]:.2f}")


def cost_table(programs, folder):
    folder = fresh_folder(folder)
    rows = [row for name in SCENES for row in rows_of(programs, name, folder)]
    return table(("scene", "effect", "said, CPU s", "measured, CPU s"), rows)


def costs_section(programs, folder):
    width, height = (option[2:] for option in SIZE)
    return [f"Said of small renders, and measured in full, {width} x {height} pixels, one thread; "
            "CPU seconds of tracing.", "", cost_table(programs, folder)]
