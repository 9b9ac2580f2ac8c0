"""Jobs of Snakemake without their start: each command is run by a fork of a process that waits.

A job takes a second of processor time before it begins, nearly all of it imports. As with
:mod:`warm_snakemake`, what is forked holds packages of others alone: a job loads the project's own
code anew, from wherever Snakemake's environment says.
"""

import importlib
import json
import os
import runpy
import selectors
import shlex
import signal
import socket
import subprocess
import sys
import traceback
from collections.abc import Mapping
from typing import Any, NoReturn


def serve_jobs() -> None:
    """Have the Snakemake of this process run its jobs so; to be called before it begins."""
    shell = importlib.import_module("snakemake.shell")  # as an attribute it is a class
    assert shell.sp is subprocess  # else each job would start by itself, unseen
    address = f"\0jobs-of-{os.getpid()}"
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(address)
    listener.listen()
    alive, mine = os.pipe()  # whose end says that Snakemake has ended
    if os.fork() == 0:
        os.close(mine)
        _serve(listener, alive)
    os.close(alive)
    listener.close()
    shell.sp = Subprocess(address)


class Subprocess:
    """The module of that name, but for commands that run a job of this project and no more."""

    def __init__(self, address: str) -> None:
        self._address = address

    def __getattr__(self, name: str) -> Any:
        return getattr(subprocess, name)

    def Popen(self, command: Any, **options: Any) -> Any:
        words = shlex.split(command) if isinstance(command, str) else []
        if "replication.pipeline.job" in words and "|" not in words:
            return Job(self._address, words, options.get("env"))
        return subprocess.Popen(command, **options)


class Job:
    """A command that a fork runs, with the methods of a process."""

    def __init__(self, address: str, words: list[str], environment: Mapping | None) -> None:
        self._socket = socket.socket(socket.AF_UNIX)
        self._socket.connect(address)
        self._talk = self._socket.makefile("rw")
        asked = {
            "words": words,
            "directory": os.getcwd(),
            "environment": {**(environment or os.environ)},
        }
        print(json.dumps(asked), file=self._talk, flush=True)
        self.pid = int(self._talk.readline())

    def wait(self) -> int:
        code = int(self._talk.readline() or -signal.SIGKILL)
        self._socket.close()
        return code

    def kill(self) -> None:
        os.kill(self.pid, signal.SIGKILL)

    def terminate(self) -> None:
        os.kill(self.pid, signal.SIGTERM)


def _serve(listener: socket.socket, alive: int) -> NoReturn:
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    wanted = selectors.DefaultSelector()
    wanted.register(listener, selectors.EVENT_READ)
    wanted.register(alive, selectors.EVENT_READ)
    while True:
        if any(key.fileobj == alive for key, _ in wanted.select()):
            os._exit(0)
        job, _ = listener.accept()
        if os.fork() == 0:
            with job.makefile("rw") as talk:
                asked = json.loads(talk.readline())
                print(os.getpid(), file=talk, flush=True)
                code = _run(asked)
                print(code, file=talk, flush=True)
            os._exit(code)
        job.close()


def _run(asked: Mapping[str, Any]) -> int:
    """Run a module as a program; the exit code that it would have."""
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    os.chdir(asked["directory"])
    os.environ.clear()
    os.environ.update(asked["environment"])
    words = asked["words"]
    sys.argv = words[words.index("-m") + 1 :]
    module = sys.argv[0]
    own = os.environ.get("PYTHONPATH", "")
    first = [] if "-P" in words else [asked["directory"]]
    sys.path[:1] = [*first, *filter(None, own.split(os.pathsep))]
    code: Any = 0
    try:
        runpy.run_module(module, run_name="__main__", alter_sys=True)
    except SystemExit as end:
        code = end.code
    except BaseException:
        traceback.print_exc()
        code = 1
    if isinstance(code, str):
        print(code, file=sys.__stderr__)
        code = 1
    sys.stdout.flush()
    sys.stderr.flush()
    return int(code or 0)
