"""Does ci/update-references --check see a reference image that is out of date? For mutations.py."""

import json
import shutil

from image_pixels import read_image, write_image
from program_runs import ROOT, TestFailure, fresh_folder, run

SCENE = "effects/none"
IMAGE = "reference_images/effects/none.png"
MANIFEST = "reference_images/manifest.json"
LIST = "scenes/scenes.json"
# What the check needs of the tree.
PARTS = ("ci/update-references", "ci/image_pixels.py", f"scenes/{SCENE}.pov", LIST,
         "scenes/hard.json", "reference_images")


def other_scene(tree):
    """A comment: the image stays as it is, but is no longer known to be this scene's."""
    with open(tree / f"scenes/{SCENE}.pov", "a", encoding="utf-8") as scene:
        scene.write("// changed\n")


def other_picture(tree):
    file = tree / f"scenes/{SCENE}.pov"
    file.write_text(file.read_text() + "sphere { 0, 1 pigment { color rgb 1 } }\n")


def other_arguments(tree):
    scenes = json.loads((tree / LIST).read_text())
    next(one for one in scenes["scenes"] if one["name"] == SCENE)["options"] = ["+A0.3"]
    (tree / LIST).write_text(json.dumps(scenes))


def other_pixel(tree):
    pixels, spec = read_image(tree / IMAGE)
    pixels[60, 80, 1] ^= 1
    write_image(tree / IMAGE, pixels, spec)


def change_manifest(tree, key):
    manifest = json.loads((tree / MANIFEST).read_text())
    entry = next(one for one in manifest["images"] if one["file"] == IMAGE)
    entry[key] = entry[key][::-1]
    (tree / MANIFEST).write_text(json.dumps(manifest))


def other_hash(tree):
    change_manifest(tree, "sha256")


def other_pixel_hash(tree):
    change_manifest(tree, "pixel_sha1")


def other_image(tree):
    (tree / "reference_images/effects/absent.png").write_bytes((tree / IMAGE).read_bytes())


def no_image(tree):
    (tree / IMAGE).unlink()


# What is done to the tree, and what the check must say of the file: all of it, and no more.
CHANGES = {other_scene: {"stale: scenes/effects/none.pov has changed since"},
           other_picture: {"stale: scenes/effects/none.pov has changed since", "differs: "},
           other_arguments: {"stale: its list asks for other arguments now", "differs: "},
           other_pixel: {"damaged: the file is not the one in the manifest",
                         "differs: 1 pixels, largest difference 1"},
           other_hash: {"damaged: the file is not the one in the manifest"},
           other_pixel_hash: {"damaged: the manifest has another pixel_sha1"},
           no_image: {"missing: no such file"},
           other_image: {"orphaned: no scene in the lists makes it"}}
ORPHAN = "reference_images/effects/absent.png"


def copy_tree(folder):
    for part in PARTS:
        target = folder / part
        target.parent.mkdir(parents=True, exist_ok=True)
        if (ROOT / part).is_dir():
            shutil.copytree(ROOT / part, target)
        else:
            shutil.copy(ROOT / part, target)
    return folder


def check(tree, povray):
    return run([tree / "ci/update-references", "--check", "--only", SCENE, "--povray", povray],
               tree)


def wrong_answer(change, done):
    file = ORPHAN if change is other_image else IMAGE
    said = [line.removeprefix(f"{file}: ") for line in done.stdout.splitlines()
            if line.startswith(f"{file}: ")]
    findings = said[0].split("; ") if len(said) == 1 else []
    expected = CHANGES[change]
    if done.code != 1 or len(findings) != len(expected) or not all(
            any(one.startswith(text) for one in findings) for text in expected):
        return (f"{change.__name__}: exit code {done.code} and {findings}, not 1 and "
                f"{sorted(expected)}:\n{done.stdout}{done.stderr}")
    return None


def stale_reference(povray, folder):
    done = check(copy_tree(fresh_folder(folder)), povray)
    if done.code != 0:
        raise TestFailure(f"the check fails before anything has changed:\n{done.stdout}"
                          f"{done.stderr}")
    wrong = []
    for change in CHANGES:
        tree = copy_tree(fresh_folder(folder))
        change(tree)
        done = check(tree, povray)
        print(f"{change.__name__}:\n{done.stdout}")
        if answer := wrong_answer(change, done):
            wrong.append(answer)
    if wrong:
        raise TestFailure("\n".join(wrong))
