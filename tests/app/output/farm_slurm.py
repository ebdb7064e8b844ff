#!/usr/bin/env python3
"""`weft farm slurm --submit` on a real Slurm with two nodes, all on this machine: 300 frames of a graph that remembers and of one that does
not, while processes of weft are killed and a node is drained. No frame is missing, and all are those of one run, to the byte.

    farm_slurm.py WEFT
"""
import collections
import os
import pathlib
import random
import re
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time

from program import SLOWER, TOP, Report, run, temporary_folder

FRAMES = 300
CONFIGURATION = """ClusterName=weft
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
AuthType=auth/none
CredType=cred/none
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmdPidFile={folder}/%n.pid
SlurmctldPidFile={folder}/slurmctld.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/linear
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0
MpiDefault=none
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]}
NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]}
PartitionName=all Nodes=ALL Default=YES
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


def wait_for(holds, seconds=60):
    end = time.monotonic() + seconds * SLOWER
    while not (found := holds()) and time.monotonic() < end:
        time.sleep(0.1)
    return found


def slurm(*command):
    return subprocess.run(command, capture_output=True, text=True).stdout


class Cluster:
    """A controller and two nodes."""

    def __init__(self, folder):
        import pwd
        (folder / "state").mkdir(parents=True)
        for node in ("n1", "n2"):
            (folder / node).mkdir()
        os.environ["SLURM_CONF"] = str(folder / "slurm.conf")
        (folder / "slurm.conf").write_text(CONFIGURATION.format(
            host=socket.gethostname().split(".")[0], user=pwd.getpwuid(os.getuid()).pw_name, folder=folder, ports=free_ports(3)))
        self.logs = folder / "log"
        with self.logs.open("w") as log:
            start = lambda *command: subprocess.Popen([*command, "-D"], stdout=log, stderr=log)
            self.daemons = [start("slurmctld"), start("slurmd", "-N", "n1"), start("slurmd", "-N", "n2")]

    def is_up(self):
        return slurm("sinfo", "-h", "-o", "%D %t").strip() == "2 idle"

    def end(self):
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in self.daemons:
            daemon.wait()


class Killer(threading.Thread):
    """Kills some processes of weft that draw into a folder, each after a while; never the third of the same frames, as three tries are all that a task has."""

    def __init__(self, weft, graph):
        super().__init__()
        self.words, self.random, self.ends, self.seen = (os.fsencode(weft), b"render", os.fsencode(graph)), random.Random(31), threading.Event(), set()
        self.killed = collections.Counter()  # by command line

    def run(self):
        while not self.ends.wait(0.01):
            for path in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
                try:
                    pid = int(path.parent.name)
                    command = path.read_bytes()
                    if pid in self.seen or not set(self.words) <= set(command.split(b"\0")):
                        continue
                    process = os.pidfd_open(pid)
                    self.seen.add(pid)
                    if self.killed[command] < 2 and self.random.random() < 0.5:
                        self.killed[command] += 1
                        time.sleep(self.random.uniform(0, 0.1))
                        signal.pidfd_send_signal(process, signal.SIGKILL)
                    os.close(process)
                except OSError:
                    continue  # it ended


def draw(report, weft, folder, graph, drained):
    """Draws the frames, first in one run. What was said, and the names of jobs."""
    common = [folder / graph, "--size", "16x9", "--frames", f"0-{FRAMES - 1}"]
    serial = run(weft, "render", *common, "-o", folder / "serial/f_%03d.png")
    report.check(serial.code == 0, f"{graph}: {serial.err}")
    killer = Killer(weft, folder / graph)
    killer.start()
    try:
        out = folder / "farm"
        submitted = run(weft, "farm", "slurm", *common, "-o", out / "f_%03d.png", "--submit", folder=folder)
        report.check(submitted.code == 0, f"{graph}: {submitted.out}{submitted.err}")
        wait_for(lambda: len(list(out.glob("*.png"))) > 30)
        slurm("scontrol", "update", f"nodename={drained}", "state=drain", "reason=test")
        report.check("drain" in slurm("sinfo", "-h", "-n", drained, "-o", "%T"), f"{graph}: {drained} is not drained")
        wait_for(lambda: len(list(out.glob("*.png"))) > FRAMES / 2)
        slurm("scontrol", "update", f"nodename={drained}", "state=resume")
        report.check(wait_for(lambda: not slurm("squeue", "-h"), 240), f"{graph}: jobs stay\n{slurm('squeue')}")
    finally:
        killer.ends.set()
        killer.join()
    logs = {path.name: path.read_text() for path in sorted(out.glob("*.log"))}
    said = "".join(logs.values())
    killed = len(re.findall(r"try \d of 3 .*: exit code 137", said))
    report.check(killed >= 3, f"{graph}: {killed} killed\n{said}")
    gathered = [text for name, text in logs.items() if name.startswith("weft_gather")]
    found = re.search(rf"{FRAMES} frames: (\d+) done already, (\d+) drawn\n\Z", gathered[0] if gathered else "")
    report.check(found and len(logs) == FRAMES // 20 + 1, f"{graph}: {sorted(logs)}\n{gathered}")
    files = lambda name: {path.name: path.read_bytes() for path in (folder / name).glob("*.png")}
    equal = len(files("serial")) == FRAMES and files("farm") == files("serial")
    report.check(equal, f"{graph}: other files than those of one run")
    report.check("cannot be used" not in said, f"{graph}: checkpoints are not used\n{said}")
    last = run(weft, "render", *common, "-o", out / "f_%03d.png", "--skip-done")
    report.check(f"{FRAMES} frames: {FRAMES} done already, 0 drawn\n" in last.err, f"{graph}: {last.err}")
    print(f"{graph}: {len(logs) - 1} tasks, {killed} kills of a process, {drained} drained; gather: {found[0].strip() if found else None}; "
          f"{len(set(files('farm').values()))} different pictures, {'equal' if equal else 'NOT EQUAL'} to one run's", flush=True)


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    os.environ["PATH"] += ":/usr/sbin"
    missing = [name for name, path in (("slurmctld", shutil.which("slurmctld")), ("slurmd", shutil.which("slurmd")), ("sbatch", shutil.which("sbatch"))) if not path]
    if missing:
        report.skip(f"no {missing[0]}: apt-get install slurm-wlm")
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        cluster = Cluster(folder / "slurm")
        try:
            if not report.check(wait_for(cluster.is_up), f"Slurm does not start: {slurm('sinfo')}\n{cluster.logs.read_text()[-3000:]}"):
                report.end()
            for graph, drained in (("trail.json", "n1"), ("toy.json", "n2")):
                home = folder / graph[:-5]
                shutil.copytree(TOP / "docs/tutorials/shaders", home / "shaders")
                shutil.copy(TOP / "docs/tutorials" / graph, home)
                draw(report, weft, home, graph, drained)
        finally:
            cluster.end()
    report.end()


main()
