"""What the runs of a hard scene came to: which promises are not kept, an entry of the record, a table.

A result is what hard_cases.py keeps of a run: its case, seconds, same_bits (as the first run of its
group), identical (to the serial render), pixels and max of the difference; or its failure.
"""

import json

from hard_design import Group
from markdown_table import table

RARE = 1000  # one pixel in so many, at the most, where one of POV-Ray's caches decides


def broken(scene, group, results):
    """Lines that say which promises are not kept."""
    lines = []
    for result in results:
        if "failure" in result:
            lines.append(f"{result['case']}: {result['failure']}")
        elif scene.order_dependent and group.size == "full" and not result["order_dependent"]:
            lines.append(f"{result['case']}: taken for a scene that does not depend on the order")
        elif not result["same_bits"]:
            lines.append(f"{result['case']}: other bits than {results[0]['case']}, the same grid")
        elif group.exact() and not scene.order_dependent and not result["identical"]:
            (width, height), _ = group.grid(scene)
            if not scene.rare_pixels or result["pixels"] * RARE > width * height:
                lines.append(f"{result['case']}: {result['pixels']} pixels differ from the serial "
                             f"render, by up to {result['max']:g}")
    return lines


def entry_of(scene, found):
    """A scene's entry of the record: what the runs came to, and those that differ one by one."""
    runs, wrong = [], []
    for name, results in found["groups"].items():
        runs += results
        wrong += broken(scene, Group.parse(name), results)
    done = [run for run in runs if "failure" not in run]
    # What depends on the order is never the serial render: its runs are held against each other.
    same = "same_bits" if scene.order_dependent else "identical"
    return {"name": scene.name.replace(".", "/"), "hard": scene.hard,
            "order_dependent": scene.order_dependent, "effects": sorted(scene.effects),
            "serial_seconds": scene.serial_seconds, "limit_seconds": scene.limit_seconds,
            "dealt": found["dealt"], "cases": len(runs), "failed": len(runs) - len(done),
            "groups": len(found["groups"]),
            "same_bits": sum(run["same_bits"] for run in done),
            "identical": sum(run[same] for run in done),
            "differing": [{"case": run["case"], "pixels": run["pixels"], "max": run["max"]}
                          for run in done if not run[same]],
            "broken": wrong, "most_seconds": max((run["seconds"] for run in done), default=None),
            "nonfinite": found["nonfinite"], "ill_conditioned": None}


def write_json(file, value):
    file.parent.mkdir(parents=True, exist_ok=True)
    part = file.with_name(file.name + ".part")
    part.write_text(json.dumps(value, indent=1) + "\n")
    part.replace(file)


def summary_table(record):
    rows = []
    for entry in record["scenes"]:
        differing = entry["differing"]
        nonfinite = entry["nonfinite"]
        rows.append([entry["name"], entry["cases"], entry["same_bits"], entry["identical"],
                     max((one["pixels"] for one in differing), default=0),
                     f"{max((one['max'] for one in differing), default=0):g}",
                     nonfinite["count"] if nonfinite else 0, entry["most_seconds"]])
    return table(["scene", "cases", "same bits", "as serial", "most pixels", "largest",
                  "not finite", "seconds"], rows)
