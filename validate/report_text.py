"""Reading values out of results that may lack anything, and showing them as text."""

import math
import shlex

NONE = "–"


def at(data, *path):
    """data[path[0]][path[1]]..., or None where any of it is not there."""
    for step in path:
        if isinstance(data, dict) and isinstance(step, str):
            data = data.get(step)
        elif isinstance(data, list) and isinstance(step, int) and -len(data) <= step < len(data):
            data = data[step]
        else:
            return None
    return data


def mapping(value):
    return value if isinstance(value, dict) else {}


def listing(value):
    return value if isinstance(value, list) else []


def texts(value):
    return [entry for entry in listing(value) if isinstance(entry, str)]


def number(value):
    """The value, if it is a finite number, else None."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return None
    return value if math.isfinite(value) else None


def whole(value):
    found = number(value)
    return int(found) if found is not None else None


def text(value, otherwise=None):
    return value if isinstance(value, str) and value else otherwise


def count(value):
    found = whole(value)
    return NONE if found is None else f"{found:,}".replace(",", "\u202f")


def rounded(value, digits=3):
    """`digits` significant ones; no exponent between 0.001 and a million."""
    found = number(value)
    if found is None:
        return NONE
    if found == 0:
        return "0"
    if not 1e-3 <= abs(found) < 1e6:
        return f"{found:.{digits - 1}e}"
    places = max(0, digits - 1 - math.floor(math.log10(abs(found))))
    return f"{found:.{places}f}"


def fixed(value, places):
    found = number(value)
    return NONE if found is None else f"{found:.{places}f}"


def seconds(value):
    found = number(value)
    if found is None:
        return NONE
    return f"{found:.0f}" if found >= 100 else f"{found:.1f}"


def plural(n, what):
    return f"{count(n)} {what}" if n == 1 else f"{count(n)} {what}s"


def command(argv):
    return shlex.join(str(word) for word in argv)


def seam_place(seam):
    """Where a seam, or a line along which one could be, is in the picture."""
    across, along = ("x", "y") if at(seam, "vertical") else ("y", "x")
    position, low, high = (whole(at(seam, key)) for key in ("position", "from", "to"))
    if position is None:
        return "place unknown"
    if low is None or high is None:
        return f"{across} = {position}"
    return f"{across} = {position}, {along} {low}..{high - 1}"
