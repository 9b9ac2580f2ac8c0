# Where the theory is right, over the block's height and the weakening of friction: the study `map`,
# of a thousand runs that take seconds each, in batches.
MAP = f"{RESULTS}/map.nc"


def mapped(wildcards):
    """The table of the study's lengths, with the stability of each patch."""
    study = settings.studies.get("map")
    if study is not None and (study.measure != "stability" or study.runs_per_job == 1):
        raise WorkflowError(
            f"studies.map: measure = {study.measure} with runs_per_job = {study.runs_per_job} is "
            "not allowed: the map needs measure: stability, with more than one run per job"
        )
    return [study_lengths("map")] if study else []


rule gather_map:
    input:
        needed(mapped, "study map"),
    output:
        dataset=MAP,
        table=f"{RESULTS}/map.csv",
    log:
        f"{RESULTS}/logs/map.log",
    params:
        **made_by("gather_map.py"),
    message:
        "The map of lengths over height and weakening"
    script:
        "../scripts/gather_map.py"
