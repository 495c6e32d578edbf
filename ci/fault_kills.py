"""Signals at random moments to mpiexec, to rank 0 and to a worker, for faults.py."""

import os
import random
import signal
import subprocess
import threading

from fault_place import SECTIONS
from program_runs import TestFailure, require_success

KILLS = [(whom, name) for whom in ("mpiexec", "rank0", "rank1") for name in ("INT", "TERM", "KILL")]
# Rank numbers are known by hydra's environment; the shell leaves its process to mpipov.
START = 'echo $$ > "$PLACE/pid.$PMI_RANK"; exec "$@"'


def target(place, whom, mpiexec):
    if whom == "mpiexec":
        return mpiexec.pid
    file = place.folder / f"pid.{whom[-1]}"
    return int(file.read_text()) if file.exists() and file.read_text().endswith("\n") else None


def reap_and_require_nothing_runs(place, process, what):
    """mpiexec is a child of ours, which stays until somebody waits for it."""
    waiting = threading.Thread(target=process.wait)
    waiting.start()
    try:
        return place.require_nothing_runs()
    except TestFailure as failure:
        process.kill()
        raise TestFailure(f"{what}: {failure}\n{(place.folder / 'said').read_text()}") from None
    finally:
        waiting.join()


def disturbed(place, whom, name, seconds, *arguments):
    """Runs with two ranks, and sends the signal after so long. Says whether it came before the end,
    and how long after it the last POV-Ray was gone."""
    for rank in (0, 1):
        (place.folder / f"pid.{rank}").unlink(missing_ok=True)
    argv = [place.programs.mpiexec, "-n", 2, "sh", "-c", START, "sh", place.programs.mpipov,
            *place.arguments(*arguments)]
    with open(place.folder / "said", "w", encoding="utf-8") as said, \
            subprocess.Popen([str(word) for word in argv], cwd=place.folder, stderr=said,
                             stdout=said, stdin=subprocess.DEVNULL,
                             env=place.environment("")) as process:
        try:
            process.wait(seconds)
        except subprocess.TimeoutExpired:
            pass
        pid = target(place, whom, process)
        early = process.poll() is None and pid is not None
        if early:
            try:
                os.kill(pid, getattr(signal, f"SIG{name}"))
            except ProcessLookupError:
                early = False
        if early:
            gone = reap_and_require_nothing_runs(place, process, f"SIG{name} to {whom}")
        else:
            gone = 0
            process.wait()
    image = place.folder / "image.png"
    if early and image.exists():
        place.require_image()  # it was complete before the signal
        early = False
    return early, gone


def require_no_partial_output(place):
    allowed = {"scene.pov", "povray", "launches", "serial.png", "said", "pid.0", "pid.1",
               place.work_folder.name}
    if left := {entry.name for entry in place.folder.iterdir()} - allowed:
        raise TestFailure(f"left behind: {sorted(left)}")


def go_on(place):
    """--resume where there is something to resume, else from the beginning; counted."""
    kept = place.sections_kept()
    place.forget_launches()
    more = ["--resume"] if (place.work_folder / "journal.json").exists() else []
    require_success(place.mpipov(2, *more))
    if place.launches() != SECTIONS - (kept if more else 0):
        raise TestFailure(f"{place.launches()} launches to go on, with {kept} sections kept")
    place.require_image()
    (place.folder / "image.png").unlink()
    (place.folder / "run.json").unlink()
    return kept


def undisturbed_seconds(place):
    seconds = require_success(place.mpipov(2)).seconds
    place.require_image()
    (place.folder / "image.png").unlink()
    (place.folder / "run.json").unlink()
    return seconds


def kill_and_go_on(place, whom, name, moments):
    """At the first of the moments that comes before the end; the others are shorter."""
    for seconds in moments:
        early, gone = disturbed(place, whom, name, seconds)
        if early:
            require_no_partial_output(place)
            return seconds, gone, go_on(place)
        for file in ("image.png", "run.json"):
            (place.folder / file).unlink(missing_ok=True)
    raise TestFailure(f"the run ended before SIG{name} to {whom} at every one of {moments}")


def killed(whom, name):
    def case(place):
        whole = undisturbed_seconds(place)
        for seed in range(2):
            chance = random.Random(f"{whom}.{name}.{seed}")
            moments = [whole * chance.uniform(0.2, 0.9) / (1 + turn) for turn in range(3)]
            seconds, gone, kept = kill_and_go_on(place, whom, name, moments)
            print(f"SIG{name} to {whom} after {seconds:.2f} of {whole:.2f} s: gone after {gone:.2f} s, "
                  f"{kept} of {SECTIONS} sections kept, resumed to the same bits", flush=True)
    return case


def soak(place, images, seed):
    """One run after another is killed at a random moment and gone on from, until so many images were
    made by runs that were killed. A third of them are killed again while they go on."""
    whole = undisturbed_seconds(place)
    chance = random.Random(seed)
    print(f"seed {seed}, undisturbed {whole:.2f} s", flush=True)
    kills, slowest, made, ended_before = 0, 0.0, 0, 0
    while made < images:
        whom, name = chance.choice(KILLS)
        more = ["--resume"] if (place.work_folder / "journal.json").exists() else []
        early, gone = disturbed(place, whom, name, chance.uniform(0, whole), *more)
        if not early:  # it was there before the signal
            place.require_image()
            ended_before += 1
            for file in ("image.png", "run.json"):
                (place.folder / file).unlink(missing_ok=True)
            continue
        kills += 1
        slowest = max(slowest, gone)
        require_no_partial_output(place)
        kept = place.sections_kept()
        told = f"{kills}: SIG{name} to {whom}: {kept} sections kept"
        if chance.random() < 1 / 3:
            print(f"{told}; killed again", flush=True)
            continue
        go_on(place)
        made += 1
        print(f"{told}; image {made} identical", flush=True)
    print(f"{kills} kills in a row, {made} images gone on from, all identical ({ended_before} runs more "
          f"were complete before the signal); POV-Ray was gone after at most {slowest:.2f} s")
