"""Processes to disturb: with all their children, their processor time and what they say."""

from __future__ import annotations

import contextlib
import dataclasses
import os
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path
from typing import ClassVar

import psutil

ROOT = Path(__file__).parents[2]
ENVIRONMENT = {
    "NUCLEATION_CHECKPOINT_EVERY": "0.05",
    "OMP_NUM_THREADS": "1",
    "PYTHONPATH": os.pathsep.join(str(ROOT / name) for name in ("src", "tests")),
}
PATIENCE = 600.0
"""Seconds after which a process that should have ended is taken to hang."""


class Lost(AssertionError):
    """A fault has damaged or lost something, or ended without a clear error."""


def require(condition: object, message: str) -> None:
    """Raise :class:`Lost` with the message unless the condition holds."""
    if not condition:
        raise Lost(message)


@dataclasses.dataclass(frozen=True)
class Done:
    """A process that has ended: exit status, all it wrote, processor time (s) with its children."""

    status: int
    output: str
    cpu: float


class Running:
    """A process with its children, in a process group of its own as in a terminal of its own."""

    started: ClassVar[list[Running]] = []

    def __init__(
        self,
        command: list[str],
        directory: Path,
        prepare: Callable[[], object] | None = None,
        **environment: str,
    ) -> None:
        def before() -> None:
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
                signal.signal(number, signal.SIG_DFL)  # a shell's background job ignores Ctrl-C
            if prepare is not None:
                prepare()

        self._output = directory.parent / f"{directory.name}.{time.monotonic_ns()}.output"
        with self._output.open("wb") as output:
            self.process = subprocess.Popen(
                command,
                cwd=directory,
                env={**os.environ, **ENVIRONMENT, **environment},
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
                preexec_fn=before,
            )
        self.pid = self.process.pid
        self.started.append(self)

    def tree(self) -> list[psutil.Process]:
        """The process and all below it, as far as they are alive."""
        with contextlib.suppress(psutil.NoSuchProcess):
            top = psutil.Process(self.pid)
            return [top, *top.children(recursive=True)]
        return []

    def scripts(self) -> list[psutil.Process]:
        """The Python processes that run simulations."""
        found = []
        for process in self.tree():
            with contextlib.suppress(psutil.Error):
                if {"replication.pipeline.job", "simulate"} <= {*process.cmdline()}:
                    found.append(process)
        return found

    def ended(self) -> bool:
        """Whether it has ended; its status stays to be read, together with what it used."""
        return os.waitid(os.P_PID, self.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None

    def wait_for(self, condition: Callable[[], object]) -> bool:
        """Whether a condition came true before the process ended."""
        begin = time.monotonic()
        while not self.ended():
            if condition():
                return True
            if time.monotonic() - begin > PATIENCE:
                self.signal(signal.SIGKILL, group=True)
                raise Lost(f"a process hangs: {self._said()[-2000:]}")
            time.sleep(0.01)
        return False

    def spend(self, seconds: float) -> bool:
        """Let it use so much processor time, a measure of its progress on a busy machine too."""
        return self.wait_for(lambda: processor_time(self.tree()) >= seconds)

    def signal(self, number: signal.Signals, *, group: bool = False) -> None:
        """Send it a signal, alone or to all it has started, unless it has ended."""
        with contextlib.suppress(ProcessLookupError):
            (os.killpg if group else os.kill)(self.pid, number)

    @classmethod
    def kill_all(cls) -> None:
        """End what is left of all that were started."""
        while cls.started:
            cls.started.pop().signal(signal.SIGKILL, group=True)

    def end(self) -> Done:
        """Wait for its end."""
        self.wait_for(lambda: False)
        _, status, usage = os.wait4(self.pid, 0)
        self.process.returncode = os.waitstatus_to_exitcode(status)
        return Done(self.process.returncode, self._said(), usage.ru_utime + usage.ru_stime)

    def interrupt(self, number: signal.Signals, seconds: float, *, group: bool = False) -> Done:
        """Send a signal once it has used so much processor time, and wait for its end."""
        if self.spend(seconds):
            self.signal(number, group=group)
        return self.end()

    def _said(self) -> str:
        return self._output.read_text(errors="replace")


def processor_time(processes: list[psutil.Process]) -> float:
    """Processor time (s) that processes have used, and their children that have ended."""
    total = 0.0
    for process in processes:
        with contextlib.suppress(psutil.Error):
            total += sum(process.cpu_times()[:4])
    return total
