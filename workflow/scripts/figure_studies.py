"""Draw one study's lengths, simulations and theory, over what the study varies."""

from pathlib import Path

from nucleation.configuration.study_names import study_parameters
from nucleation.figures import style
from nucleation.figures.beyond import figure_studies
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    varied = job.params.varied
    entries = {name: study_parameters()[name] for name in varied}
    drawn = figure_studies.draw(job.read(job.input.table), varied, entries, job.params.theory)
    style.save(drawn, Path(job.output[0]).with_suffix(""), job.key)
