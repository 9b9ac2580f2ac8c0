"""Snakemake without its start: each call is a fork of a process that has imported it already.

``python -m snakemake`` takes some seconds of processor time, two thirds of which are imports. The
process that is forked holds packages of others alone, so that every call loads the project's own
code anew, of whatever checkout it is given.
"""

import atexit
import functools
import gc
import importlib
import json
import os
import signal
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from warm_jobs import serve_jobs

PACKAGES = (
    "snakemake.cli",
    "snakemake.parser",
    "snakemake.report",
    "snakemake.dag",
    "snakemake.script",
    "pandas",
    "pint",
    "scipy.special",
    "scipy.optimize",
    "xarray",
    "yaml",
    "click",
    "numba",
    "scipy.linalg",
    "scipy.fft",
    "netCDF4",
    "matplotlib.figure",
    "jinja2",
    "matplotlib.backends.backend_agg",
    "matplotlib.backends.backend_pdf",
    "scipy.integrate",
)
"""What a call and its jobs would import. One that is missing here costs time, no more."""


class Warm:
    """The process that is forked; its calls come one after the other."""

    def __init__(self) -> None:
        self._server = subprocess.Popen(
            [sys.executable, __file__], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        atexit.register(self._server.communicate)  # which ends it

    def __call__(
        self,
        arguments: Sequence[str],
        directory: Path,
        output: Path,
        *,
        seconds: int = 600,
        **environment: str,
    ) -> subprocess.CompletedProcess:
        """Snakemake with these arguments, in a directory, with all it prints in a file.

        Raises AssertionError if it takes longer than some seconds.
        """
        call = {
            "arguments": list(arguments),
            "directory": str(directory),
            "output": str(output),
            "environment": {**os.environ, **environment},
            "seconds": seconds,
        }
        print(json.dumps(call), file=self._server.stdin, flush=True)
        code = int(self._server.stdout.readline())
        printed = output.read_text(errors="replace")
        assert code != TOO_LONG, f"still running after {seconds} s:\n{printed}"
        return subprocess.CompletedProcess(call["arguments"], code, printed)


@functools.cache
def warm() -> Warm:
    """The one of this process."""
    return Warm()


TOO_LONG = 124


def serve() -> Mapping | None:
    """Answer calls until there are no more. Within a fork it returns the call to be done."""
    for line in sys.stdin:
        call = json.loads(line)
        child = os.fork()
        if child == 0:
            return call
        print(_ended(child, call["seconds"]), flush=True)
    return None


def _ended(child: int, seconds: int) -> int:
    """The exit code of a child, which is terminated if it takes too long: it ends its jobs."""
    signal.signal(signal.SIGALRM, lambda *_: os.kill(child, signal.SIGTERM))
    signal.alarm(seconds)
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    return code if signal.alarm(0) else TOO_LONG


def become(call: Mapping) -> None:
    """Run Snakemake as the program of this process."""
    os.chdir(call["directory"])
    os.environ.clear()
    os.environ.update(call["environment"])
    nothing = os.open(os.devnull, os.O_RDONLY)
    printed = os.open(call["output"], os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    for source, target in ((nothing, 0), (printed, 1), (printed, 2)):
        os.dup2(source, target)
    sys.stdin = os.fdopen(0)  # the other one has read ahead
    sys.argv = ["snakemake", *call["arguments"]]
    sys.path[0] = call["directory"]  # as with python -m
    serve_jobs()
    importlib.import_module("snakemake.cli").main(call["arguments"])


if __name__ == "__main__":
    for package in PACKAGES:
        importlib.import_module(package)
    importlib.import_module("numba").njit(lambda: 0)()  # as the first compiled function does
    gc.freeze()
    wanted = serve()
    if wanted is not None:
        become(wanted)
