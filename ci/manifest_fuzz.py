#!/usr/bin/python3
"""Fuzzes what ci/update-references reads: reference_images/manifest.json, damaged at random.

    manifest_fuzz.py [--seconds S] [--seed N]

A damaged manifest is refused by a ValueError that names it, or what is damaged is found by the
check of its image; nothing else may be thrown. Prints JSON, as fuzz/replay_main.cpp does.

Exit codes: 0 ok, 1 a fault was found (the manifest is kept: its path is printed), 2 usage.
"""

import argparse
import importlib.machinery
import importlib.util
import json
import random
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
VALUES = [None, True, -1, 1e308, 2 ** 70, "", "x", [], {}, [[]], {"file": []}]


def load_program():
    loader = importlib.machinery.SourceFileLoader("update_references",
                                                  str(HERE / "update-references"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def places(value, found):
    """All (container, key) within a JSON value."""
    keys = value if isinstance(value, dict) else range(len(value))
    for key in keys:
        found.append((value, key))
        if isinstance(value[key], (dict, list)):
            places(value[key], found)
    return found


def other_value(rng, text):
    """The JSON with one to four of its values replaced or removed."""
    manifest = json.loads(text)
    for _ in range(rng.randint(1, 4)):
        if not isinstance(manifest, dict) or rng.random() < 0.01:
            return json.dumps(rng.choice(VALUES)).encode()
        container, key = rng.choice(places(manifest, []) or [(manifest, "images")])
        if rng.random() < 0.3:
            container.pop(key, None) if isinstance(container, dict) else container.pop(key)
        else:
            container[key] = rng.choice(VALUES)
    return json.dumps(manifest).encode()


def other_bytes(rng, text):
    data = bytearray(text)
    for _ in range(rng.randint(1, 8)):
        at = rng.randrange(len(data))
        kind = rng.randrange(4)
        if kind == 0:
            data[at] ^= 1 << rng.randrange(8)
        elif kind == 1:
            del data[at:at + rng.randrange(1, 64)]
        elif kind == 2:
            data[at:at] = rng.choice([b"[" * 5000, b"{", b'"', b"\xff", b"null", b"9" * 5000])
        else:
            data[at:] = b""
        if not data:
            return b""
    return bytes(data)


def try_one(program, text, original):
    """None, or what is wrong with how it was taken."""
    program.MANIFEST.write_bytes(text)
    try:
        known = program.read_manifest()
    except ValueError as error:
        return None if str(program.MANIFEST) in str(error) else f"it does not name itself: {error}"
    for entry in original["images"][:2]:
        found = program.check(entry, known.get(entry["file"]), program.ROOT / entry["file"])
        same = known.get(entry["file"]) is not None and all(
            known[entry["file"]][key] == entry[key]
            for key in ("scene_sha256", "argv", "sha256", "pixel_sha1"))
        if same == bool(found):
            return f"{entry['file']} is found {found}"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    program = load_program()
    text = program.MANIFEST.read_bytes()
    original = json.loads(text)
    rng = random.Random(options.seed)
    begin = time.monotonic()
    executions = 0
    folder = Path(tempfile.mkdtemp(prefix="mpipov-manifest-"))
    program.MANIFEST = folder / "manifest.json"
    tried = text
    while executions == 0 or time.monotonic() - begin < options.seconds:
        try:
            wrong = try_one(program, tried, original)
        except Exception as error:  # pylint: disable=broad-except
            wrong = f"{type(error).__name__}: {error}"
        if wrong:
            print(f"{program.MANIFEST}: {wrong}")
            return 1
        executions += 1
        tried = rng.choice([other_value, other_bytes])(rng, text)
    program.MANIFEST.unlink()
    folder.rmdir()
    print(json.dumps({"corpus": 1, "words": 0, "seed": options.seed,
                      "seconds": round(time.monotonic() - begin, 1), "executions": executions}))
    return 0


if __name__ == "__main__":
    sys.exit(main())
