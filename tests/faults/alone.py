"""Run the script of one simulation as the workflow does, but without Snakemake: alone.py ID."""

import runpy
import sys
from pathlib import Path
from types import SimpleNamespace

from nucleation import provenance
from nucleation.configuration import load

SCRIPT = Path(__file__).parents[2] / "workflow" / "scripts" / "simulate.py"

(run,) = (run for run in load("config.yaml").runs if run.id == sys.argv[1])
log = Path("results/logs/simulate", f"{run.id}.log")
log.parent.mkdir(parents=True, exist_ok=True)
job = SimpleNamespace(
    params=SimpleNamespace(
        parameters=run.parameters.to_dict(), digest=provenance.digest("nucleation.simulation")
    ),
    output=[f"results/simulations/{run.id}.nc"],
    log=[str(log)],
)
runpy.run_path(str(SCRIPT), init_globals={"snakemake": job})
