"""Compare the runs of the two solvers."""

from nucleation.analysis import lengths
from nucleation.analysis.definitions import ExtractionSettings
from nucleation.pipeline.job import Job
from nucleation.verification.crosscheck import compare

with Job(snakemake, __file__) as job:
    settings = ExtractionSettings(**job.params.extraction)
    pairs = zip(job.params.ids, job.input.own, job.input.freefem, strict=True)
    rows = {
        name: compare.compare(job.read(first), job.read(second), settings)
        for name, first, second in pairs
    }
    table = compare.gather(rows)
    job.write(table, job.output.dataset, job.params.extraction)
    job.write_text(lengths.to_csv(table), job.output.table)
