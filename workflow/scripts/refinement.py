"""Compare each run of the convergence studies with the next coarser one."""

from nucleation import datasets, lengths, provenance, refinement

table = refinement.refinement_table(lengths.join(map(datasets.read, snakemake.input)))
settings = {"tables": list(snakemake.input)}
attributes = provenance.attributes(
    settings, snakemake.params.digest, "snakemake figure_convergence"
)
datasets.write(table, snakemake.output.dataset, **attributes)
datasets.write_text(lengths.to_csv(table, refinement.COLUMNS), snakemake.output.table)
