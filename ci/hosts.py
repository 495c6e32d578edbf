"""Hosts on one machine, for tests: network namespaces with an address, a file tree and an sshd each.

A host sees this machine's system folders, and private ones in place of /tmp, /mnt and the source
tree: nothing that is written on one host is seen on another. The programs under test are at
/mnt/bin, as if they were installed. All processes of a host end with it.
"""

import contextlib
import os
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from program_runs import ROOT, Skip, run

HOME = "/mnt/home"        # of the user, on every host
BIN = "/mnt/bin"
KEYS = "/mnt/ssh"
SSH = f"{KEYS}/ssh"       # what hydra is to launch with
NETWORK = "10.77.31."
SSHD = "/usr/sbin/sshd"
START_SECONDS = 10
CGROUP_PERIOD = 20000     # microseconds; short, so that a slow host is slow evenly
PACKAGES = {SSHD: "openssh-server", "ssh": "openssh-client", "ip": "iproute2",
            "unshare": "util-linux", "nsenter": "util-linux"}

SSHD_CONFIG = """HostKey {keys}/host_key
ListenAddress {address}
AuthorizedKeysFile {keys}/user_key.pub
StrictModes no
PermitRootLogin yes
UsePAM no
PidFile none
PrintMotd no
UseDNS no
SetEnv HOME={home} PATH={path} {more}
"""
# Ends by itself where the other side is gone: hydra would wait for it for ever.
SSH_SCRIPT = """#!/bin/sh
exec ssh -F none -i {keys}/user_key -o StrictHostKeyChecking=no -o UserKnownHostsFile=/dev/null \\
    -o LogLevel=ERROR -o ServerAliveInterval=5 -o ServerAliveCountMax=3 "$@"
"""
PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"


def require_namespaces():
    """Raises Skip, which says what is missing."""
    if os.geteuid() != 0:
        raise Skip("hosts as network namespaces need root")
    for program, package in PACKAGES.items():
        if shutil.which(program) is None:
            raise Skip(f"there is no {program} (Debian: apt-get install {package})")
    tried = subprocess.run(["unshare", "-n", "-m", "-u", "-i", "-p", "-f", "--mount-proc", "true"],
                           capture_output=True, text=True, check=False)
    if tried.returncode != 0:
        raise Skip(f"no namespaces can be made here: {tried.stderr.strip()}")


class Namespaces:
    """Those of a process of ours, which holds them; they end with it."""

    def __init__(self, *kinds):
        self.flags = [kind for kind in kinds if kind in ("-n", "-m", "-u", "-i", "-T")]
        # The holder ends with us even where we are killed.
        self.holder = subprocess.Popen(
            ["unshare", *kinds, "-p", "-f", "--kill-child", "--mount-proc", "--propagation",
             "private", "bash", "-c", "sleep infinity & wait"],  # it reaps what others leave
            stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=_die_with_parent)
        self.pid = self._inner()

    def _inner(self):
        end = time.monotonic() + START_SECONDS
        while time.monotonic() < end:
            if self.holder.poll() is not None:
                raise Skip(f"unshare ended with {self.holder.returncode}")
            children = Path(f"/proc/{self.holder.pid}/task/{self.holder.pid}/children")
            if pids := children.read_text().split():
                return int(pids[0])
            time.sleep(0.01)
        raise Skip("unshare starts no process")

    def enter(self):
        return ["nsenter", "-t", str(self.pid), *self.flags, "-p"]

    def shell(self, script):
        done = subprocess.run([*self.enter(), "sh", "-ec", script], capture_output=True, text=True,
                              check=False)
        if done.returncode != 0:
            raise Skip(f"a host cannot be set up: {done.stderr.strip()} ({script.strip()})")
        return done.stdout

    def close(self):
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.pid, signal.SIGKILL)
        self.holder.wait()


def _die_with_parent():
    import ctypes
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


class Host(Namespaces):
    def __init__(self, number, bin_folder, keys, clock_offset=0):
        clock = ["-T", "--monotonic", str(clock_offset), "--boottime",
                 str(clock_offset)] if clock_offset else []
        super().__init__("-n", "-m", "-u", "-i", *clock)
        self.name = f"h{number}"
        self.address = f"{NETWORK}{number}"
        self.keys = keys
        self.group = None
        self.shell(f"""
hostname {self.name}
ip link set lo up
mount -t tmpfs -o mode=755 {self.name} /mnt
mkdir -p {BIN} {KEYS} {HOME} /mnt/empty
mount --bind {bin_folder} {BIN}
cp -r {keys}/. {KEYS}
mount -t tmpfs -o mode=755 {self.name} {ROOT}
mount -t tmpfs -o mode=1777 {self.name} /tmp
mkdir -p /run/sshd
""")
        Path(f"/proc/{self.pid}/root{KEYS}/ssh").write_text(SSH_SCRIPT.format(keys=KEYS))
        self.shell(f"chmod 755 {SSH}; chmod 600 {KEYS}/*_key")

    def path(self, file):
        """Of a file of the host, seen from here."""
        return Path(f"/proc/{self.pid}/root{file}")

    def listen(self, environment=""):
        self.path(f"{KEYS}/sshd_config").write_text(
            SSHD_CONFIG.format(keys=KEYS, address=self.address, home=HOME, path=f"{BIN}:{PATH}",
                               more=environment))
        self.shell(f"{SSHD} -f {KEYS}/sshd_config")

    def limit_cpu(self, cores):
        """True where the kernel keeps the host to that."""
        for base, quota in ((Path("/sys/fs/cgroup/cpu"), "cpu.cfs_quota_us"),
                            (Path("/sys/fs/cgroup"), "cpu.max")):
            group = base / f"mpipov-{os.getpid()}-{self.name}"
            try:
                group.mkdir()
                value = str(int(cores * CGROUP_PERIOD))
                if quota == "cpu.max":
                    value += f" {CGROUP_PERIOD}"
                else:
                    (group / "cpu.cfs_period_us").write_text(str(CGROUP_PERIOD))
                # What it may have, it gets, whatever else the machine does.
                weight = ("cpu.weight", "10000") if quota == "cpu.max" else ("cpu.shares", "200000")
                (group / weight[0]).write_text(weight[1])
                (group / quota).write_text(value)
                for pid in self.processes():
                    (group / "cgroup.procs").write_text(str(pid))
                self.group = group
                return True
            except OSError:
                with contextlib.suppress(OSError):
                    group.rmdir()
        return False

    def processes(self):
        """{pid: command line} of all of them, seen from here, but for the holder's own."""
        namespace = os.readlink(f"/proc/{self.pid}/ns/pid")
        found = {}
        for entry in Path("/proc").iterdir():
            with contextlib.suppress(OSError):
                if entry.name.isdigit() and os.readlink(entry / "ns/pid") == namespace:
                    words = (entry / "cmdline").read_bytes().split(b"\0")
                    found[int(entry.name)] = " ".join(w.decode(errors="replace") for w in words)
        return found

    def close(self):
        super().close()
        if self.group:
            with contextlib.suppress(OSError):
                self.group.rmdir()


class Hosts:
    """So many of them, joined by a switch."""

    def __init__(self, count, bin_folder, clock_offsets=None, environments=None):
        require_namespaces()
        self.hosts = []
        self.switch = None
        keys = tempfile.mkdtemp(prefix="mpipov-keys-")
        try:
            for key in ("host_key", "user_key"):
                subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f",
                                f"{keys}/{key}"], check=True)
            self.switch = Namespaces("-n", "-m", "-u", "-i")
            self.switch.shell("ip link add switch type bridge; ip link set switch up")
            for number in range(1, count + 1):
                host = Host(number, bin_folder, keys, (clock_offsets or {}).get(number, 0))
                self.hosts.append(host)
                self._plug_in(host)
            names = "".join(f"{host.address} {host.name}\n" for host in self.hosts)
            for host in self.hosts:
                host.path("/mnt/hosts").write_text(f"127.0.0.1 localhost\n{names}")
                host.shell("mount --bind /mnt/hosts /etc/hosts")
                host.listen((environments or {}).get(host.name, ""))
        except BaseException:
            self.close()
            raise
        finally:
            shutil.rmtree(keys)

    def _plug_in(self, host):
        subprocess.run(["nsenter", "-t", str(self.switch.pid), "-n", "ip", "link", "add",
                        host.name, "type", "veth", "peer", "name", "eth0", "netns",
                        str(host.pid)], check=True)
        self.switch.shell(f"ip link set {host.name} master switch up")
        host.shell(f"ip addr add {host.address}/24 dev eth0; ip link set eth0 up")

    def cut_off(self, host):
        """The network takes no more from it, and brings it nothing."""
        self.switch.shell(f"ip link set {host.name} down")

    def mend(self, host):
        self.switch.shell(f"ip link set {host.name} up")

    def __enter__(self):
        return self.hosts

    def __exit__(self, *_):
        self.close()

    def close(self):
        for host in self.hosts:
            host.close()
        if self.switch:
            self.switch.close()


def mpiexec(programs, hosts, slots=1):
    """hydra's first words; it is started on the first host."""
    text = "".join(f"{host.name}:{slots}\n" for host in hosts)
    hosts[0].path("/mnt/hostfile").write_text(text)
    return [programs.mpiexec, "-launcher", "ssh", "-launcher-exec", SSH, "-f", "/mnt/hostfile"]


def on_host(folder):
    """What a command on a host begins with, after host.enter()."""
    return ["env", "-C", folder, f"HOME={HOME}", f"PATH={BIN}:{PATH}"]


def run_on(host, argv, folder, seconds):
    """Runs to the end in a folder of the host's."""
    return run([*host.enter(), *on_host(folder), *argv], "/", None, seconds)
