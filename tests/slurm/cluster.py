"""A SLURM of one node on loopback, in a folder of its own: started, and stopped again.

    python -m tests.slurm.cluster COMMAND ...      runs a command in it

It needs Debian's slurm-wlm and munge, and no rights beyond those of the user; what the machine has set up of
either is left alone.
"""

from __future__ import annotations

import getpass
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

NEEDED = ("munged", "slurmctld", "slurmd", "sbatch", "sinfo")
# Processors that the node says it has: jobs of the recipes fit, whatever the machine has.
CPUS = 8
# Seconds until the node is there.
PATIENCE = 40.0
CONFIGURATION = """\
ClusterName=one
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
MinJobAge=300
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP
"""


def missing() -> list[str]:
    """Programs that are not installed; those of the system may stand outside of PATH."""
    return [name for name in NEEDED if _program(name) is None]


def _program(name: str) -> str | None:
    return shutil.which(name, path=f"{os.environ.get('PATH', '')}:/usr/sbin:/sbin")


def _free_port() -> int:
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return int(one.getsockname()[1])


@contextmanager
def one_node() -> Iterator[dict[str, str]]:
    """Gives the environment in which the commands of SLURM reach it."""
    folder = Path(tempfile.mkdtemp(prefix="slurm-"))
    running: list[subprocess.Popen[bytes]] = []
    host = socket.gethostname().partition(".")[0]
    try:
        for name in ("state", "spool"):
            (folder / name).mkdir()
        (folder / "munge.key").write_bytes(os.urandom(128))
        (folder / "munge.key").chmod(0o600)
        told = {"host": host, "user": getpass.getuser(), "folder": folder, "cpus": CPUS}
        text = CONFIGURATION.format(ports=(_free_port(), _free_port()), **told)
        (folder / "slurm.conf").write_text(text, encoding="utf-8")
        (folder / "cgroup.conf").write_text("CgroupAutomount=no\n", encoding="utf-8")
        environment = {**os.environ, "SLURM_CONF": str(folder / "slurm.conf")}
        for command in _daemons(folder, host):
            with open(folder / "daemons.log", "ab") as log:
                running.append(subprocess.Popen(command, env=environment, stdout=log, stderr=log))
            time.sleep(0.5)
        _wait(environment, folder)
        yield environment
    finally:
        for process in reversed(running):
            process.terminate()
        for process in reversed(running):
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        shutil.rmtree(folder, ignore_errors=True)


def _daemons(folder: Path, host: str) -> list[list[str]]:
    munge = ["--foreground", "--force", f"--socket={folder}/munge.socket", f"--key-file={folder}/munge.key"]
    munge += [f"--pid-file={folder}/munge.pid", f"--log-file={folder}/munge.log"]
    munge += [f"--seed-file={folder}/munge.seed"]
    return [
        [str(_program("munged")), *munge],
        [str(_program("slurmctld")), "-D", "-i"],
        [str(_program("slurmd")), "-D", "-N", host],
    ]


def _wait(environment: dict[str, str], folder: Path) -> None:
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        asked = subprocess.run(
            ["sinfo", "-h", "-o", "%T"], env=environment, capture_output=True, text=True, check=False
        )
        if asked.stdout.strip() == "idle":
            return
        time.sleep(0.5)
    logs = "\n".join(path.read_text(errors="replace")[-2000:] for path in sorted(folder.glob("*.log")))
    raise RuntimeError(f"SLURM did not start: {asked.stdout}{asked.stderr}\n{logs}")


if __name__ == "__main__":
    with one_node() as reached:
        sys.exit(subprocess.run(sys.argv[1:], env=reached, check=False).returncode)
