"""Jobs of Snakemake without their start: each script is run by a fork of a process that waits.

A job takes a second of processor time before it begins, nearly all of it imports. As with
:mod:`warm_snakemake`, what is forked holds packages of others alone: a script loads the project's
own code anew, from wherever Snakemake's environment says.
"""

import contextlib
import json
import os
import runpy
import selectors
import signal
import socket
import sys
import traceback
from collections.abc import Mapping
from subprocess import CalledProcessError
from typing import Any, NoReturn


def serve_jobs() -> None:
    """Have the Snakemake of this process run its scripts so; to be called before it begins."""
    from snakemake.benchmark import benchmarked
    from snakemake.script import PythonScript

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

    def execute_script(self: Any, fname: str, edit: bool = False) -> None:
        with socket.socket(socket.AF_UNIX) as job, job.makefile("rw") as talk:
            job.connect(address)
            asked = {"script": fname, "directory": os.getcwd(), "environment": {**os.environ}}
            print(json.dumps(asked), file=talk, flush=True)
            measured = contextlib.nullcontext()
            pid = int(talk.readline())
            if self.bench_record is not None:
                measured = benchmarked(pid, self.bench_record)
            with measured:
                code = int(talk.readline() or -signal.SIGKILL)
        if code:
            raise CalledProcessError(code, f"python {fname}")

    PythonScript.execute_script = execute_script


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
    """Run a script as a program; the exit code that it would have."""
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    os.chdir(asked["directory"])
    os.environ.clear()
    os.environ.update(asked["environment"])
    script = asked["script"]
    sys.argv = [script]
    own = os.environ.get("PYTHONPATH", "")
    sys.path[:1] = [os.path.dirname(script), *filter(None, own.split(os.pathsep))]
    code: Any = 0
    try:
        runpy.run_path(script, run_name="__main__")
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
