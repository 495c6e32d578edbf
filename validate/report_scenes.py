"""One seams.json as the page shows it: pictures, plot, effects, noise, and its cases in groups."""

import hashlib
import json

import report_images as images
import report_plots as plots
from report_cases import VERDICTS, case_view, curve_of, severity
from report_stability import conditioning_of
from report_text import (at, command, count, listing, mapping, number, plural, rounded,
                         seam_place, seconds, text, texts, whole)

MOST_PICTURED = 12  # groups of cases in a scene
MOST_CURVES = 8


def effects_of(data):
    """([(name, why)] of what the scene calls for, [(name, why)] of what not)."""
    on, off = [], []
    for name, effect in mapping(at(data, "effects")).items():
        if name == "render":  # what the rest costs: no effect
            continue
        (on if at(effect, "on") is True else off).append(
            (name.replace("_", " "), text(at(effect, "why"), "")))
    return on, off


def noise_of(noise):
    if not isinstance(noise, dict):
        return None
    return {"why_not": text(at(noise, "why_not")) or text(at(noise, "why_not_enough")),
            "sigma": rounded(at(noise, "sigma")),
            "mean": [rounded(at(noise, "mean", key)) for key in ("low", "high")],
            "known": number(at(noise, "mean", "low")) is not None,
            "steps": any(number(at(r, "mean_step")) is not None
                         for r in listing(at(noise, "renders"))),
            "renders": [{"name": text(at(r, "name"), "?"), "argv": command(texts(at(r, "argv"))),
                         "differing": count(at(r, "differing_pixels")),
                         **{key: rounded(at(r, key))
                            for key in ("mean", "rms", "mean_step", "local_step")}}
                        for r in listing(at(noise, "renders"))]}


def band_of(noise):
    rows = [[number(at(row, key)) for key in ("distance", "low", "high")]
            for row in listing(at(noise, "by_distance"))]
    return [row for row in rows if None not in row]


def plot_of(pairs, noise):
    """pairs: (label, case), one a picture. None where there is nothing to draw."""
    curves = [(label, *curve_of(case)) for label, case in pairs]
    curves = [curve for curve in curves if curve[1]][:MOST_CURVES]
    if not curves:
        return None
    unit = text(at(pairs[0][1], "comparison", "unit"), "level")
    renders = len(listing(at(noise, "renders")))
    label = f"noise: {plural(renders, 'other serial render')}" if renders else "noise"
    return plots.error_by_distance(curves, band_of(noise), unit, label)


def plots_of(pairs, data):
    """[(title, picture)]: noise was measured by distance from the seams of the first case that ran,
    so its band says nothing about cases whose seams lie elsewhere."""
    noise = at(data, "noise")
    ran = [case for case in listing(at(data, "cases")) if at(case, "comparison", "run")]
    if not band_of(noise) or not ran:
        found = [("Error by distance from a seam", plot_of(pairs, None))]
    else:
        lines = seam_lines(ran[0])
        found = [("Error by distance from a seam",
                  plot_of([pair for pair in pairs if seam_lines(pair[1]) == lines], noise)),
                 ("The same where seams lie elsewhere than the noise was measured",
                  plot_of([pair for pair in pairs if seam_lines(pair[1]) != lines], None))]
    return [(title, plot) for title, plot in found if plot]


def seam_lines(case):
    """{index: line} of the seams whose place is known."""
    found = {}
    for index, seam in enumerate(listing(at(case, "comparison", "run", "seams"))):
        place = [whole(at(seam, key)) for key in ("position", "from", "to")]
        if None not in place and 0 <= place[1] < place[2]:
            found[index] = images.Line(at(seam, "vertical") is True, *place)
    return found


def crop_of(case, error):
    """(box, what is there): the place that is worst to look at."""
    height, width = error.shape[:2]
    seams = seam_lines(case)
    tested = whole(at(case, "verdict", "step_test", "seam"))
    reason = "of all seams the stretch that differs most"
    if at(case, "verdict", "step_test", "beyond") and tested in seams:
        seams = {tested: seams[tested]}
        reason = "its step is the largest; the stretch that differs most"
    worst, along, index = max(((*images.worst_place(error, line), index)
                               for index, line in seams.items()), default=(0, 0, None))
    if worst > 0:
        line = seams[index]
        x, y = (line.position, along) if line.vertical else (along, line.position)
        place = seam_place(at(case, "comparison", "run", "seams", index))
        return images.crop_box(x, y, width, height), f"the seam at {place}: {reason}"
    y, x = divmod(int(error.max(axis=2).argmax()), width)
    elsewhere = f"nothing differs within {images.NEAR} pixels of a seam; " if seams else ""
    return (images.crop_box(x, y, width, height),
            f"{elsewhere}the largest difference, at x {x}, y {y}")


def ticks(case, box):
    """Where seams cross the box, in percent of its width (columns) and of its height (rows)."""
    x0, y0, x1, y1 = box
    lines = seam_lines(case).values()
    columns = {line.position for line in lines if line.vertical and x0 < line.position < x1}
    rows = {line.position for line in lines if not line.vertical and y0 < line.position < y1}
    return {"columns": [round(100 * (x - x0) / (x1 - x0), 3) for x in sorted(columns)],
            "rows": [round(100 * (y - y0) / (y1 - y0), 3) for y in sorted(rows)]}


def pictures_of(case, serial, stitched):
    error = images.difference(serial, stitched)
    height, width = error.shape[:2]
    exposure = images.exposure_of(serial)
    factor = images.amplification(error)
    drawn, grown = images.difference_picture(error, factor)
    box, place = crop_of(case, error)
    a, b = (images.to_bytes(p, exposure) for p in (serial, stitched))
    near = images.cut(error, box)
    near_factor = images.amplification(near)
    reduced = images.reduce(a).shape[1] != width
    notes = [images.tone_mapping(serial, exposure),
             f"shown reduced, {width} x {height} in the file" if reduced else None]
    return {"serial": images.data_uri(images.reduce(a)),
            "stitched": images.data_uri(images.reduce(b)),
            "difference": images.data_uri(drawn), "factor": factor, "grown": grown,
            "white": rounded(serial.full_scale / factor),
            "ticks": ticks(case, (0, 0, width, height)),
            "width": width, "height": height, "notes": [note for note in notes if note],
            "crop": {"serial": images.data_uri(images.cut(a, box)),
                     "stitched": images.data_uri(images.cut(b, box)),
                     "difference": images.data_uri(images.amplified(near, near_factor)),
                     "factor": near_factor,
                     "white": rounded(serial.full_scale / near_factor), "place": place,
                     "width": box[2] - box[0], "height": box[3] - box[1],
                     "box": f"x {box[0]}..{box[2] - 1}, y {box[1]}..{box[3] - 1}",
                     "ticks": ticks(case, box)}}


class Scene:
    """Reads each picture once."""

    def __init__(self, folder, data):
        self.folder, self.data, self.loaded = folder, data, {}

    def load(self, name):
        if name not in self.loaded:
            try:
                self.loaded[name] = images.load(self.folder, name)
            except images.Unreadable as problem:
                self.loaded[name] = problem
            except Exception as problem:  # libraries' own: a picture less is no reason for no page
                self.loaded[name] = images.Unreadable(f"'{name}' cannot be shown: {problem}")
        if isinstance(self.loaded[name], images.Unreadable):
            raise self.loaded[name]
        return self.loaded[name]

    def reference_name(self, case):
        return text(at(self.data, "references", text(at(case, "reference"), ""), "image"))

    def key(self, case):
        """The same for cases whose picture, reference and seams are the same."""
        stitched = self.load(text(at(case, "image")))
        return (text(at(case, "reference")), hashlib.sha1(stitched.pixels.tobytes()).hexdigest(),
                json.dumps(listing(at(case, "comparison", "run", "seams"))))

    def groups(self, cases):
        """[(its cases' views, one of them as in the file, pictures | None, why none)]."""
        groups, by_key = [], {}
        for view, case in cases:
            pictures, why, key = None, None, None
            try:
                key = self.key(case)
                if key in by_key:
                    by_key[key]["views"].append(view)
                    continue
                if sum(g["pictures"] is not None for g in groups) >= MOST_PICTURED:
                    why = f"not pictured: the {MOST_PICTURED} worst are"
                else:
                    pictures = pictures_of(case, self.load(self.reference_name(case)),
                                           self.load(text(at(case, "image"))))
            except images.Unreadable as problem:
                if not view["failure"]:
                    why = str(problem)
            except Exception as problem:  # pictures less are no reason for no page
                why = f"{type(problem).__name__}: {problem}"
            group = {"views": [view], "case": case, "pictures": pictures, "why": why,
                     "reference": text(at(case, "reference"), "?")}
            groups.append(group)
            if key:
                by_key[key] = group
        return groups

    def alone(self):
        """The serial render, for a scene of which nothing else is pictured."""
        for name, reference in mapping(at(self.data, "references")).items():
            try:
                picture = self.load(text(at(reference, "image")))
            except images.Unreadable:
                continue
            exposure = images.exposure_of(picture)
            return {"src": images.data_uri(images.reduce(images.to_bytes(picture, exposure))),
                    "name": name, "note": images.tone_mapping(picture, exposure)}
        return None


def size_text(image):
    width, height, channels = (whole(at(image, key)) for key in ("width", "height", "channels"))
    names = texts(at(image, "channels"))
    parts = [f"{width} × {height}" if width and height else None,
             text(at(image, "type")), text(at(image, "depth")),
             plural(channels, "channel") if channels else "".join(names)]
    return ", ".join(part for part in parts if part)


def scene_view(entry):
    """`failed_whole` is set where the scene as a whole failed or its file is damaged."""
    folder, data = at(entry, "folder"), at(entry, "data")
    problems = texts(at(entry, "problems"))
    failure = text(at(data, "failure"))
    cases = [(case_view(folder, data, case), case) for case in listing(at(data, "cases"))
             if isinstance(case, dict)]
    cases.sort(key=lambda pair: severity(pair[0]))
    views = [view for view, _ in cases]
    scene = Scene(folder, data)
    groups = scene.groups([pair for pair in cases if pair[0]["verdict"] != "identical"])
    drawn = []
    try:
        drawn = plots_of([(g["views"][0]["name"], g["case"]) for g in groups], data)
    except Exception as problem:  # a plot less is no reason for no page
        problems.append(f"the errors cannot be plotted: {type(problem).__name__}: {problem}")
    on, off = effects_of(data)
    incomplete = isinstance(data, dict) and at(data, "complete") is not True
    failed_whole = ("failed" if failure else "damaged" if problems else
                    "incomplete" if incomplete else None)
    return {
        "title": text(at(data, "scene")), "file": at(entry, "file"),
        "problems": problems, "failure": failure,
        "failed_whole": failed_whole,
        "ok": not failed_whole and all(view["ok"] for view in views),
        "size": size_text(at(data, "image")), "arguments": command(texts(at(data, "arguments"))),
        "povray": text(at(data, "versions", "povray")),
        "mpipov": text(at(data, "versions", "mpipov")), "effects": on, "without": off,
        "references": [(name, seconds(at(r, "seconds")), command(texts(at(r, "argv"))))
                       for name, r in mapping(at(data, "references")).items()],
        "noise": noise_of(at(data, "noise")),
        "conditioning": conditioning_of(at(data, "conditioning")), "views": views, "groups": groups,
        "identical": [view for view in views if view["verdict"] == "identical"],
        "alone": None if any(g["pictures"] for g in groups) else scene.alone(),
        "plots": drawn,
        "skipped": [(text(at(one, "name"), "?"), text(at(one, "why"), ""))
                    for one in listing(at(data, "skipped"))],
        "tally": [(verdict, VERDICTS[verdict], n) for verdict in VERDICTS
                  if (n := sum(view["verdict"] == verdict for view in views))],
    }
