"""Write Table S1 as CSV and Markdown."""

import csv
import io

from nucleation.figures.paper import table_s1
from nucleation.model.friction.law import Friction
from nucleation.pipeline.job import Job

with Job(snakemake, __file__) as job:
    rows = table_s1.rows(Friction(**job.params.friction))
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([table_s1.Row._fields, *rows])
    job.write_text(text.getvalue(), job.output.csv)
    job.write_text(table_s1.to_markdown(rows), job.output.markdown)
