"""Join the tables of lengths of several studies."""

from nucleation import datasets, lengths, provenance

params = snakemake.params
table = lengths.join(map(datasets.read, snakemake.input))
settings = {"tables": list(snakemake.input)}
attributes = provenance.attributes(settings, params.digest, "snakemake lengths")
datasets.write(table, snakemake.output.dataset, **attributes)
datasets.write_text(lengths.to_csv(table), snakemake.output.table)
