#!/usr/bin/python3
"""Damages an image that was rendered in sections, as a program that goes wrong would.

    damage.py KIND --section N [--other IMAGE] -- MPIEXEC ...

As a program it stands for mpiexec: it runs the true one, and damages the image that came of it.
mutations.py uses it so, and as a module. Debian's interpreter sees python3-openimageio.
"""

import argparse
import json
import subprocess
import sys
from pathlib import Path

import numpy

from image_pixels import read_image, write_image

BLURRED = 2  # pixels on either side of a seam


def keep_of(record, section):
    """The rectangle of a section, as slices of rows and columns."""
    keep = next(one["keep"] for one in record["sections"] if one["id"] == section)
    return slice(keep["y0"], keep["y1"]), slice(keep["x0"], keep["x1"])


def partner(section):
    """The section that is swapped with this one: of two that touch, the seam could look right."""
    return section - 2


def one_level(image, record, section, _other):
    part = image[keep_of(record, section)]
    part[part < 255] += 1


def swapped(image, record, section, _other):
    here, there = keep_of(record, section), keep_of(record, partner(section))
    image[here], image[there] = image[there].copy(), image[here].copy()


def last_column(image, _record, _section, _other):
    image[:, -1] = 0


def off_by_one(image, record, section, _other):
    """All but the one pixel that would come from the section before."""
    rows, columns = keep_of(record, section)
    image[rows, columns] = image[rows, columns.start - 1:columns.stop - 1].copy()


def gamma(image, record, section, _other):
    """Encoded by the power 2.2, where sRGB is wanted: the two are often taken for each other."""
    stored = numpy.arange(256) / 255
    linear = numpy.where(stored <= 0.04045, stored / 12.92, ((stored + 0.055) / 1.055) ** 2.4)
    wrong = numpy.rint(255 * linear ** (1 / 2.2)).astype(image.dtype)
    place = keep_of(record, section)
    image[place] = wrong[image[place]]


def other_camera(image, record, section, other):
    place = keep_of(record, section)
    image[place] = read_image(other)[0][place]


def blurred_seam(image, record, section, _other):
    """The seam before the section: each row's pixels near it become their mean."""
    rows, columns = keep_of(record, section)
    near = slice(columns.start - BLURRED, columns.start + BLURRED)
    image[rows, near] = numpy.rint(image[rows, near].mean(axis=1, keepdims=True))


def nan(image, record, section, _other):
    rows, columns = keep_of(record, section)
    image[(rows.start + rows.stop) // 2, columns.start + 1, 1] = numpy.nan


def none(_image, _record, _section, _other):
    """Read and written again, as with all the others."""


KINDS = {kind.__name__: kind for kind in (one_level, swapped, last_column, off_by_one, gamma,
                                          other_camera, blurred_seam, nan, none)}


def damage(kind, record, section, other, source, target):
    """Writes the damaged image; gives its pixels before and after."""
    before, spec = read_image(source)
    after = before.copy()
    KINDS[kind](after, record, section, other)
    write_image(target, after, spec)
    return before, after


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kind", choices=KINDS)
    parser.add_argument("--section", type=int, required=True, metavar="N")
    parser.add_argument("--other", metavar="IMAGE", help="for other_camera")
    parser.add_argument("mpiexec", nargs="+", metavar="MPIEXEC ...")
    options = parser.parse_args()
    code = subprocess.run(options.mpiexec, check=False).returncode
    if code == 0:
        file = options.mpiexec[options.mpiexec.index("--record") + 1]
        record = json.loads(Path(file).read_text())
        image = record["output"]["file"]
        damage(options.kind, record, options.section, options.other, image, image)
    return code


if __name__ == "__main__":
    sys.exit(main())
