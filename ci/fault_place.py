"""A case's folder for faults.py: a scene, a POV-Ray that can be damaged, and what must hold after."""

import contextlib
import json
import os
import re
import shutil
import subprocess
import time
import uuid
from pathlib import Path

from program_runs import Skip, TestFailure, fresh_folder, programs_of, require_success, run

# Sections that take some tenths of a second, none like another, so that a wrong one shows.
SCENE = """#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 12 }
camera { location <0, 2, -5> look_at 0 }
light_source { <5, 8, -6> 1 area_light x, y, 5, 5 }
background { rgb <0.2, 0.3, 0.5> }
plane { y, -1 pigment { checker rgb 0.2 rgb 0.9 } finish { reflection 0.3 } }
#for (I, -3, 3)
  sphere { <I, sin(I), 0>, 0.6 pigment { rgb <0.2, 0.1 * (I + 4), 0.9> } finish { reflection 0.4 } }
#end
"""
SECTIONS = 12
SCENE_ARGUMENTS = ["scene.pov", "+W192", "+H128", "+A0.1", "+R4"]
GRID = ["--seams", "aligned", "--shape", "tiles", "--sections", SECTIONS, "--schedule", "dynamic",
        "--slots", "1", "--in-flight", "1", "--threads", "1", "--progress", "none"]
# Launches of sections are counted: a line in `launches` each. $HOOK sees $BASE, what the launch's
# image is called without its type, and $N, which launch it is.
POVRAY = """#!/bin/sh
case "$*" in *'/section"'*)
    N=$( { flock 9; echo launch >&9; wc -l < "$PLACE/launches"; } 9>> "$PLACE/launches")
    for BASE; do
        case "$BASE" in '+O"'*) BASE=${BASE#+O?}; BASE=${BASE%?}; break ;; esac
    done
    eval "$HOOK" ;;
esac
"""
THIS_VERSION = 'exec "$POVRAY" "$@"\n'
# A later option of POV-Ray's own would not change what it says of itself.
OTHER_VERSION = """"$POVRAY" "$@" > "$PLACE/said.$$" 2>&1
CODE=$?
sed -E 's/3\\.7\\.0\\.[0-9]+/3.7.0.99/' "$PLACE/said.$$" >&2
rm "$PLACE/said.$$"
exit $CODE
"""
MARK = "MPIPOV_TEST_RUN"
POVRAY_GONE_SECONDS = 2  # until no POV-Ray is left, whatever happened: what is promised
ALL_GONE_SECONDS = 10  # until the ranks are gone too, on a busy machine
RANKS_AND_LAUNCHERS = {"mpipov", "mpiexec.hydra", "hydra_pmi_proxy"}
RUN_SECONDS = 240


class Place:
    """The folder, the programs, and the processes that run in it."""

    def __init__(self, options, name):
        self.programs = programs_of(options)
        self.folder = fresh_folder(options.work.resolve() / "faults" / name)
        self.real = shutil.which(options.povray) or options.povray
        self.mark = uuid.uuid4().hex
        self.work_folder = self.folder / "image.png.mpipov"
        # Of a short name, below /tmp: sockets of mpiexec's lie in it too.
        self.temporary = Path("/tmp") / f"mpipov-fault-{self.mark[:12]}"
        (self.folder / "scene.pov").write_text(SCENE)
        self.write_povray(THIS_VERSION)

    def __enter__(self):
        self.temporary.mkdir()
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.temporary, ignore_errors=True)

    def write_povray(self, then):
        (self.folder / "povray").write_text(POVRAY + then)
        (self.folder / "povray").chmod(0o755)

    def environment(self, hook, temporary=None):
        return {**os.environ, "HOOK": hook, "POVRAY": self.real, "PLACE": str(self.folder),
                "TMPDIR": str(temporary or self.temporary), MARK: self.mark}

    def arguments(self, *more):
        # The script in POV-Ray's place writes, removes and mounts: nothing that a scene may do.
        return [*SCENE_ARGUMENTS, "+Oimage.png", *GRID, "--povray", "./povray", "--confine", "off",
                *more]

    def mpipov(self, ranks, *more, hook="", temporary=None):
        """A run to its end; no process of it may be left."""
        done = self.programs.mpi(ranks, self.arguments(*more), self.folder,
                                 environment=self.environment(hook, temporary), seconds=RUN_SECONDS)
        self.require_nothing_runs()
        return done

    def processes(self, but=frozenset()):
        """Those that a run of this case has started and that still run: {pid: command line}. Not
        those whose program has one of these names."""
        found = {}
        for process in Path("/proc").glob("[0-9]*"):
            with contextlib.suppress(OSError):  # it ended meanwhile, or is not ours to look at
                if f"{MARK}={self.mark}".encode() in (process / "environ").read_bytes().split(b"\0") \
                        and Path(os.readlink(process / "exe")).name not in but:
                    command = (process / "cmdline").read_bytes().replace(b"\0", b" ")
                    found[int(process.name)] = command.decode(errors="replace")
        return found

    def require_nothing_runs(self):
        """Within the promised times; what is left is said. Seconds until no POV-Ray was left."""
        begin = time.monotonic()

        def wait(seconds, but):
            while left := self.processes(but):
                if time.monotonic() - begin > seconds:
                    raise TestFailure(f"still running after {seconds} s: {left}")
                time.sleep(0.02)
            return time.monotonic() - begin

        gone = wait(POVRAY_GONE_SECONDS, RANKS_AND_LAUNCHERS)
        wait(ALL_GONE_SECONDS, frozenset())
        return gone

    def launches(self):
        file = self.folder / "launches"
        return len(file.read_text().splitlines()) if file.exists() else 0

    def forget_launches(self):
        (self.folder / "launches").unlink(missing_ok=True)

    def sections_kept(self):
        file = self.work_folder / "sections.jsonl"
        if not file.exists():
            return 0
        lines = (line for line in file.read_text().splitlines(keepends=True) if line.endswith("\n"))
        return len({json.loads(line).get("section") for line in lines})

    def require_image(self, name="image.png"):
        """The image is that of a POV-Ray which nothing disturbed."""
        if not (self.folder / "serial.png").exists():
            self.programs.serial([*SCENE_ARGUMENTS, "+Oserial.png"], self.folder)
        said, _ = self.programs.compare("serial.png", name, self.folder)
        if not said["identical"]:
            raise TestFailure(f"{name} is not the serial image")

    def require_left(self, *names):
        """Of a run nothing is left in the folder but these, and nothing in its temporary folder."""
        ours = {"scene.pov", "povray", "launches", "serial.png"}
        found = {str(entry.relative_to(self.folder)) for entry in self.folder.rglob("*")} - ours
        if found != set(names):
            raise TestFailure(f"missing: {sorted(set(names) - found)}, "
                              f"left: {sorted(found - set(names))}")
        if left := [entry.name for entry in self.temporary.iterdir()]:
            raise TestFailure(f"left in TMPDIR: {left}")

    def goes_on(self, *arguments, hook="", ranks=2):
        """--resume with the same arguments renders only what is missing, and makes the image."""
        kept = self.sections_kept()
        self.forget_launches()
        require_success(self.mpipov(ranks, *arguments, "--resume", hook=hook))
        if self.launches() != SECTIONS - kept:
            raise TestFailure(f"{self.launches()} launches to go on, not {SECTIONS - kept}")


def require_ended(done, code, says):
    """With that code, and one line on standard error that matches."""
    lines = done.stderr.splitlines()
    if done.code != code or len(lines) != 1 or not re.search(says, lines[0]):
        raise TestFailure(f"{done.command()}\nended with {done.code}, wanted {code} and one line "
                          f"'{says}':\n{done.stderr}")


class Disk:
    """A tmpfs in a case's folder: a disk that is small, or that becomes read-only."""

    def __init__(self, folder, size):
        self.folder = folder
        folder.mkdir()
        mount("-t", "tmpfs", "-o", f"size={size}", "tmpfs", folder)

    def enlarge(self, size):
        mount("-o", f"remount,size={size}", self.folder)

    def writable(self):
        mount("-o", "remount,rw", self.folder)

    def read_only(self):
        mount("-o", "remount,ro", self.folder)

    def fill(self):
        with open(self.folder / "filling", "wb", buffering=0) as filling, \
                contextlib.suppress(OSError):
            while filling.write(b"x" * 4096):
                pass


def mount(*arguments):
    done = subprocess.run(["mount", *map(str, arguments)], capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        raise Skip(f"no tmpfs can be mounted here (root can): {done.stderr.strip()}")


@contextlib.contextmanager
def disk_in(place, size):
    if os.geteuid() != 0:
        raise Skip("only root can mount the small disk that this needs")
    disk = Disk(place.folder / "disk", size)
    try:
        yield disk
    finally:
        # Lazily: a process that was left behind must not keep the folder from being removed.
        subprocess.run(["umount", "-l", disk.folder], check=True)
        disk.folder.rmdir()
