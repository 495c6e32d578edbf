"""A scene with its files on the first host of several, and what must hold of a run of it."""

import re
import shutil
import time
from pathlib import Path

from hosts import BIN, HOME, run_on
from program_runs import TestFailure, require_success

JOB = f"{HOME}/job"
SCENE = """#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 12 }
#include "colours.inc"
camera { location <0, 2, -6> look_at <0, 0.5, 0> }
light_source { <5, 8, -6> 1 area_light <1, 0, 0>, <0, 1, 0>, 5, 5 }
light_source { <-6, 9, 2> 0.4 }
plane { y, 0 pigment { image_map { ppm "maps/tile.ppm" } rotate x * 90 } finish { reflection 0.3 } }
#declare I = 0;
#while (I < 60)
  sphere { <mod(I, 10) * 0.6 - 2.7, 0.3 + int(I / 10) * 0.55, int(I / 10) * 0.4>, 0.27
    pigment { Glass } finish { reflection 0.3 phong 1 } interior { ior 1.3 } }
  #declare I = I + 1;
#end
text { ttf "own.ttf" "host" 0.2, 0 pigment { rgb y } translate <-1, 0.1, -2> }
"""
FILES = {"job/scene.pov": SCENE, "lib/colours.inc": "#declare Glass = pigment { rgbf "
         "<0.9, 0.95, 1, 0.6> };\n", "job/maps/tile.ppm": "P3\n2 2\n255\n255 0 0 0 0 255 "
         "0 255 0 250 250 250\n"}
FONT = Path("/usr/share/povray-3.7/include/cyrvetic.ttf")
ARGUMENTS = ["scene.pov", "+L../lib", "+A0.1", "+R3", "--progress", "plain"]
SMALL = ["+W160", "+H128"]
LARGE = ["+W256", "+H192"]
RUN_SECONDS = 300
WATCH_SECONDS = 0.1
GONE_SECONDS = 2
SLOW_POVRAY = "/mnt/slow-povray"
# A launch of a section waits before it begins, so that a run lasts on any machine.
SLOW_SCRIPT = """#!/bin/sh
case "$*" in *+SC0*|*+HI*|*version*) ;; *+WT1*+O*section*) sleep {seconds} ;; esac
exec povray "$@"
"""
# Longer than a lost host takes to be noticed, else the others would have copied its last sections by
# then.
SLOW_SECONDS = 6


def fill(host):
    """The scene's folder, seen from here."""
    home = host.path(HOME)
    for name, text in FILES.items():
        (home / name).parent.mkdir(parents=True, exist_ok=True)
        (home / name).write_text(text)
    shutil.copy(FONT, home / "job" / "own.ttf")
    return home / "job"


def slow_povray(host, seconds=SLOW_SECONDS):
    host.path(SLOW_POVRAY).write_text(SLOW_SCRIPT.format(seconds=seconds))
    host.path(SLOW_POVRAY).chmod(0o755)


def require_serial(host, size):
    """The image is what one POV-Ray makes."""
    words = ["povray", *ARGUMENTS[:4], *size, "+Oserial.png", "+WT1", "-D", "-P"]
    require_success(run_on(host, words, JOB, RUN_SECONDS))
    words = [f"{BIN}/mpipov-validate", "compare", "serial.png", "image.png", "--no-ssim"]
    require_success(run_on(host, words, JOB, RUN_SECONDS))


def renderers(host):
    """The processes of a run that are left there."""
    return [line for line in host.processes().values() if re.search("povray|mpipov", line)]


def require_nothing_runs(hosts):
    """Within the promised time. Seconds until it was so."""
    begin = time.monotonic()
    while any((left := {host.name: renderers(host) for host in hosts}).values()):
        if time.monotonic() > begin + GONE_SECONDS:
            raise TestFailure(f"processes are left after {GONE_SECONDS} s: {left}")
        time.sleep(WATCH_SECONDS / 4)
    return time.monotonic() - begin


def require_nothing_left(hosts):
    """No process, no temporary file, and on no other host than the first one anything at all."""
    require_nothing_runs(hosts)
    for host in hosts:
        if files := [str(file) for file in host.path("/tmp").iterdir()]:
            raise TestFailure(f"left on {host.name}: {files}")
    for host in hosts[1:]:
        if files := list(host.path(HOME).iterdir()):
            raise TestFailure(f"left in the home folder of {host.name}: {files}")
