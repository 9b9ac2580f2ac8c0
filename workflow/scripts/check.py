"""List the results that are not what the present code and configuration would make."""

from nucleation.configuration.load import configure
from nucleation.pipeline.check import check_results, unverified

settings = configure(snakemake.config)
findings = check_results(settings)
for finding in findings:
    print(finding)
print(f"{len(findings)} findings: these results are not current" if findings else "All is current")
if names := [path.name for path in unverified(settings)]:
    print("Not checked, they do not say where they are from:", *names)
