"""Run the script of one simulation as the workflow does, but without Snakemake.

alone.py ID [STEPS]: with SIGTERM from within after so many steps, if they are given.
"""

import os
import runpy
import signal
import sys
from pathlib import Path
from types import SimpleNamespace

from harness import SCRIPT, Place

from nucleation.pipeline import running

task = Place(Path()).task(sys.argv[1])
job = SimpleNamespace(
    params={"call": task.call, "loads": task.loads, **task.values},
    input={},
    output=[task.link],
    log=[f"results/logs/simulations/{Path(task.link).stem}.log"],
    rule="simulate",
)


class Stopping(running.Progress):
    """Progress that asks the run to stop."""

    def __call__(self, instant):
        super().__call__(instant)
        if instant.control.steps == int(sys.argv[2]):
            os.kill(os.getpid(), signal.SIGTERM)


if len(sys.argv) > 2:
    running.Progress = Stopping
runpy.run_path(str(SCRIPT), init_globals={"snakemake": job})
