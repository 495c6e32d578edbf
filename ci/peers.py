#!/usr/bin/python3
"""Do others find the same errors? The metrics of `mpipov-validate compare` beside those of
scikit-image and of OpenImageIO's idiff, on twenty image pairs.

    peers.py check [--record FILE]    compares; FILE gets the numbers (docs/stability/peers.json)

idiff prints six digits, and agrees where they are ours; scikit-image where its 64-bit number is
ours to 12 digits. Where a peer does not agree, the cause must be a known one (peer_models.py), and
idiff's number be the one that follows from it: an agreement that is lost fails, and so does a
disagreement that is gone.

Exit codes: 0 ok, 1 an agreement is lost, 2 usage.
"""

import json
import math
import sys
from pathlib import Path

import numpy
import OpenImageIO as oiio

from image_pixels import read_image, write_image
from peer_models import (CAUSES, METRICS, close_digits, digits, idiff, idiff_model, scikit_image)
from peer_pairs import PAIRS
from program_runs import TestFailure, argument_parser, fresh_folder, programs_of, report, run

FULL_SCALE = {"uint8": 255, "uint16": 65535}
RELATIVE = 1e-12


def save(file, pixels, depth):
    spec = oiio.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], depth)
    spec.attribute("oiio:UnassociatedAlpha", 1)  # as POV-Ray's: colours not multiplied
    write_image(file, pixels, spec)


def make_files(pair, index, programs, folder):
    if pair.rendered:
        return pair.make(programs, folder)
    files = [folder / f"{pair.name}.{side}{pair.suffix}" for side in "ab"]
    for file, pixels in zip(files, pair.make(numpy.random.default_rng(index))):
        save(file, pixels, pair.depth)
    return files


def ours(programs, a, b, folder):
    result = folder / "compare.json"
    done = run([programs.validate, "compare", a, b, "--json", result], folder)
    if done.code not in (0, 1):
        raise TestFailure(f"{done.command()}\nended with {done.code}:\n{done.stderr}")
    said = json.loads(result.read_text())
    largest = said["largest"]
    return {"mean": said["mean_abs"]["full_scale"], "rms": said["rms"]["full_scale"],
            "psnr": said["psnr"], "ssim": said["ssim"]["value"],
            "max": abs(largest["full_scale"]) if largest else 0.0}


def agrees_with_scikit_image(mine, theirs):
    if mine is None or theirs is None:
        return mine is theirs
    return math.isfinite(theirs) and abs(mine - theirs) <= RELATIVE * max(abs(mine), abs(theirs), 1e-300)


def scikit_image_cause(metric, mine, theirs, finite):
    if not finite:
        return None if theirs is not None and math.isfinite(theirs) else "no number"
    return "none" if metric == "psnr" and mine is None and math.isinf(theirs) else None


def idiff_cause(metric, mine, theirs, model, traits):
    """Which of the known causes the number follows from; None: from none of them."""
    if metric == "psnr" and mine is None and theirs == "inf":
        return "none"
    if not close_digits(model[metric], theirs):
        return None
    if traits["alpha"]:
        return "alpha"
    if not traits["finite"]:
        return "not finite"
    if metric == "psnr" and traits["peak"] > 1:
        return "peak"
    rounding = 2 ** -23 * traits["peak"]
    rounded = close_digits(mine, theirs) or (metric != "psnr" and
                                             abs(mine - float(theirs)) <= rounding)
    return "float" if rounded else None


def traits_of(a, b, channels):
    finite = bool(numpy.isfinite(a).all() and numpy.isfinite(b).all())
    return {"finite": finite, "alpha": channels[-1] == "A",
            "peak": max(1, float(a.max()), float(b.max())) if a.dtype.kind == "f" else 1}


def judge(pair, mine, peers, model, traits):
    """{metric: {peer: True or the cause}}, and what is wrong."""
    agree, wrong = {}, []
    known = dict(pair.known)
    for metric in METRICS:
        agree[metric] = {}
        for peer, numbers in peers.items():
            if metric not in numbers:
                continue
            theirs = numbers[metric]
            if peer == "idiff":
                same = mine[metric] is not None and digits(mine[metric]) == theirs
                cause = idiff_cause(metric, mine[metric], theirs, model, traits)
            else:
                same = agrees_with_scikit_image(mine[metric], theirs)
                cause = scikit_image_cause(metric, mine[metric], theirs, traits["finite"])
            agree[metric][peer] = same or f"{peer}: {CAUSES.get(cause, 'unknown')}"
            expected = known.get(f"{peer}.{metric}")
            if cause == "float" and expected is None and not same:
                continue  # rounding, of this machine's numpy too
            if same and expected:
                wrong.append(f"{pair.name}: {peer} agrees in {metric} now, not so: {expected}")
            elif not same and (cause is None or cause != expected):
                wrong.append(f"{pair.name}: {peer}'s {metric} is {theirs}, ours {mine[metric]} "
                             f"(cause: {cause or 'unknown'}, known: {expected or 'none'})")
    return agree, wrong


def number(value):
    """As JSON has it; infinite and NaN as text."""
    return value if value is None or math.isfinite(value) else str(value)


def summary(by_peer):
    """True, or why not."""
    causes = [verdict for verdict in by_peer.values() if verdict is not True]
    return "; ".join(causes) if causes else True


def compare(pair, index, programs, folder):
    files = make_files(pair, index, programs, folder)
    mine = ours(programs, *files, folder)
    (a, spec), (b, _) = (read_image(file) for file in files)
    channels = list(spec.channelnames)
    traits = traits_of(a, b, channels)
    scale = FULL_SCALE.get(str(spec.format), 1)
    colour = [i for i, name in enumerate(channels) if name != "A"]
    peers = {"scikit_image": scikit_image(a, b, scale, colour), "idiff": idiff(*files)}
    model = idiff_model(a, b, scale, traits["alpha"])
    agree, wrong = judge(pair, mine, peers, model, traits)
    # What would not be seen is not checked: a ninth digit, and the sixth one of idiff's.
    for metric, by in (("rms", 1 + 1e-9), ("rms", 1 + 2e-5)):
        changed = dict(mine, **{metric: mine[metric] * by})
        if mine[metric] and traits["finite"] and not judge(pair, changed, peers, model, traits)[1]:
            wrong.append(f"{pair.name}: a {metric} that is wrong by {by - 1:g} passes")
    return {"name": pair.name, "what": pair.what,
            "image": {"width": spec.width, "height": spec.height, "channels": channels,
                      "depth": str(spec.format)},
            "ours": mine,
            "scikit_image": {key: number(value) for key, value in peers["scikit_image"].items()},
            "idiff": {key: number(float(value)) for key, value in peers["idiff"].items()},
            "agree": {metric: summary(by_peer) for metric, by_peer in agree.items()},
            "comparisons": sum(map(len, agree.values())),
            "agreements": sum(verdict is True for by_peer in agree.values()
                              for verdict in by_peer.values())}, wrong


def line(entry):
    sides = [f"{entry['name']:14}"]
    for metric in METRICS:
        mine = entry["ours"][metric]
        sides.append(f"{metric} {'-' if mine is None else digits(mine):>11} "
                     + ("same " if entry["agree"][metric] is True else "cause"))
    return "  ".join(sides)


def check(programs, work, record):
    folder = fresh_folder(work)
    entries, wrong = [], []
    for index, pair in enumerate(PAIRS):
        entry, found = compare(pair, index, programs, folder)
        print(line(entry), flush=True)
        entries.append(entry)
        wrong += found
    agreements, every = (sum(entry[key] for entry in entries)
                         for key in ("agreements", "comparisons"))
    print(f"{len(entries)} pairs, {every} comparisons: {agreements} agree, "
          f"{every - agreements} differ")
    if wrong:
        raise TestFailure("\n".join(wrong))
    if record:
        record.parent.mkdir(parents=True, exist_ok=True)
        record.write_text(json.dumps({"format": "mpipov-peers", "version": 1, "pairs": entries},
                                     indent=1) + "\n")
    return 0


def main():
    parser = argument_parser(__doc__)
    parser.add_argument("what", choices=["check"])
    parser.add_argument("--record", type=Path, metavar="FILE")
    options = parser.parse_args()
    return check(programs_of(options), (options.work / "peers").resolve(), options.record)


if __name__ == "__main__":
    report(main)
