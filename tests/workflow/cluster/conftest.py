"""A Slurm of two virtual nodes, started and stopped by the project's scripts."""

import contextlib
import dataclasses
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest
from commands_of_slurm import output_of, wait_for

SCRIPTS = Path(__file__).parent / "slurm"
STATE = Path("/run/nucleation-slurm")
AS_ROOT = [] if os.geteuid() == 0 else ["sudo", "--non-interactive"]


@dataclasses.dataclass(frozen=True)
class Slurm:
    """The batch system, as its own commands show it."""

    def start(self, *arguments: str) -> subprocess.CompletedProcess:
        """Start what does not run."""
        command = [*AS_ROOT, str(SCRIPTS / "start.sh"), *arguments]
        with tempfile.TemporaryFile("w+") as log:  # the daemons would keep a pipe open
            status = subprocess.run(command, stdout=log, stderr=log).returncode
            log.seek(0)
            return subprocess.CompletedProcess(command, status, log.read())

    def stop(self) -> None:
        subprocess.run([*AS_ROOT, str(SCRIPTS / "stop.sh")], check=True)

    def jobs(self, directory: Path | None = None) -> list[dict[str, str]]:
        """All jobs ever submitted, from a directory, with the keys of ``scontrol show job``."""
        lines = output_of("scontrol", "show", "job", "--oneliner").splitlines()
        jobs = [dict(word.split("=", 1) for word in line.split() if "=" in word) for line in lines]
        return [job for job in jobs if directory is None or job.get("WorkDir") == str(directory)]

    def end(self, process: subprocess.Popen, directory: Path) -> None:
        """End a workflow that a test has given up, with its jobs."""
        if process.poll() is None:
            process.terminate()
            subprocess.run(["scancel", *(job["JobId"] for job in self.jobs(directory))])
        process.communicate()

    def pid(self, daemon: str) -> int:
        return int((STATE / f"{daemon}.pid").read_text())

    def take_down(self, node: str) -> None:
        """Kill all that runs on a node, and tell the controller, which would notice in a while.

        All at once: a step whose parent dies before it would be ended, and leave checkpoints.
        """
        pid = self.pid(node)
        subprocess.run([*AS_ROOT, "kill", "-KILL", str(pid)], check=True)
        lost = [job["JobId"] for job in self.jobs() if job.get("NodeList") == node]
        found = []
        for process in psutil.process_iter():
            with contextlib.suppress(psutil.Error):
                title = re.match(r"slurmstepd: \[(\d+)\.", " ".join(process.cmdline()))
                job = title[1] if title else process.environ().get("SLURM_JOB_ID")
                if job in lost:
                    found.append(str(process.pid))
        subprocess.run([*AS_ROOT, "kill", "-KILL", *found])
        command = Path(f"/proc/{pid}/cmdline")  # empty while it is a zombie
        wait_for(lambda: not command.exists() or not command.read_bytes())
        update = ["scontrol", "update", f"NodeName={node}", "State=DOWN", "Reason=test"]
        subprocess.run([*AS_ROOT, *update], check=True)


@pytest.fixture(scope="session")
def slurm() -> Iterator[Slurm]:
    """The running batch system. It may be missing on a developer's machine, but not in CI."""
    in_ci = os.environ.get("CI") == "true"
    if shutil.which("slurmctld", path=f"{os.environ['PATH']}:/usr/sbin") is None and not in_ci:
        pytest.skip("no Slurm here: workflow/install-debian.sh cluster")
    slurm = Slurm()
    ran_before = (STATE / "controller.pid").exists()
    started = slurm.start()
    if started.returncode != 0:
        (pytest.fail if in_ci else pytest.skip)(started.stdout)
    os.environ.pop("SLURM_CONF", None)  # none, for all other tests
    yield slurm
    if not ran_before:
        slurm.stop()
