"""List the results that are not what the present code and configuration would make."""

from nucleation.check import check_results
from nucleation.configuration import configure

findings = check_results(configure(snakemake.config))
for finding in findings:
    print(finding)
print(f"{len(findings)} findings: these results are not current" if findings else "All is current")
