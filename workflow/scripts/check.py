"""List the results that are not what the present code and configuration would make."""

import sys

from nucleation.pipeline import check
from nucleation.pipeline.keys import Store

params = snakemake.params
findings = check.check_results(Store(params.results), params.expected, params.wanted)
print(check.report(findings))
if any(found.state != check.UNUSED for found in findings):
    sys.exit("check: there are findings")
