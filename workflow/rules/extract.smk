# One table of all simulations with onset time and critical length.
rule extract:
    input:
        simulations(),
    output:
        dataset=LENGTHS,
        table=f"{RESULTS}/lengths.csv",
    params:
        runs=[run.to_dict() for run in RUNS.values()],
        extraction=asdict(settings.extraction),
        digest=digest("nucleation.lengths"),
    message:
        "Critical lengths of all simulations"
    script:
        "../scripts/extract.py"


rule lengths:
    input:
        rules.extract.output,
        simulations(),
    message:
        "Critical lengths are in {input[0]} and {input[1]}"
