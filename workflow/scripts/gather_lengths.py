"""Join the tables of lengths of several studies."""

from nucleation import datasets, lengths, provenance

params = snakemake.params
table = lengths.join(map(datasets.read, snakemake.input))
attributes = provenance.attributes({}, params.digest, "snakemake lengths", snakemake.input)
datasets.write(table, snakemake.output.dataset, **attributes)
datasets.write_text(lengths.to_csv(table), snakemake.output.table)
