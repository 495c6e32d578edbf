"""What exactness.py found of a whole product: SCENE.json, and a table of such files."""

import json
import sys
from pathlib import Path

from exactness_cases import Case


def earlier_results(file, scene):
    if not file.exists():
        return []
    matrix = json.loads(file.read_text())
    if matrix["size"] != scene["size"]:
        sys.exit(f"exactness: '{file}' is of another size, {matrix['size']}: remove it")
    return matrix["results"]


def write_results(file, scene, results):
    part = file.with_name(file.name + ".part")
    part.write_text(json.dumps({"format": "mpipov-exactness", "version": 1,
                                "scene": scene["name"], "size": scene["size"],
                                "results": results}, indent=1) + "\n")
    part.replace(file)


def describe(result):
    if result["identical"]:
        return f"{result['case']}: identical"
    at = result["largest"]
    return (f"{result['case']}: {result['differing']} pixels differ, by up to "
            f"{result['max_difference']:g} (x {at['x']}, y {at['y']}, {at['channel']})")


def summary_command(options):
    print(f"{'scene':<13}{'seams':<9}{'AA':<5}{'cases':>6}{'identical':>11}{'most pixels':>13}"
          f"{'largest':>9}")
    differing = {"exact": [], "close": [], "none": []}
    for file in options.files:
        matrix = json.loads(Path(file).read_text())
        groups = {}
        for result in matrix["results"]:
            case = Case.parse(result["case"])
            groups.setdefault((case.seams, case.aa), []).append(result)
            if not result["identical"]:
                differing[case.promise()].append(f"{matrix['scene']}.{describe(result)}")
        for (seams, aa), group in sorted(groups.items()):
            print(f"{matrix['scene']:<13}{seams:<9}{aa:<5}{len(group):>6}"
                  f"{sum(r['identical'] for r in group):>11}"
                  f"{max(r['differing'] for r in group):>13}"
                  f"{max(r['max_difference'] for r in group):>9g}")
    for title, cases in (("Differ with an overlap", differing["close"]),
                         ("Differ where none may", differing["exact"])):
        print("\n".join(["", f"{title}: {len(cases)}", *cases]))
    return 1 if differing["exact"] else 0
