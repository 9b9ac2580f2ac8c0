"""Draw a figure from datasets: the rule's inputs bear the names of the parameters of its `draw`."""

import importlib
import inspect
from pathlib import Path

from nucleation.analysis.lengths import row
from nucleation.figures import style
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    draw = importlib.import_module(job.params.modules[0]).draw
    given = {
        name: job.read(files) if isinstance(files, str) else list(job.read_all(files))
        for name, files in job.input.items()
    }
    names = inspect.signature(draw).parameters
    for name in {"row", "inset_row"} & names.keys():
        given[name] = row(given["lengths"], job.params.id)
    drawn = draw(**{name: value for name, value in given.items() if name in names})
    style.save(drawn, Path(job.output[0]).with_suffix(""), job.key)
