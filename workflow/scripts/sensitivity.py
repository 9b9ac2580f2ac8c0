"""Compare the runs of the study sensitivity with the base run of their height."""

from nucleation.analysis import lengths, sensitivity
from nucleation.analysis.definitions import ExtractionSettings
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    runs, extraction = job.params.runs, job.params.extraction
    table = sensitivity.sensitivity_table(
        runs, job.read_all(job.input), ExtractionSettings(**extraction)
    )
    job.write(table, job.output.dataset, {"runs": runs, "extraction": extraction})
    job.write_text(lengths.to_csv(table), job.output.table)
