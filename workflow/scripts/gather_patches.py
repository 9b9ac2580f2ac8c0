"""Gather the lengths at which the patches of all simulations turn unstable."""

from nucleation import datasets, lengths, patch_stability, provenance

params = snakemake.params
table = patch_stability.gather(params.runs, map(datasets.read, snakemake.input))
attributes = provenance.attributes(params.runs, params.digest, "snakemake figure_patch_stability")
datasets.write(table, snakemake.output.dataset, **attributes)
datasets.write_text(lengths.to_csv(table, patch_stability.COLUMNS), snakemake.output.table)
