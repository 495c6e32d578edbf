"""Runs mpipov, POV-Ray and mpipov-validate as a user does; for the test scripts beside this file.

Debian's povray.conf lets POV-Ray write to the current directory and /tmp only, so every run has the
folder that it writes to as its current directory.
"""

import argparse
import contextlib
import json
import os
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SKIPPED = 77  # what CTest's SKIP_RETURN_CODE says
RUN_SECONDS = 1800
# Chunks that may differ between two files with the same picture: the pixels are compared as such,
# and POV-Ray writes the time of the render.
PICTURE_CHUNKS = {"IDAT", "IEND", "tIME", "tEXt", "zTXt", "iTXt"}


class TestFailure(Exception):
    """What the test finds wrong."""


class Skip(Exception):
    """Why the test cannot run here."""


@dataclass
class Run:
    argv: list
    code: int
    stdout: str
    stderr: str
    seconds: float

    def command(self):
        return shlex.join(map(str, self.argv))


@dataclass
class Programs:
    """The programs under test, as the command line names them."""

    mpipov: Path
    validate: Path
    povray: str
    mpiexec: str

    def mpi(self, ranks, arguments, cwd, **more):
        """mpipov on so many ranks; 0: started without mpiexec."""
        start = [self.mpiexec, "-n", str(ranks)] if ranks else []
        return run([*start, self.mpipov, *arguments], cwd, **more)

    def serial(self, arguments, cwd):
        """POV-Ray itself with one thread, the reference of all comparisons."""
        done = run([self.povray, *arguments, "+WT1", "-D", "-P"], cwd)
        if done.code != 0:
            raise TestFailure(f"{done.command()}\nended with {done.code}:\n{done.stderr[-2000:]}")
        return done

    def compare(self, reference, image, cwd, record=None):
        """What `mpipov-validate compare` says of the two, as it writes it in JSON."""
        result = Path(cwd) / "compare.json"
        result.unlink(missing_ok=True)
        more = ["--run", record] if record else []
        done = run([self.validate, "compare", reference, image, "--no-ssim", "--json", result,
                    *more], cwd)
        if done.code not in (0, 1):
            raise TestFailure(f"{done.command()}\nended with {done.code}: {done.stderr}")
        said = json.loads(result.read_text())
        if said["identical"] != (done.code == 0):
            raise TestFailure(f"{done.command()}\nexit code {done.code} and its JSON disagree")
        result.unlink()
        return said, done.stdout


def run(argv, cwd, environment=None, seconds=RUN_SECONDS):
    """Runs to the end; a run that takes longer is killed with all of its processes."""
    argv = [str(argument) for argument in argv]
    begin = time.monotonic()
    with subprocess.Popen(argv, cwd=cwd, env=environment, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          errors="replace", start_new_session=True) as process:
        try:
            stdout, stderr = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            stdout, stderr = process.communicate()
            raise TestFailure(f"{shlex.join(argv)}\ndid not end within {seconds} s:\n"
                              f"{stdout}{stderr}") from None
    return Run(argv, process.returncode, stdout, stderr, time.monotonic() - begin)


def require_success(done):
    if done.code != 0:
        raise TestFailure(f"{done.command()}\nended with {done.code}:\n{done.stdout}{done.stderr}")
    return done


def measurement(name, value):
    """A number of the test's, as CTest takes it up into its own record; none: not told."""
    if value is not None:
        print(f'<CTestMeasurement type="numeric/double" name="{name}">{value:.10g}'
              "</CTestMeasurement>")


def png_chunks(file):
    """All that a PNG file says of its pixels besides the pixels: {type: bytes}, IHDR included."""
    data = Path(file).read_bytes()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise TestFailure(f"{file} is not a PNG file")
    chunks = {}
    at = 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        kind = kind.decode("ascii")
        if kind not in PICTURE_CHUNKS:
            chunks[kind] = chunks.get(kind, b"") + data[at + 8:at + 8 + length]
        at += 12 + length
    return chunks


def require_same_chunks(reference, image):
    expected, found = png_chunks(reference), png_chunks(image)
    for kind in sorted(expected.keys() | found.keys()):
        if expected.get(kind) != found.get(kind):
            raise TestFailure(f"{kind} of {image} is {found.get(kind)!r}, and "
                              f"{expected.get(kind)!r} in the serial {reference}")


def fresh_folder(folder):
    """An empty folder of that name: what an earlier run left there is removed."""
    folder = Path(folder)
    if folder.exists():
        shutil.rmtree(folder)
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def argument_parser(description):
    """With the options that say where the programs are; CMake fills them in."""
    parser = argparse.ArgumentParser(description=description,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=Path, default=ROOT / "build" / "bin", metavar="DIR",
                        help="where mpipov and mpipov-validate are (default: build/bin)")
    parser.add_argument("--work", type=Path, default=ROOT / "build" / "ci" / "runs",
                        metavar="DIR", help="where runs leave their files")
    parser.add_argument("--povray", default="povray", metavar="PATH")
    parser.add_argument("--mpiexec", default="mpiexec", metavar="PATH")
    return parser


def programs_of(options):
    folder = options.bin.resolve()
    return Programs(folder / "mpipov", folder / "mpipov-validate", options.povray, options.mpiexec)


def report(main):
    """Runs main() and ends the process with its exit code, a failure told without a traceback."""
    try:
        sys.exit(main())
    except TestFailure as failure:
        print(f"FAILED: {failure}")
        sys.exit(1)
    except Skip as reason:
        print(f"SKIPPED: {reason}")
        sys.exit(SKIPPED)
