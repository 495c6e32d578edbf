"""docs/seams.md out of the records of seams_survey.py: what is said there, and its tables."""

import json
import textwrap
from collections import Counter
from statistics import median

from markdown_table import table

KINDS = ("plain", "aligned", "halo1", "halo2", "halo4")
SECTIONS = (2, 8, 32)
LEVELS = 255
CLEAR = 16  # levels: about 6 % of full scale
LONG = 8  # pixels of a seam in a row
SHORT = {"identical": "=", "differs": "≠", "within noise": "≈", "beyond noise": "!",
         "failed": "failed"}


def is_noisy(noise):
    """With so little noise that it cannot be measured, a scene is judged as one without."""
    return bool(noise and noise.get("renders") and not noise.get("why_not_enough"))


class Case:
    """One image in sections: what the record says of it, with names of its own."""

    def __init__(self, scene, folder, data):
        self.scene, self.folder, self.data = scene, folder, data
        self.kind = data["seams"] + (str(data["halo"]) if data["seams"] == "halo" else "")
        self.sections = data["sections"]
        self.verdict = data["verdict"]["verdict"]
        compared = data["comparison"] or {}
        self.failed = not compared
        self.differing = compared.get("differing", 0)
        largest = compared.get("largest")
        self.largest = abs(largest["full_scale"]) * LEVELS if largest else 0
        self.ssim = (compared.get("ssim") or {}).get("value")
        self.pixels = compared.get("pixels", 1)
        self.run = compared.get("run") or {}

    def longest_run(self):
        runs = [seam["longest_run"]["length"] for seam in self.run.get("seams", [])
                if seam["longest_run"]]
        return max(runs, default=0)

    def step(self):
        return [self.run["step"][where]["mean_step"] for where in ("seams", "controls")]

    def self_check(self):
        """Per seam: (was it checked, did the overlaps disagree, does the result differ there)."""
        record = json.loads((self.folder / self.data["run"]).read_text())["seams"]
        by_sections = {(seam["a"], seam["b"]): seam for seam in self.run["seams"]}
        for seam in record:
            found = by_sections[seam["a"], seam["b"]]
            yield seam["checked"], seam["differing"] > 0, found["differing_touching"] > 0

    def cell(self):
        if self.failed:
            return "failed"
        if self.verdict == "identical":
            return "="
        ssim = f"{self.ssim:.4f}" if self.ssim is not None else "-"
        return f"{self.differing} / {self.largest:.0f} / {ssim} {SHORT[self.verdict]}"


def percent(part, whole):
    return f"{100 * part / whole:.1f} %" if whole else "-"


def exact_table(cases):
    rows = []
    for kind in KINDS:
        for sections in SECTIONS:
            group = [c for c in cases if c.kind == kind and c.sections == sections]
            differ = [c for c in group if c.differing]
            if not group:
                continue
            rows.append([
                kind, sections, len(group), len(group) - len(differ),
                f"{median(c.differing for c in differ):.0f}" if differ else "-",
                max((c.differing for c in group), default=0),
                f"{max(c.largest for c in group):.0f}",
                f"{min((c.ssim for c in group if c.ssim is not None), default=1):.4f}",
                sum(c.largest >= CLEAR for c in group),
                sum(c.longest_run() >= LONG for c in group)])
    return table(["seams", "tiles", "scenes", "identical", "pixels, median where they differ",
                  "pixels, most", "largest (of 255)", "lowest SSIM",
                  f"scenes with a pixel off by {CLEAR} or more",
                  f"scenes with {LONG} differing pixels in a row at a seam"], rows)


def noisy_table(cases):
    rows = []
    for kind in KINDS:
        for sections in SECTIONS:
            group = [c for c in cases if c.kind == kind and c.sections == sections]
            if not group:
                continue
            verdicts = Counter(c.verdict for c in group)
            steps = [c.step() for c in group if c.differing]
            steps = [(a, b) for a, b in steps if a is not None and b is not None]
            rows.append([kind, sections, len(group),
                         *(verdicts[v] for v in ("identical", "within noise", "beyond noise")),
                         *(f"{median(s[i] for s in steps):.2f}" if steps else "-"
                           for i in (0, 1))])
    return table(["seams", "tiles", "scenes", "identical", "within noise", "beyond noise",
                  "step at the seams, median", "midway between, median"], rows)


def alarm_table(records):
    """Each noise render judged against the others: the pixel test once a scene, the step test once
    a layout of seams."""
    pixel, step = [0, 0], [0, 0]
    for _, _, record in records:
        for index, case in enumerate(c for c in record["cases"] if c["verdict"]["quiet"]):
            quiet = case["verdict"]["quiet"]
            if index == 0:
                pixel[0] += quiet["pixel_alarms"]
                pixel[1] += quiet["renders"]
            step[0] += quiet["step_alarms"]
            step[1] += quiet["renders"]
    return table(["test", "equally right renders judged", "called damaged", "rate", "allowed"],
                 [["sample by sample", pixel[1], pixel[0], percent(*pixel), "1 %"],
                  ["step at the seams", step[1], step[0], percent(*step), "1 %"]])


def self_check_table(cases):
    rows = []
    for kind in KINDS[2:]:
        tally = Counter(state for case in cases if case.kind == kind and not case.failed
                        for state in case.self_check())
        seams = sum(tally.values())
        checked = sum(n for (was, _, _), n in tally.items() if was)
        found = tally[True, True, False] + tally[True, True, True]
        rows.append([kind, seams, checked, found, tally[True, True, False],
                     tally[True, True, True], tally[True, False, True],
                     sum(n for (was, _, bad), n in tally.items() if not was and bad)])
    return table(["seams", "seams of all images", "checked", "overlaps disagreed",
                  "of these right in the end", "of these not", "agreed, and yet not right",
                  "not checked and not right"], rows)


def filled(text):
    return textwrap.fill(" ".join(text.split()), 100, break_on_hyphens=False)


def answer(cases):
    """What the figures say of the 1999 paper's "not noticeable"."""
    plain = [case for case in cases if case.kind == "plain"]
    most = max(SECTIONS)
    many = [case for case in plain if case.sections == most]
    differ = [case for case in many if case.differing]
    steps = [step for step in (case.step() for case in differ) if None not in step]
    aligned = [case for case in cases if case.kind == "aligned"]
    share = 100 * max(case.differing / case.pixels for case in plain)
    return filled(f"""The 1999 paper cut images as `plain` does, with antialiasing of method 1, and found its
seams not noticeable. In {most} tiles {len(differ)} of {len(many)} such scenes differ from the serial
render, {sum(case.largest >= CLEAR for case in many)} of them by {CLEAR} levels or more in some pixel:
measurable nearly always. But it is few pixels ({share:.1f} % of the picture at most, in any cut),
SSIM is never below {min(case.ssim for case in plain if case.ssim is not None):.3f}, and the picture
does not step: across the seams the mean step of the error is
{median(step[0] for step in steps):.3f} levels in the median scene, midway between them
{median(step[1] for step in steps):.3f}. What differs are edges that cross a seam, or run along it: a
pixel is antialiased in one picture and not in the other, and neither looks wrong beside the other,
even in the longest runs ({max(case.longest_run() for case in plain)} pixels). So "not noticeable" holds
for an eye that has no serial render to compare with, and for nothing else. On the block grid there is
nothing to notice: {sum(not case.differing for case in aligned)} of {len(aligned)} aligned images are
the serial render bit for bit, at no cost; the others differ in
{max(case.differing for case in aligned)} pixel at most, which the shadow cache decides
([povray.md](povray.md)).""")


def scene_rows(cases):
    by_row = {}
    for case in cases:
        by_row.setdefault((case.scene, case.kind), {})[case.sections] = case
    rows = []
    for (scene, kind), row in sorted(by_row.items(), key=lambda item: (
            item[0][0], KINDS.index(item[0][1]))):
        if any(case.verdict != "identical" for case in row.values()):
            rows.append([scene, kind, *(row[n].cell() if n in row else "left out"
                                        for n in SECTIONS)])
    return rows


def page(records, left_out, size):
    """records: (name, folder, seams.json)."""
    complete = [entry for entry in records if entry[2]["complete"] and not entry[2]["failure"]]
    cases = {"exact": [], "noisy": []}
    for name, folder, record in complete:
        kind = "noisy" if is_noisy(record["noise"]) else "exact"
        cases[kind] += [Case(name, folder, case) for case in record["cases"]]
    names = {kind: {case.scene for case in group} for kind, group in cases.items()}
    debian = sum(name.startswith("debian/") for name, _, _ in complete)
    versions = complete[0][2]["versions"]
    broken = [(name, record["failure"] or "interrupted") for name, _, record in records
              if not record["complete"] or record["failure"]]
    rejected = "".join(f"- {name}: {why}\n" for name, why in [*broken, *left_out])
    made = filled(f"""Made by `ci/seams_survey.py table` from the records of `ci/seams_survey.py run`, POV-Ray
{versions['povray']}: {len(complete) - debian} scenes of our own with the options of
`scenes/scenes.json`, and {debian} of Debian's examples with `+A0.1 +AM1`, {size[0]} x {size[1]}
pixels, in 2, 8 and 32 tiles, compared with the serial render by `mpipov-validate seams`: plain and
aligned with POV-Ray's default blocks, halo with the render in one block. Differences are in levels
of 255.""")
    return f"""# What cutting an image up does at the seams

{made}

## Is it noticeable?

{answer(cases['exact'])}

In scenes with noise of their own the tests below find most plain seams, since single pixels of edges
lie far outside that noise, and so does a halo of one pixel in some. Aligned seams pass, but where
radiosity had a cache for each section, as it was when this was measured (`--radiosity independent` now):
there the brightness steps at the seams by more than between serial renders; with samples that sections
share it does not ([radiosity.md](radiosity.md)). A halo of 2 or 4 passes there too, with a test of less power: three noises add up
where the reference in one block is not the one that the noise was measured with.

## Scenes whose pixels do not depend on the order of rendering: {len(names['exact'])}

Or hardly: where other block orders change a pixel or two, POV-Ray's shadow cache does.

{exact_table(cases['exact'])}

## Scenes whose pixels do: {len(names['noisy'])}

No cut can give the serial image there, nor does a second serial render in another order. The
verdict says whether an image in sections is farther from serial renders than they are from each
other.

{noisy_table(cases['noisy'])}

How often the two tests call a serial render damaged, each judged against the other serial renders
of its scene at the same seams:

{alarm_table([entry for entry in complete if entry[0] in names['noisy']])}

## What the neighbours' self-check sees

Sections with a halo render the same pixels at their seams. Where they disagree, the seam is
rendered again with twice the halo. Scenes whose pixels do not depend on the order only:

{self_check_table(cases['exact'])}

A halo of one pixel cannot be checked ([architecture.md](architecture.md)); what the check misses
travelled without a trace ([povray.md](povray.md)).

## Every scene

Differing pixels / largest difference / SSIM, and the verdict: = identical, ≠ differs as plain and
halo may, ≈ within the scene's noise, ! beyond it. A scene and kind of seams that is not listed is
identical at 2, 8 and 32 tiles.

{table(["scene", "seams", *(f"{n} tiles" for n in SECTIONS)],
       scene_rows([*cases['exact'], *cases['noisy']]))}

Identical throughout: {", ".join(sorted(
    name for name, _, record in complete
    if all(case["verdict"]["verdict"] == "identical" for case in record["cases"]))) or "none"}.

## Left out

{rejected or "Nothing."}"""
