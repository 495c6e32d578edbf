"""A stability.json as the page shows it, and the conditioning that a seams.json may have."""

import report_images as images
from report_text import at, command, count, listing, mapping, rounded, text, texts

WAYS = {"scale": "the camera’s place times 1 + move",
        "shift": "the camera shifted by so much of a unit of the scene",
        "declared": "Mpipov_Camera_Move, which the scene uses itself"}


def row_of(move, control=False):
    return {"move": rounded(at(move, "move"), 1) + (" (control)" if control else ""),
            "nonfinite": count(at(move, "nonfinite")) if at(move, "nonfinite") else "",
            **{key: count(at(move, key)) for key in ("differing", "answering")},
            **{key: rounded(at(move, key)) for key in ("mean", "rms", "largest", "amplification")}}


def conditioning_of(found):
    """What is said of a scene: also of the part of that name in a seams.json. None of none."""
    if not mapping(found):
        return None
    rows = [row_of(move) for move in listing(at(found, "moves"))]
    if mapping(at(found, "control")):
        rows.append(row_of(at(found, "control"), control=True))
    return {"verdict": text(at(found, "verdict", "verdict")),
            "well": at(found, "verdict", "well") is True,
            "why": text(at(found, "verdict", "why")) or text(at(found, "failure")),
            "rows": rows, "way": WAYS.get(text(at(found, "moved_by"), ""), "")}


def picture_of(folder, name):
    """As the page embeds it, or why there is none."""
    try:
        picture = images.load(folder, name)
        shown = images.to_bytes(picture, images.exposure_of(picture))
        return images.data_uri(images.reduce(shown)), None
    except images.Unreadable as problem:
        return None, str(problem)
    except Exception as problem:  # libraries' own: a picture less is no reason for no page
        return None, f"'{name}' cannot be shown: {problem}"


def pictures_of(folder, data):
    """([(caption, picture)], why one lacks)."""
    found, lacking = [], None
    for caption, name in (("As it is", text(at(data, "reference", "image"))),
                          ("The brighter, the smaller the move that a pixel answers",
                           text(at(data, "map")))):
        if not name:  # not kept
            continue
        picture, why = picture_of(folder, name)
        lacking = lacking or why
        if picture:
            found.append((caption, picture))
    return found, lacking


def problems_of(data):
    """[(verdict, line)] of what a stability.json tells itself."""
    if at(data, "complete") is False:
        why = text(at(data, "failure"))
        yield "incomplete", "not complete" + (f": {why}" if why else "")


def facts_of(data, folder):
    pictures, lacking = pictures_of(folder, data)
    image = mapping(at(data, "image"))
    size = (f"{count(at(image, 'width'))} × {count(at(image, 'height'))} pixels; " if image else "")
    return {"size": size, "arguments": command(texts(at(data, "arguments"))),
            "conditioning": conditioning_of(data), "pictures": pictures, "no_pictures": lacking}
