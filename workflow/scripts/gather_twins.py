"""Gather the growth of kicks in all twin runs."""

from nucleation import datasets, lengths, provenance, twin_runs

params = snakemake.params
table = twin_runs.gather(params.runs, map(datasets.read, snakemake.input))
attributes = provenance.attributes(
    params.runs, params.digest, "snakemake figure_patch_stability", snakemake.input
)
datasets.write(table, snakemake.output.dataset, **attributes)
datasets.write_text(lengths.to_csv(table, twin_runs.COLUMNS), snakemake.output.table)
