"""Draw one study's lengths, simulations and theory, over what the study varies."""

from pathlib import Path

from nucleation import datasets
from nucleation.figures import figure_studies, style
from nucleation.studies import STUDY_PARAMETERS

varied = snakemake.params.varied
entries = {name: STUDY_PARAMETERS[name][1] for name in varied}
drawn = figure_studies.draw(datasets.read(snakemake.input.table), varied, entries)
style.save(drawn, Path(snakemake.output[0]).with_suffix(""))
