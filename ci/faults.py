#!/usr/bin/python3
"""Faults, injected on purpose: each is survived, or ends cleanly and can be gone on from.

Real POV-Ray renders here. A shell script in its place ($HOOK, one line of shell that is run for the
launch of a section) damages what it does; a small tmpfs is a disk that fills up. Whatever happens,
no process is left after 2 seconds, no image but a whole one, and --resume makes the bits that an
undisturbed run makes, rendering only what is missing.

    faults.py list            the cases, as CMakeLists.txt reads them
    faults.py run CASE
    faults.py soak [--images N] [--seed S]
                              kills at random moments, until N images (default: 100) were gone on to

Exit codes: 0 ok, 1 mpipov behaves otherwise, 2 usage, 77 cannot be tested here.
"""

import json

from fault_hydra import silent_at
from fault_kills import KILLS, killed, soak
from fault_place import (OTHER_VERSION, SECTIONS, THIS_VERSION, Place, disk_in, require_ended)
from program_runs import TestFailure, argument_parser, report, require_success

# For $HOOK. $BASE is what the launch's image is called, without its type; $N counts the launches of
# sections, from 1.
DAMAGE = {
    "crashes": 'kill -SEGV $$',
    "is_killed": 'kill -KILL $$',
    "hangs": 'trap "" TERM; sleep 600 & wait; sleep 600',
    "writes_nothing": 'exit 0',
    "truncates": '"$POVRAY" "$@"; truncate -s 300 "$BASE.png"; exit 0',
    "writes_another_size": '"$POVRAY" "$@" +W50 +H40 +SC0 +EC1.0 +SR0 +ER1.0; exit 0',
    "corrupts": '"$POVRAY" "$@"; printf "%100s" > "$PLACE/patch"; '
                'dd if="$PLACE/patch" of="$BASE.png" bs=1 seek=200 conv=notrunc 2> /dev/null; '
                'rm "$PLACE/patch"; exit 0',
    "fails": 'echo "Fatal error in renderer: Out of patience." >&2; exit 1',
}
# What is said where every launch does so.
SAYS = {
    "crashes": "signal 11 .SIGSEGV",
    "is_killed": "signal 9 .SIGKILL",
    "hangs": "did not end within 2 s .--timeout",
    "writes_nothing": "POV-Ray wrote no image",
    "truncates": "png",
    "writes_another_size": "50x40 pixels where 192x128",
    "corrupts": "png",
    "fails": "Out of patience",
}


def timeout_of(fault):
    return ["--timeout", "2"] if fault == "hangs" else []


def once(fault):
    """One launch does so: its section is rendered again, and the image is right."""
    def case(place):
        done = require_success(place.mpipov(2, *timeout_of(fault),
                                            hook=f'[ "$N" != 2 ] || {{ {DAMAGE[fault]}; }}'))
        place.require_image()
        if place.launches() != SECTIONS + 1:
            raise TestFailure(f"{place.launches()} launches, not {SECTIONS + 1}:\n{done.stderr}")
        place.require_left("image.png", "run.json")
    return case


def always(fault):
    """Every launch does so: the run ends with 3 and says why; nothing stays behind."""
    def case(place):
        done = place.mpipov(2, *timeout_of(fault), hook=DAMAGE[fault])
        require_ended(done, 3, SAYS[fault])
        place.require_left()
    return case


def on_one_rank(place):
    """Whatever rank 1 starts fails: rank 0 renders it all, though no section is tried twice."""
    require_success(place.mpipov(2, hook=f'[ "$PMI_RANK" != 1 ] || {{ {DAMAGE["fails"]}; }}'))
    place.require_image()
    ranks = {section["rank"] for section in
             json.loads((place.folder / "run.json").read_text())["sections"]}
    if ranks != {0}:
        raise TestFailure(f"sections were rendered by ranks {ranks}, not by rank 0 alone")


def work_full_before(place):
    with disk_in(place, "64k") as disk:
        disk.fill()
        done = place.mpipov(2, "--work-dir", "disk/work")
        require_ended(done, 4, "disk/work.*No space left on device")
        place.require_left("disk", "disk/filling")


def work_full_during(place):
    with disk_in(place, "64k") as disk:
        work = ["--work-dir", "disk/work"]
        place.work_folder = disk.folder / "work"
        done = place.mpipov(2, *work)
        if not 0 < place.sections_kept() < SECTIONS:
            raise TestFailure(f"{place.sections_kept()} sections kept:\n{done.stderr}")
        require_ended(done, 4, "disk/work.*No space left on device.*sections are kept in "
                               ".*: go on with --resume")
        disk.enlarge("8m")
        place.goes_on(*work)
        place.require_image()
        place.require_left("disk", "image.png", "run.json")


def work_read_only_before(place):
    with disk_in(place, "8m") as disk:
        disk.read_only()
        done = place.mpipov(2, "--work-dir", "disk/work")
        require_ended(done, 4, "disk/work.*Read-only file system")
        place.require_left("disk")


def work_read_only_during(place):
    with disk_in(place, "8m") as disk:
        work = ["--work-dir", "disk/work"]
        place.work_folder = disk.folder / "work"
        # The remount is refused while a file is open for writing; then a later launch does it.
        done = place.mpipov(2, *work, hook='[ "$N" -lt 4 ] || mount -o remount,ro "$PLACE/disk"')
        disk.writable()
        require_ended(done, 4, "disk/work.*Read-only file system.*sections are kept in .*: go on with "
                               "--resume")
        place.goes_on(*work)
        place.require_image()
        place.require_left("disk", "image.png", "run.json")


def temporary_full(place):
    """No room where POV-Ray writes its sections."""
    with disk_in(place, "40k") as disk:
        done = place.mpipov(2, temporary=disk.folder)
        require_ended(done, 4, "of [0-9]+ KiB that its files may take .*disk.* has [0-9]+ left: set TMPDIR")
        place.require_left("disk")


def output_gone_with_own_work_folder(place):
    """The image's folder is removed while the last section is rendered."""
    (place.folder / "out").mkdir()
    arguments = ["+Oout/image.png", "--record", "run.json", "--work-dir", "work"]
    place.work_folder = place.folder / "work"
    done = place.mpipov(2, *arguments, hook=f'[ "$N" != {SECTIONS} ] || rm -rf "$PLACE/out"')
    require_ended(done, 4, f"cannot write 'out/image.png'.*; {SECTIONS} of {SECTIONS} sections are "
                           "kept in '.*work': go on with --resume")
    (place.folder / "out").mkdir()
    place.goes_on(*arguments, hook="exit 1")
    place.require_image("out/image.png")
    place.require_left("out", "out/image.png", "run.json")


def output_gone_with_the_sections(place):
    (place.folder / "out").mkdir()
    done = place.mpipov(2, "+Oout/image.png", hook=f'[ "$N" != {SECTIONS} ] || rm -rf "$PLACE/out"')
    require_ended(done, 4, "out/image.png.*[Nn]o such")
    place.require_left()


def another_version(place):
    """An image is not made of sections of two POV-Rays."""
    done = place.mpipov(2, hook='[ "$N" -lt 5 ] || kill -KILL $$')
    require_ended(done, 3, "SIGKILL")
    place.write_povray(OTHER_VERSION)
    require_ended(place.mpipov(2, "--resume"), 2, "POV-Ray.*3[.]7[.]0[.].*3[.]7[.]0[.]99")
    place.write_povray(THIS_VERSION)
    place.goes_on()
    place.require_image()


def cases():
    found = {}
    for fault in DAMAGE:
        found[f"once.{fault}"] = once(fault)
        found[f"always.{fault}"] = always(fault)
    found |= {
        "on_one_rank": on_one_rank,
        "work_full.before": work_full_before,
        "work_full.during": work_full_during,
        "work_read_only.before": work_read_only_before,
        "work_read_only.during": work_read_only_during,
        "temporary_full": temporary_full,
        "output_gone.own_work_folder": output_gone_with_own_work_folder,
        "output_gone.with_the_sections": output_gone_with_the_sections,
        "another_version": another_version,
        "silent_hydra.at_the_start": silent_at("init", 5),
        "silent_hydra.at_the_end": silent_at("finalize", 0),
    }
    for whom, signal in KILLS:
        found[f"killed.{whom}.{signal}"] = killed(whom, signal)
    return found


def main():
    parser = argument_parser(__doc__)
    parser.add_argument("command", choices=["list", "run", "soak"])
    parser.add_argument("case", nargs="?", metavar="CASE")
    parser.add_argument("--images", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    known = cases()
    if options.command == "list":
        print("\n".join(known))
        return 0
    if options.command == "soak":
        with Place(options, "soak") as place:
            soak(place, options.images, options.seed)
        return 0
    if options.case not in known:
        parser.error(f"no case '{options.case}': see faults.py list")
    with Place(options, options.case) as place:
        known[options.case](place)
    return 0


if __name__ == "__main__":
    report(main)
