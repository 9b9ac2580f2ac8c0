"""Draw one study's lengths, simulations and theory, over what the study varies."""

from pathlib import Path

from nucleation.configuration.study_names import study_parameters
from nucleation.datasets import netcdf
from nucleation.figures import style
from nucleation.figures.beyond import figure_studies

varied = snakemake.params.varied
entries = {name: study_parameters()[name] for name in varied}
drawn = figure_studies.draw(netcdf.read(snakemake.input.table), varied, entries)
style.save(drawn, Path(snakemake.output[0]).with_suffix(""))
