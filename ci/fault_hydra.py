"""A hydra that stops answering, for faults.py: what mpipov does when a signal comes then.

Hydra speaks PMI-1 to each rank, lines of text over the descriptor PMI_FD. This one answers a single
rank up to a command of its choice.
"""

import os
import re
import signal
import socket
import subprocess
import time

from program_runs import TestFailure

ANSWERS = {
    "init": "cmd=response_to_init pmi_version=1 pmi_subversion=1 rc=0",
    "get_maxes": "cmd=maxes kvsname_max=256 keylen_max=64 vallen_max=1024",
    "get_appnum": "cmd=appnum appnum=0",
    "get_my_kvsname": "cmd=my_kvsname kvsname=test",
    "barrier_in": "cmd=barrier_out",
    "put": "cmd=put_result rc=0 msg=success",
    "get": "cmd=get_result rc=0 msg=success value=(vector,(0,1,1))",
}
REACHED_SECONDS = 60
# Not before: a call that is only slow is waited for. Not much later, on a busy machine.
PATIENCE_SECONDS, ENDED_SECONDS = 2, 10


def answer_until(hydra, silent):
    """Answers until the command comes that gets no answer."""
    hydra.settimeout(REACHED_SECONDS)
    lines = hydra.makefile("r")
    for line in lines:
        command = re.match(r"cmd=(\w+)", line)[1]
        if command == silent:
            return
        if command not in ANSWERS:
            raise TestFailure(f"this hydra knows no '{line.strip()}'")
        hydra.sendall((ANSWERS[command] + "\n").encode())
    raise TestFailure(f"mpipov ended before it said '{silent}'")


def silent_at(command, code):
    """SIGTERM while MPI waits for an answer: mpipov ends by itself, with that code."""
    def case(place):
        hydra, rank = socket.socketpair()
        environment = {**place.environment(""), "PMI_FD": str(rank.fileno()), "PMI_RANK": "0",
                       "PMI_SIZE": "1"}
        with hydra, subprocess.Popen([place.programs.mpipov, *map(str, place.arguments())],
                                     cwd=place.folder, stdin=subprocess.DEVNULL,
                                     stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                     pass_fds=[rank.fileno()], env=environment) as process:
            rank.close()
            try:
                answer_until(hydra, command)
                begin = time.monotonic()
                process.send_signal(signal.SIGTERM)
                _, said = process.communicate(timeout=ENDED_SECONDS)
            except subprocess.TimeoutExpired:
                raise TestFailure(f"still waits for hydra {ENDED_SECONDS} s after SIGTERM") from None
            finally:
                process.kill()
            waited = time.monotonic() - begin
        if process.returncode != code or "MPI did not answer" not in said:
            raise TestFailure(f"ended with {process.returncode}, wanted {code}:\n{said}")
        if waited < PATIENCE_SECONDS:
            raise TestFailure(f"waited only {waited:.1f} s for the answer")
        print(f"ended {waited:.1f} s after SIGTERM", flush=True)
    return case
