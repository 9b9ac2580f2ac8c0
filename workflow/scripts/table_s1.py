"""Write Table S1 as CSV and Markdown."""

import csv
import io

from nucleation import datasets
from nucleation.figures import table_s1
from nucleation.friction import Friction

rows = table_s1.rows(Friction(**snakemake.params.friction))
text = io.StringIO()
csv.writer(text, lineterminator="\n").writerows([table_s1.Row._fields, *rows])
datasets.write_text(text.getvalue(), snakemake.output.csv)
datasets.write_text(table_s1.to_markdown(rows), snakemake.output.markdown)
