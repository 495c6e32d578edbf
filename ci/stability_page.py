"""docs/stability.md, from the records in docs/stability."""

from collections import Counter

from markdown_table import table

HEAD = """# Hard cases, and how stable they are

Made by `ci/stability.py page` from the records in `docs/stability`: what `ci/hard_cases.py matrix` and
`record`, `ci/stability.py measure`, `ci/peers.py` and the fuzzers found.
"""

HARD = """## Scenes that are hard for the arithmetic

`scenes/hard`, each rendered by `mpipov` in {cases} cases: 1, 2 and 4 ranks, static and dynamic, columns, rows and
tiles, `--seams aligned` and `halo`, sections one pixel wide too, as PNG of 8 and 16 bits and EXR, with antialiasing
of method 1 and without. *Same bits*: as the other runs on the same grid. *As serial*: as the serial render, or,
where the scene depends on the order of rendering (*), as the other runs on the same grid. The three columns of moves
say how many pixels change by more than a level of 255 where the camera moves by so much (below).
"""

CONDITIONING = """## Conditioning

`mpipov-validate stability SCENE` renders a scene serially as it is and with the camera's place multiplied by
1 + 1e-12, 1 + 1e-9 and 1 + 1e-6, and says how the picture answers. A pixel *answers* where it changes by more than
one level of 255; the *amplification* is the RMS difference as part of full scale divided by the move, of the whole
frame also where only a region is rendered.

| verdict | means |
|---|---|
| well-conditioned | no pixel answers a move of 1e-9 or less |
| well-conditioned but for spots | some do, no more than one in 1000: an edge lies on a sample |
| sensitive | more than one in 1000 answer 1e-9, not so many 1e-12: the answer shrinks with the move |
| ill-conditioned | more than one in 1000 answer 1e-12: rounding decides what is seen |
| cannot be told from noise | they do, but the scene depends on the order of rendering, and no more than twice as much as serial renders in other orders: one pixel that answers deals other random numbers to all that follow |

Why this rule: in a smooth picture an edge moves by m times the picture's size, so of an image W pixels wide the pixels
whose sample it crosses are m W of those at edges: none at 1e-9. A double rounds at 1e-16, so 1e-12 is nothing to the
scene and something to the arithmetic. One in 1000 leaves room for edges that lie on samples by construction.

`mpipov-validate seams` asks this where it would call a case wrong. Where the scene is ill-conditioned, and no pixel
differs from the serial render by more than it or one next to it answers to a move of 1e-9 or less, the verdict is
*ill-conditioned* and the seam is not blamed. Where one pixel differs by more, the verdict stands.
Where nearly all of a picture answers, that excuses much: damage beside pixels that answer by as much is not seen then.

How the camera is moved: the scene's files are not touched. A later camera statement cannot know the scene's camera, a
header cannot reach it, and keywords cannot be redefined; so a copy of the scene, in a temporary folder, gets
`scale 1 + Mpipov_Camera_Move` at the end of each camera statement, also of those in files that it includes, and POV-Ray
gets the number by `Declare=`. A scale about the origin multiplies the camera's place and turns nothing; where the
camera is at the origin it is shifted by so much of a unit. It is no silent nothing: where the copy's camera does
not print a mark as POV-Ray comes to it, or where with a move of 0 the copy is not the scene bit for bit, the command
ends with 3 and says what a scene can do itself. Where 1e-6 changes nothing, 1e-3 is tried too, and where that
changes nothing either it is said, and `--require-well` ends with 1. An include whose name the scene computes is not
found, and an orthographic camera's width is scaled as well.

    #ifndef (Mpipov_Camera_Move) #declare Mpipov_Camera_Move = 0; #end
    camera {{ location <1, 2, -5> look_at 0 scale 1 + Mpipov_Camera_Move }}

Whatever the verdict, the exit code is 0: it is a finding, not a failure. `--require-well` makes it 1.
"""

MOVES = (1e-12, 1e-9, 1e-6)
SHORT = {"well-conditioned": "well", "well-conditioned but for spots": "spots",
         "ill-conditioned": "**ill**", "sensitive": "**sensitive**",
         "cannot be told from noise": "not told"}
TROUBLE = ("ill-conditioned", "sensitive", "cannot be told from noise")


def verdict_of(one):
    return ((one or {}).get("verdict") or {}).get("verdict")


def move_cells(one):
    moves = {move["move"]: move for move in (one or {}).get("moves", [])}
    return [f"{moves[move]['answering']}" if move in moves else "-" for move in MOVES]


def verdict_cell(one):
    return SHORT.get(verdict_of(one), "-")


def limit_cell(scene):
    return f"{scene['most_seconds'] or 0:.1f} / {scene['limit_seconds']:.0f}"


def nonfinite_cell(found):
    if not found:
        return "none"
    x, y, channel = found["first"]
    return f"{found['count']}, first at ({x},{y}) {channel}"


def hard_part(scenes, conditioning):
    rows = []
    for scene in scenes:
        found = conditioning.get(scene["name"])
        star = " *" if scene["order_dependent"] else ""
        rows.append([scene["name"].removeprefix("hard/") + star, scene["hard"], limit_cell(scene),
                     scene["cases"], scene["same_bits"], scene["identical"],
                     nonfinite_cell(scene["nonfinite"]), *move_cells(found), verdict_cell(found)])
    counts = sorted({scene["cases"] for scene in scenes})
    cases = str(counts[0]) if len(counts) == 1 else f"{counts[0]} to {counts[-1]}"
    yield HARD.format(cases=cases)
    yield table(["scene", "what is hard", "longest run / limit, s", "cases", "same bits", "as serial",
                 "not finite", "1e-12", "1e-9", "1e-6", "conditioning"], rows) + "\n"
    broken = [f"- {scene['name']}: {line}" for scene in scenes for line in scene["broken"]]
    yield "Promises that were not kept:\n" if broken else "No promise was broken.\n"
    if broken:
        yield "\n".join(broken) + "\n"
    differing = [row for row in map(differing_row, scenes) if row]
    if differing:
        yield ("Cases that differ from the serial render, where that is no broken promise: a halo with "
               "antialiasing comes close to it, and pixels that the shadow cache decides are rare.\n")
        yield table(["scene", "cases", "most pixels", "largest, of full scale"], differing) + "\n"


def differing_row(scene):
    cases = scene["differing"]
    if not cases:
        return None
    return [scene["name"].removeprefix("hard/"), len(cases), max(one["pixels"] for one in cases),
            f"{max(one['max'] for one in cases):.3g}"]


def amplification_cell(one):
    first = (one.get("moves") or [{}])[0].get("amplification")
    return "-" if first is None else f"{first:.2g}"


def condition_rows(scenes):
    for one in scenes:
        yield [one["name"], *move_cells(one), amplification_cell(one), verdict_cell(one)]


def group_sentence(name, scenes):
    tally = Counter(verdict_of(one) for one in scenes if verdict_of(one))
    failed = [one for one in scenes if one.get("failure")]
    left_out = [one for one in scenes if one.get("left_out")]
    parts = [f"{n} {verdict}" for verdict, n in tally.most_common()]
    if failed:
        parts.append(f"{len(failed)} not measured")
    measured = len(scenes) - len(left_out)
    more = f" ({len(left_out)} more take longer or fail)" if left_out else ""
    return f"{name}, {measured} scenes{more}: {', '.join(parts)}."


def conditioning_part(record):
    groups = {name: [one for one in record["scenes"] if one["group"] == name]
              for name in ("hard", "ours", "debian")}
    yield CONDITIONING.format()
    head = ["scene", *("answering 1e-12", "1e-9", "1e-6"), "amplification at 1e-12", "verdict"]
    if groups["ours"]:
        yield "### Our other scenes\n"
        yield group_sentence("`scenes/basic` and `scenes/effects`", groups["ours"]) + "\n"
        yield table(head, condition_rows(groups["ours"])) + "\n"
    if groups["debian"]:
        width, height = record["debian_size"]
        yield "### Debian's examples\n"
        yield (f"At {width} x {height} pixels with `{' '.join(record['debian_options'])}`, those that "
               f"render within 2 CPU seconds; {len(groups['debian'])} of {record['listed']['debian']} were "
               "looked at, every eighth first. " + group_sentence("povray-examples", groups["debian"])
               + " The others:\n")
        bad = [one for one in groups["debian"] if verdict_of(one) in TROUBLE]
        yield table(head, condition_rows(bad)) + "\n"
        ways = Counter(one["moved_by"] for one in groups["debian"] if verdict_of(one))
        yield ("Moved by: " + ", ".join(f"{way} {n}" for way, n in ways.most_common())
               + ". What causes what was looked into: [povray.md](povray.md).\n")
        failed = [one for one in groups["debian"] if one.get("failure")]
        if failed:
            yield "Not measured:\n"
            yield "\n".join(f"- {one['name']}: {short(one['failure'])}" for one in failed) + "\n"


def short(failure):
    return failure.partition("; the scene can offer")[0].replace("\n", " ")


def missing(what, how):
    return f"{what}: no record yet ({how} makes it).\n"


def peers_part(record):
    """Pairs of images whose scores scikit-image and idiff were asked for too."""
    yield "## Peers\n"
    if not record:
        yield missing("SSIM, PSNR and RMS beside scikit-image's and `idiff`'s", "`ci/peers.py`")
        return
    pairs = record["pairs"]
    agreeing = sum(pair["agreements"] for pair in pairs)
    yield (f"SSIM, PSNR and RMS of {len(pairs)} pairs of images beside scikit-image's and `idiff`'s: "
           f"{agreeing} of {sum(pair['comparisons'] for pair in pairs)} numbers agree to the printed "
           "digits. Of the others it is said why not.\n")
    yield table(["pair", "RMS", "PSNR", "SSIM", "agree", "why not"],
                [[pair["what"], *(score(pair["ours"][key]) for key in ("rms", "psnr", "ssim")),
                  f"{pair['agreements']} of {pair['comparisons']}",
                  "; ".join(f"{key}: {why}" for key, why in pair["agree"].items()
                            if why is not True) or "-"] for pair in pairs]) + "\n"


def score(value):
    return "-" if value is None else f"{value:.6g}"


def fuzz_part(record):
    yield "## Fuzzers\n"
    if not record:
        yield missing("What reads text or JSON that others wrote, fed with damage", "`ci/fuzz`")
        return
    yield ("What reads text or JSON that others may have written, fed with damage "
           "([fuzzing.md](stability/fuzzing.md)).\n")
    yield table(["parser", "seconds", "inputs", "what was found, with its test"],
                [[one["name"], one["seconds"], one["executions"], "; ".join(one["found"]) or "nothing"]
                 for one in record["fuzzers"]]) + "\n"


def page(records):
    conditioning = records.get("conditioning", {"scenes": []})
    by_name = {one["name"]: one for one in conditioning["scenes"]}
    parts = [HEAD]
    if "hard" in records:
        parts += hard_part(records["hard"]["scenes"], by_name)
    else:
        parts += ["## Scenes that are hard for the arithmetic\n",
                  missing("Hard scenes", "`ci/hard_cases.py record`")]
        rows = [[one["name"], *move_cells(one), amplification_cell(one), verdict_cell(one)]
                for one in conditioning["scenes"] if one["group"] == "hard"]
        parts.append(table(["scene", "answering 1e-12", "1e-9", "1e-6", "amplification at 1e-12",
                            "verdict"], rows) + "\n")
    if conditioning["scenes"]:
        parts += conditioning_part(conditioning)
    parts += ["## Our own arithmetic\n",
              "What is promised of metrics, variances and costs, and which test holds it to that: "
              "[arithmetic.md](arithmetic.md).\n"]
    parts += [*peers_part(records.get("peers")), *fuzz_part(records.get("fuzz"))]
    return "\n".join(parts)
