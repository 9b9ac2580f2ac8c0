# One job for each simulation. Its dataset bears the key of parameters and code in its name: whatever
# of them changes, it is another file, and one that exists is never made again.
from math import ceil


def memory(run, attempt):
    """Memory (MB) of a cluster job with one simulation: two Snakemakes in it need 150 MB each."""
    return attempt * ceil(300 + estimated_megabytes(run.parameters))


rule simulate:
    output:
        place_of("simulations"),
    log:
        f"{RESULTS}/logs/simulate/{{name}}.{{key}}.log",
    benchmark:
        f"{RESULTS}/logs/simulate/{{name}}.{{key}}.tsv"
    priority: 1  # with all that the verdicts wait for: what is only drawn fills the cores at the end
    threads: 1
    resources:
        mem_mb=lambda wildcards, attempt: memory(simulated(wildcards), attempt),
        runtime=ceil(settings.limits.runtime),
    params:
        **made_by("simulate.py", lambda wildcards: plugins(simulated(wildcards).parameters)),
        parameters=lambda wildcards: simulated(wildcards).parameters.to_dict(),
    message:
        "Simulation {wildcards.name}"
    script:
        "../scripts/simulate.py"
