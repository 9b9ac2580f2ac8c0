"""Draw the crosscheck's figure."""

from pathlib import Path

import numpy as np
from nucleation.analysis.definitions import ExtractionSettings
from nucleation.figures import style
from nucleation.figures.checks import figure_crosscheck
from nucleation.pipeline.job import Job
from nucleation.verification.crosscheck import plan

with Job(snakemake, __file__) as job:
    own, freefem = job.input.own, job.input.freefem
    shown = [i for i, name in enumerate(job.params.ids) if name != plan.TIMING]
    drawn = figure_crosscheck.draw(
        [(job.read(own[i]), job.read(freefem[i])) for i in shown],
        job.read(job.input.table).isel(run=np.array(shown)),
        ExtractionSettings(**job.params.extraction),
    )
    style.save(drawn, Path(job.output[0]).with_suffix(""), job.key)
