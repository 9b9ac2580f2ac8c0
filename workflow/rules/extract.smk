# A table with onset time and critical length for each study, and one of the studies that share it.
def study_lengths(study):
    """The table of one study's lengths."""
    return f"{RESULTS}/lengths/{study}.nc"


def lengths_of(role):
    """The table of the one study that has a role; nothing without it."""
    return next(map(study_lengths, settings.studies_for(role)), [])


def with_csv(dataset):
    """A dataset that is a table, and its CSV."""
    return [dataset, str(Path(dataset).with_suffix(".csv"))]


def measured(*studies):
    """Simulations and lengths of those of some studies that the configuration has."""
    present = [study for study in studies if study in settings.studies]
    return [*made(*present), *(with_csv(study_lengths(study)) for study in present)]


rule extract:
    input:
        lambda wildcards: simulations(wildcards.study),
    output:
        dataset=study_lengths("{study}"),
        table=f"{RESULTS}/lengths/{{study}}.csv",
    log:
        f"{RESULTS}/logs/extract/{{study}}.log",
    wildcard_constraints:
        study=one_of(study for study in settings.studies if study not in TABLED),
    priority: 1
    params:
        **made_by("extract.py"),
        parameters=lambda wildcards: settings.lengths_parameters(wildcards.study),
    message:
        "Critical lengths of the study {wildcards.study}"
    script:
        "../scripts/extract.py"


rule join_batches:
    input:
        lambda wildcards: made(wildcards.study),
    output:
        dataset=study_lengths("{study}"),
        table=f"{RESULTS}/lengths/{{study}}.csv",
    log:
        f"{RESULTS}/logs/extract/{{study}}.log",
    wildcard_constraints:
        study=one_of(TABLED),
    params:
        **made_by("join_batches.py"),
        ids=lambda wildcards: [run.id for run in settings.runs_of(wildcards.study)],
    message:
        "Critical lengths of the study {wildcards.study}"
    script:
        "../scripts/join_batches.py"


rule gather_lengths:
    input:
        needed([study_lengths(study) for study in SHARED], "study with table: lengths"),
    output:
        dataset=LENGTHS,
        table=f"{RESULTS}/lengths.csv",
        columns=f"{RESULTS}/lengths.columns.csv",
    log:
        f"{RESULTS}/logs/gather_lengths.log",
    params:
        **made_by("gather_lengths.py"),
    message:
        "Critical lengths of the studies " + ", ".join(SHARED)
    script:
        "../scripts/gather_lengths.py"


rule lengths:
    """Onset and critical length of each of their runs."""
    input:
        rules.gather_lengths.output,
        measured(*SHARED),
    message:
        "Critical lengths are in {input[0]} and {input[1]}"
