# Simulations, and the tables of their lengths.
#
# One job makes a batch: several simulations of a study with `runs_per_job`, or a single one. It makes
# them in parallel on its cores, and shows each one, results/simulations/ID.nc, when it is finished.
# If no other rule reads the simulations one by one, the job also extracts their lengths.
@asked_often
def memory(wildcards, threads, attempt):
    """Memory (MB) of a cluster job that makes a batch; Snakemake itself needs 300 MB."""
    runs = runs_of_batch(wildcards.batch)
    largest = max(estimated_megabytes(run.run) for run in runs)
    return attempt * ceil(300 + min(threads, len(runs)) * (largest + 150))


def before_others(runs):
    """What a batch adds to its priority: the longest begin first. A step takes as long as 50 000 elements
    without any."""
    blocks = [run.run.block for run in runs]
    elements = sum(50_000 + block.n_x * block.n_y for block in blocks)
    return elements / (elements + 1e6)


@asked_often
def cores_of(wildcards):
    return min(2, len(runs_of_batch(wildcards.batch)))


@asked_often
def simulations_of(wildcards):
    return simulations(runs_of_batch(wildcards.batch))


rule simulate:
    """The simulations of a batch, in parallel on its cores"""
    input:
        recipe=recipe("simulate"),
    output:
        f"{RESULTS}/batches/{{batch}}.json",
    log:
        f"{RESULTS}/logs/batches/{{batch}}.log",
    priority: asked_often(lambda wildcards: 2 + before_others(runs_of_batch(wildcards.batch)))
    threads: cores_of
    resources:
        mem_mb=memory,
        runtime=ceil(settings.limits.runtime),
    params:
        makes=simulations_of,
    shell:
        JOB


rule simulate_and_measure:
    """The simulations of a batch, and the table of their lengths"""
    input:
        recipe=recipe("simulate_and_measure"),
    output:
        multiext(f"{RESULTS}/batches/{{batch}}", ".nc", ".csv"),
    log:
        f"{RESULTS}/logs/batches/{{batch}}.log",
    priority: asked_often(lambda wildcards: 1 + before_others(runs_of_batch(wildcards.batch)))
    threads: cores_of
    resources:
        mem_mb=memory,
        runtime=ceil(settings.limits.runtime),
    params:
        call="replication.tables.measured:measured_runs",
        loads=lambda wildcards: [SIMULATION.module, *laws_of(runs_of_batch(wildcards.batch))],
        makes=simulations_of,
        runs=lambda wildcards: as_dicts(runs_of_batch(wildcards.batch)),
        settings=asdict(settings.extraction),
        measure=lambda wildcards: settings.studies[study_of(wildcards.batch)].measure,
    shell:
        JOB


rule simulation:
    """One simulation under its name; the job of its batch makes it"""
    input:
        after=lambda wildcards: ancient(batches([run_of(wildcards.name)])),
        recipe=recipe("simulation"),
    output:
        f"{RESULTS}/simulations/{{name}}.nc",
    log:
        f"{RESULTS}/logs/simulations/{{name}}.log",
    localrule: True
    params:
        call=f"{SIMULATION.module}:simulate",
        loads=lambda wildcards: plugins(run_of(wildcards.name).run.law),
        parameters=lambda wildcards: run_of(wildcards.name).parameters,
    shell:
        JOB


# A table with onset time and length at the drop for each study, and one for all studies that share it.
rule extract:
    """Lengths at the drop of a study"""
    input:
        after=lambda wildcards: batches(runs_of(wildcards.study)),
        recipe=recipe("extract"),
    output:
        multiext(f"{RESULTS}/lengths/{{study,{one_of(EXTRACTED)}}}", ".csv", ".nc"),
    log:
        f"{RESULTS}/logs/lengths/{{study}}.log",
    priority: 1
    params:
        call="replication.tables.lengths:of_study",
        reads=lambda wildcards: {"simulations": simulations(runs_of(wildcards.study))},
        runs=lambda wildcards: as_dicts(runs_of(wildcards.study)),
        settings=asdict(settings.extraction),
    shell:
        JOB


rule join_batches:
    """Lengths at the drop of a study, joined from the tables of its batches"""
    input:
        tables=lambda wildcards: batches(runs_of(wildcards.study)),
        recipe=recipe("join_batches"),
    output:
        multiext(f"{RESULTS}/lengths/{{study,{one_of(TABLED)}}}", ".csv", ".nc"),
    log:
        f"{RESULTS}/logs/lengths/{{study}}.log",
    localrule: True
    params:
        call="replication.tables.lengths:of_batches",
        ids=lambda wildcards: [run.id for run in runs_of(wildcards.study)],
    shell:
        JOB


rule lengths:
    """Onset and length at the drop of every run of the studies that share the table"""
    input:
        tables=needed(lambda: lengths_of(*filter(is_usable, SHARED)), "study with table: lengths"),
        recipe=recipe("lengths"),
    output:
        multiext(f"{RESULTS}/lengths", ".csv", ".nc", ".columns.csv"),
    log:
        f"{RESULTS}/logs/lengths.log",
    localrule: True
    params:
        call="replication.tables.lengths:of_studies",
    shell:
        JOB
