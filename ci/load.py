#!/usr/bin/python3
"""Load: 10,000 sections of an image of 20000 x 20000 pixels on 64 ranks, more than there are cores.

What renders here is a stand-in (fake_povray), because POV-Ray writes a full frame for each section:
for these it would write 12 TB. It writes the same frames as sparse files, of a known picture. The
probe, whose text decides what is done, is POV-Ray itself. Told and checked: that each pixel arrived,
the peak of resident memory of rank 0 and of the others, the most file handles that a rank had open
at each third of the run (they do not grow), and zombies: none that stays for 10 seconds.

    load.py run [--size N] [--sections N] [--ranks N]

The promise on memory: rank 0 holds the image once (W x H x C x bytes), each rank two bands of 1 MiB
a launch, and what MPI and POV-Ray's text take: ROOM_BYTES.
Exit codes: 0 ok, 1 mpipov behaves otherwise, 2 usage.
"""

import os
import shutil
import subprocess
import time
from collections import Counter
from pathlib import Path

from program_runs import TestFailure, argument_parser, fresh_folder, programs_of, report, run

SCENE = """#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -z look_at 0 }
plane { z, 0 pigment { rgb x } finish { ambient 1 } }
"""
# Sections go to the stand-in, all else is POV-Ray.
POVRAY = """#!/bin/sh
case "$*" in *'/section"'*) exec "$FAKE" "$@" ;; esac
exec "$POVRAY" "$@"
"""
CHANNELS = 3
ROOM_BYTES = 256 << 20
LOOK_SECONDS = 0.5
ZOMBIE_LOOKS = 20  # one that is seen so often was not reaped: ranks wait seconds for a core here


def status_of(process, key):
    for line in (process / "status").read_text().splitlines():
        if line.startswith(key):
            return line.split()[1]
    return None


class Watch:
    """What the ranks of a run hold while it lasts."""

    def __init__(self):
        self.peaks = {}  # of resident memory, by pid
        self.handles = []  # (seconds, the most of any rank)
        self.zombies = Counter()
        self.begin = time.monotonic()

    def look(self, started):
        """`started` is the path of the program whose processes are the ranks."""
        ranks, most = set(), 0
        for process in Path("/proc").glob("[0-9]*"):
            try:
                parent = Path("/proc") / status_of(process, "PPid")
                # Not a launch that is about to become the guard: it shows its rank's memory as its own.
                if Path(os.readlink(process / "exe")) == started != Path(os.readlink(parent / "exe")):
                    ranks.add(process.name)
                    self.peaks[process.name] = int(status_of(process, "VmHWM") or 0) << 10
                    most = max(most, len(os.listdir(process / "fd")))
            except OSError:
                pass  # it ended meanwhile, or has no program any more
        self.handles.append((time.monotonic() - self.begin, most))
        for process in Path("/proc").glob("[0-9]*"):
            try:
                if status_of(process, "State") == "Z" and status_of(process, "PPid") in ranks:
                    self.zombies[process.name] += 1
            except OSError:
                pass

    def most_handles(self):
        """Of each third of the run."""
        end = self.handles[-1][0]
        return [max((most for seconds, most in self.handles
                     if end * third / 3 <= seconds <= end * (third + 1) / 3), default=0)
                for third in range(3)]


def load(options):
    programs = programs_of(options)
    fake = options.fake.resolve()
    folder = fresh_folder(options.work.resolve() / "load")
    (folder / "scene.pov").write_text(SCENE)
    (folder / "povray").write_text(POVRAY)
    (folder / "povray").chmod(0o755)
    environment = {**os.environ, "FAKE": str(fake),
                   "POVRAY": shutil.which(options.povray) or options.povray}
    size = options.size
    argv = [programs.mpiexec, "-n", options.ranks, programs.mpipov, "scene.pov", f"+W{size}",
            f"+H{size}", "-A", "+FP", "+Oimage.ppm", "--shape", "tiles", "--seams", "plain",
            "--sections", options.sections, "--schedule", "dynamic", "--in-flight", "1", "--slots", "1",
            "--threads", "1", "--povray", "./povray", "--confine", "off", "--progress", "none"]
    watch = Watch()
    with open(folder / "said", "w", encoding="utf-8") as said, \
            subprocess.Popen([str(word) for word in argv], cwd=folder, env=environment, stderr=said,
                             stdout=said, stdin=subprocess.DEVNULL) as process:
        while process.poll() is None:
            watch.look(programs.mpipov)
            time.sleep(LOOK_SECONDS)
    seconds = time.monotonic() - watch.begin
    if process.returncode != 0:
        raise TestFailure(f"ended with {process.returncode}:\n{(folder / 'said').read_text()}")
    # The stand-in's picture of the whole, made in one launch.
    run([fake, f"+W{size}", f"+H{size}", "+SC0", f"+EC{size}", "+SR0", f"+ER{size}",
         f'+O"{folder}/whole"'], folder)
    said, _ = programs.compare("whole.ppm", "image.ppm", folder)
    peaks = sorted(watch.peaks.values())
    print(f"{options.ranks} ranks, {options.sections} sections, {size} x {size} pixels: {seconds:.0f} s; "
          f"stand-in renderer\n"
          f"image {size * size * CHANNELS / 2**20:.0f} MiB; peak of resident memory: rank 0 "
          f"{peaks[-1] / 2**20:.0f} MiB, others at most {(peaks[-2] if len(peaks) > 1 else 0) / 2**20:.0f} "
          f"MiB\nfile handles of a rank, at most, in each third of the run: {watch.most_handles()}\n"
          f"zombies: {len(watch.zombies)} seen, the longest for "
          f"{max(watch.zombies.values(), default=0) * LOOK_SECONDS:g} s", flush=True)
    if not said["identical"]:
        raise TestFailure("pixels were lost: the image is not the stand-in's picture")
    if peaks[-1] > size * size * CHANNELS + ROOM_BYTES or (peaks[:-1] and peaks[-2] > ROOM_BYTES):
        raise TestFailure("a rank held more memory than is promised")
    first, *_, last = watch.most_handles()
    if last > first + 8:
        raise TestFailure("file handles grow during the run")
    if any(looks >= ZOMBIE_LOOKS for looks in watch.zombies.values()):
        raise TestFailure("zombies stay")
    shutil.rmtree(folder)


def main():
    parser = argument_parser(__doc__)
    parser.add_argument("command", choices=["run"])
    parser.add_argument("--fake", type=Path, required=True, metavar="PATH",
                        help="fake_povray, the stand-in")
    parser.add_argument("--size", type=int, default=20000)
    parser.add_argument("--sections", type=int, default=10000)
    parser.add_argument("--ranks", type=int, default=64)
    load(parser.parse_args())
    return 0


if __name__ == "__main__":
    report(main)
