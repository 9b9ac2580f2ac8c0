"""Run the script of one simulation as the workflow does, but without Snakemake.

alone.py ID [STEPS]: with SIGTERM from within after so many steps, if they are given.
"""

import os
import runpy
import signal
import sys
from pathlib import Path
from types import SimpleNamespace

from nucleation.configuration.load import load
from nucleation.datasets import provenance
from nucleation.pipeline import progress

SCRIPT = Path(__file__).parents[2] / "workflow" / "scripts" / "simulate.py"

(run,) = (run for run in load("config.yaml").runs if run.id == sys.argv[1])
log = Path("results/logs/simulate", f"{run.id}.log")
log.parent.mkdir(parents=True, exist_ok=True)
job = SimpleNamespace(
    params=SimpleNamespace(
        parameters=run.parameters.to_dict(), digest=provenance.digest("nucleation.simulation.run")
    ),
    output=[f"results/simulations/{run.id}.nc"],
    log=[str(log)],
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
