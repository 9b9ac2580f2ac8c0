"""Compare the runs of the study sensitivity with the base run of their height."""

from nucleation.analysis import lengths, sensitivity
from nucleation.analysis.definitions import ExtractionSettings
from nucleation.datasets import netcdf, provenance

params = snakemake.params
table = sensitivity.sensitivity_table(
    params.runs, map(netcdf.read, snakemake.input), ExtractionSettings(**params.extraction)
)
settings = {"runs": params.runs, "extraction": params.extraction}
attributes = provenance.attributes(
    settings, params.digest, "snakemake figure_sensitivity", snakemake.input
)
netcdf.write(table, snakemake.output.dataset, **attributes)
netcdf.write_text(lengths.to_csv(table, sensitivity.COLUMNS), snakemake.output.table)
