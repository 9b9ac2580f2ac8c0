# One job for each simulation. Its parameters and the digest of the code it runs are in `params`:
# Snakemake sees neither imported modules nor what a wildcard stands for, and a change of either
# has to run the simulation again (and nothing else has to).
from math import ceil


def run_of(wildcards):
    return RUNS[wildcards.id]


def memory(wildcards, attempt):
    """Memory (MB) of a cluster job with one simulation: two Snakemakes in it need 150 MB each."""
    return attempt * ceil(300 + estimated_megabytes(run_of(wildcards).parameters.mesh))


rule simulate:
    output:
        simulation("{id}"),
    params:
        parameters=lambda wildcards: run_of(wildcards).parameters.to_dict(),
        digest=digest("nucleation.simulation.run"),
    wildcard_constraints:
        id="|".join(RUNS).replace(".", r"\."),
    log:
        f"{RESULTS}/logs/simulate/{{id}}.log",
    threads: 1
    priority: 1  # before the short jobs, which then fill all cores at the end
    resources:
        mem_mb=memory,
        runtime=ceil(settings.limits.runtime),
    message:
        "Simulation {wildcards.id}"
    script:
        "../scripts/simulate.py"


rule simulations:
    input:
        needed(simulations(*SHARED), "study with table: lengths"),
    message:
        f"All simulations are in {RESULTS}/simulations"
