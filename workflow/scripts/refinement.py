"""Compare each run of the convergence studies with the next coarser one."""

from nucleation import datasets, lengths, provenance, refinement

table = refinement.refinement_table(lengths.join(map(datasets.read, snakemake.input)))
attributes = provenance.attributes(
    {}, snakemake.params.digest, "snakemake figure_convergence", snakemake.input
)
datasets.write(table, snakemake.output.dataset, **attributes)
datasets.write_text(lengths.to_csv(table, refinement.COLUMNS), snakemake.output.table)
