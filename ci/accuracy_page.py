"""docs/accuracy.md out of the records of accuracy.py: what is said there, its tables and pictures."""

import shlex

from markdown_table import table

SWEEPS = ("antialiasing", "decomposition", "radiosity", "threads")


def seconds(row, key, digits=2):
    spread = row[f"{key}_seconds"]
    if spread["low"] == spread["high"]:
        return f"{spread['median']:.{digits}f}"
    return f"{spread['median']:.{digits}f} ({spread['low']:.{digits}f}..{spread['high']:.{digits}f})"


def error(found):
    if found is None:
        return ""
    return "identical" if found["identical"] else f"{found['rms']:.3g}"


def ssim(found):
    if found is None or found["identical"] or found["ssim"] is None:
        return ""
    return f"{found['ssim']:.5f}"


def setting_row(row, front):
    mark = " ★" if row["name"] in front else ""
    return (row["what"] + mark, seconds(row, "cpu"), seconds(row, "wall"),
            error(row["against_truth"]), ssim(row["against_truth"]), error(row["against_serial"]))


def truth_line(data):
    truth = data["truth"]
    stopped = f"; {truth['stopped']}" if truth["stopped"] else ""
    share = "" if truth["share_of_best"] is None else \
        f", {100 * truth['share_of_best']:.0f} % of the best setting's"
    return (f"Truth: {truth['samples_per_pixel']} samples a pixel ({truth['cpu_seconds']:.0f} CPU "
            f"seconds); its own error is {truth['error']:.3g}{share}{stopped}.")


def scene_section(name, title, data):
    front = data["front"]["cpu"]["settings"]
    image = data["image"]
    lines = [f"## {title}", "",
             f"`{shlex.join(data['arguments'])}`, {image['width']} x {image['height']} pixels.", "",
             f"**{data['sentence']}**" if data["sentence"] else "No law: the front's errors, as far as the truth tells them, do not span a halving.",
             "", truth_line(data), ""]
    lines += [f"{note[0].upper()}{note[1:]}.\n" for note in data["notes"]]
    lines += [f"![error against time](accuracy/{name}/tradeoff.png)", "",
              f"![the front's pictures](accuracy/{name}/crops.png)", "",
              "<details><summary>All settings</summary>", ""]
    rows = [setting_row(row, front) for row in data["rows"] if row["wall"]]
    lines += [table(("setting", "CPU s", "wall s", "error", "SSIM", "against serial"), rows), ""]
    if data["left_out"]:
        lines += ["Left out: " + "; ".join(f"{one['what']}: {one['why']}"
                                           for one in data["left_out"]) + ".", ""]
    lines += ["</details>", ""]
    return "\n".join(lines)


def best_of(data):
    rows = [row for row in data["rows"] if row["against_truth"]]
    return min(rows, key=lambda row: row["against_truth"]["rms"])


def by_name(data, name):
    return next((row for row in data["rows"] if row["name"] == name), None)


def against_serial(data, prefix):
    """The smallest and the largest error against serial of the settings of that name."""
    found = [row["against_serial"]["rms"] for row in data["rows"]
             if row["name"].startswith(prefix) and row["against_serial"]]
    if not found:
        return ""
    if max(found) == 0:
        return "identical"
    low, high = f"{min(found):.3g}", f"{max(found):.3g}"
    return low if low == high else f"{low}..{high}"


def overview(found):
    rows = []
    for title, data in found.values():
        law, best = data["front"]["cpu"]["law"], best_of(data)
        off = by_name(data, "aa-off")
        rows.append((title, f"{law['halving_costs']:.2f}" if law else "",
                     error(off["against_truth"]) if off else "", error(best["against_truth"]),
                     best["what"], f"{100 * data['truth']['share_of_best']:.0f} %",
                     against_serial(data, "aligned"), against_serial(data, "plain"),
                     against_serial(data, "halo")))
    return table(("scene", "halving the error costs, CPU time", "error without antialiasing",
                  "least error", "by", "the truth's own error of that",
                  "aligned against serial", "plain", "halo"), rows)


def page(found):
    host = next(iter(found.values()))[1]["host"]
    parts = [
        "# Accuracy against time", "",
        "Made by `ci/accuracy.py measure` and `ci/accuracy.py page`: `mpipov-validate tradeoff` of eight "
        f"scenes, each setting one to three times, on a shared virtual machine of {host['cores']} cores ({host['cpu']}) that had other "
        "things to do. Errors do not depend on that, CPU seconds little, wall seconds much.", "",
        HOW, "", "## All scenes", "", overview(found), "", WHAT, ""]
    parts += [scene_section(name, title, data) for name, (title, data) in found.items()]
    return "\n".join(parts)


HOW = """## How to read it

- **Error**: root mean square over all pixels and colour channels, in levels of 255 of the sRGB-encoded
  picture, taken from renders of 16 bits. **Truth** is the mean of two renders at 8 and 10 times the size
  without antialiasing, in linear light, of which, where that is not enough, each pixel is itself
  supersampled; their difference tells the truth's own error (`validate/supersample.h` has the formula,
  [povray.md](povray.md) what it relies on). A measured error is that of the setting and of the truth
  together (root of the squares): where the truth's own is 30 % of it, it comes out 5 % too large, at 65 %
  by a third, at 80 % by two thirds.
- **★ and the line in the plots**: the Pareto front by CPU seconds: no other setting is as fast and as
  accurate. The dashed line is the law fitted to it, the truth's own error taken out, and settings left out
  whose error is less than twice that. Where what is left does not span a halving there is no law.
- **Against serial**: the distance from one serial render with the same antialiasing; for halo from that in
  one block (`+BS` of the longer side), which is what halo reproduces.
- Antialiasing is swept by serial renders; depth, threshold, seams and sections are changed one at a time."""

WHAT = """- **Sections**: aligned ones are the serial render where the scene does not depend on the order of
  rendering, and a halo of 2 is the one in one block, or within a thousandth of a level: cutting costs CPU
  time (each launch parses the scene again) and no accuracy. What plain seams change is less than the error
  of the antialiasing itself, but for radiosity.
- **Radiosity**: its pictures differ from the serial one by more than sections or antialiasing explain, and
  from the truth by as much as the serial one does: what better antialiasing cannot mend is the scene's own
  radiosity. Shared samples bring sections closer to both. The truth is two pictures with caches of their
  own, and as uncertain as these differ.
- **Focal blur**: antialiasing adds little to the rays that the blur takes anyway, so halving the error by it
  is dear.
- **Depth before threshold**: with method 1 and from depth 3, threshold 0.1 on, depth 5 brings more than
  threshold 0.01, but for focal blur, where it brings as much."""
