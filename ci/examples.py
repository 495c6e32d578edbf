#!/usr/bin/python3
"""Does mpipov render every scene of Debian's examples that POV-Ray renders, kept to its folders?

By hand: 396 scenes, a quarter of an hour. Each is rendered at 64 x 48 by POV-Ray alone and then by
mpipov in the same folder, so that files which the scene writes are there already. Both must come out
well, or neither; where no pixel depends on the order of rendering both must have the same bits, but
for a few that the shadow cache may decide (docs/povray.md).

    examples.py run [--only TEXT]     prints a line a scene that is not so, and how many are

Exit codes: 0 ok, 1 a scene comes out otherwise, 2 usage, 77 the examples are not installed.
"""

import collections
import json
import shutil

from program_runs import (Skip, TestFailure, argument_parser, fresh_folder, programs_of, report,
                          run)
from scene_list import EXAMPLES

SIZE = ["+W64", "+H48", "-D"]
MOST_SECONDS = 120  # of either; POV-Ray alone needs longer for one of them
RARE = 1000  # one pixel in so many, at the most, by the shadow cache


def ended(argv, folder):
    """The exit code and what was printed; None where it took too long."""
    try:
        done = run(argv, folder, seconds=MOST_SECONDS)
    except TestFailure:
        return None, f"took longer than {MOST_SECONDS} s"
    return done.code, done.stderr.strip()


def wrong_pixels(programs, folder):
    """What is wrong with mpipov's image, or nothing; and which kind of scene it is."""
    if json.loads((folder / "run.json").read_text())["plan"]["effects"]["order_dependent"]["on"]:
        return None, "depend on the order of rendering"
    said, _ = programs.compare("alone.png", "image.png", folder)
    if said["identical"]:
        return None, "identical"
    if said["differing"] * RARE <= said["pixels"]:
        return None, f"differ in no more than one pixel of {RARE}"
    return f"{said['differing']} of {said['pixels']} pixels differ", "differ"


def outcome(programs, scene, folder):
    """What is wrong, or nothing; and what it is counted as."""
    arguments = [scene, f"+L{scene.parent}", *SIZE]
    alone, _ = ended([programs.povray, *arguments, "+Oalone.png", "+WT1"], folder)
    if alone is None:
        return None, "take POV-Ray too long"
    code, said = ended([programs.mpipov, *arguments, "+Oimage.png", "--progress", "none"], folder)
    if (alone == 0) != (code == 0):
        return f"POV-Ray ends with {alone}, mpipov with {code}: {said}", "end otherwise"
    if code != 0:
        return None, "cannot be rendered by either"
    return wrong_pixels(programs, folder)


def main():
    parser = argument_parser(__doc__)
    parser.add_argument("command", choices=["run"])
    parser.add_argument("--only", default="", metavar="TEXT", help="scenes with this in their name")
    options = parser.parse_args()
    scenes = [scene for scene in sorted(EXAMPLES.rglob("*.pov")) if options.only in str(scene)]
    if not scenes:
        raise Skip(f"no scenes in '{EXAMPLES}': install povray-examples (see ci/install-deps)")
    programs = programs_of(options)
    counts, wrong = collections.Counter(), []
    for scene in scenes:
        name = scene.relative_to(EXAMPLES)
        folder = fresh_folder(options.work.resolve() / "examples" / str(name).replace("/", "_"))
        what, kind = outcome(programs, scene, folder)
        counts[kind] += 1
        if what:
            wrong.append(f"{name}: {what}")
            print(wrong[-1], flush=True)
        else:
            shutil.rmtree(folder)
    print(f"{len(scenes)} scenes: " + ", ".join(f"{n} {kind}" for kind, n in counts.most_common()))
    if wrong:
        raise TestFailure("\n".join(wrong))
    return 0


if __name__ == "__main__":
    report(main)
