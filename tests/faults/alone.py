"""Run the script of one simulation as the workflow does, but without Snakemake.

alone.py ID [STEPS]: with SIGTERM from within after so many steps, if they are given.
"""

import os
import runpy
import signal
import sys
from pathlib import Path
from types import SimpleNamespace

from harness import SCRIPT, Place, made

from nucleation.configuration.load import load
from nucleation.model.friction.registry import plugins
from nucleation.pipeline import code, progress

(run,) = (run for run in load("config.yaml").runs if run.id == sys.argv[1])
output = Place(Path()).simulation(run.id)
log = Path("results/logs/simulate", output.with_suffix(".log").name)
log.parent.mkdir(parents=True, exist_ok=True)
job = SimpleNamespace(
    params=SimpleNamespace(
        parameters=run.parameters.to_dict(),
        code=code.digest(str(SCRIPT), *code.ALWAYS, *plugins(run.parameters)),
        modules=list(plugins(run.parameters)),
        made=made(run),
        expected={},
    ),
    input=[],
    output=[str(output)],
    log=[str(log)],
    config={},
    rule="simulate",
)


class Stopping(progress.Progress):
    """Progress that asks the run to stop."""

    def __call__(self, instant):
        super().__call__(instant)
        if instant.control.steps == int(sys.argv[2]):
            os.kill(os.getpid(), signal.SIGTERM)


if len(sys.argv) > 2:
    progress.Progress = Stopping
runpy.run_path(str(SCRIPT), init_globals={"snakemake": job})
