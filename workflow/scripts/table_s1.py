"""Write Table S1 as CSV and Markdown."""

import csv
import io

from nucleation.datasets import netcdf
from nucleation.figures.paper import table_s1
from nucleation.model.friction.law import Friction

rows = table_s1.rows(Friction(**snakemake.params.friction))
text = io.StringIO()
csv.writer(text, lineterminator="\n").writerows([table_s1.Row._fields, *rows])
netcdf.write_text(text.getvalue(), snakemake.output.csv)
netcdf.write_text(table_s1.to_markdown(rows), snakemake.output.markdown)
