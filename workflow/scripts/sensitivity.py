"""Compare the runs of the study sensitivity with the base run of their height."""

from nucleation import datasets, lengths, provenance, sensitivity
from nucleation.settings import ExtractionSettings

params = snakemake.params
table = sensitivity.sensitivity_table(
    params.runs, map(datasets.read, snakemake.input), ExtractionSettings(**params.extraction)
)
settings = {"runs": params.runs, "extraction": params.extraction}
attributes = provenance.attributes(
    settings, params.digest, "snakemake figure_sensitivity", snakemake.input
)
datasets.write(table, snakemake.output.dataset, **attributes)
datasets.write_text(lengths.to_csv(table, sensitivity.COLUMNS), snakemake.output.table)
