"""Gather the lengths at which the patches of simulations turn unstable."""

from nucleation import datasets, lengths, provenance, stability_length

params = snakemake.params
table = stability_length.gather(params.runs, map(datasets.read, snakemake.input))
attributes = provenance.attributes(
    params.runs, params.digest, "snakemake figure_patch_stability", snakemake.input
)
datasets.write(table, snakemake.output.dataset, **attributes)
datasets.write_text(lengths.to_csv(table, stability_length.COLUMNS), snakemake.output.table)
