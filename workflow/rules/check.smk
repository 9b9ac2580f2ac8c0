# What of the results is stale, incomplete, damaged or foreign, without running anything else; and
# which datasets are of earlier parameters or code, which a return to these would use again.
from nucleation.pipeline.check import files as result_files


localrules:
    check,
    prune,
    targets,


def wanted_keys(wildcards):
    """Keys of all datasets that the configuration can ask for."""
    paths = [kind(id) for kind in (simulation, patch, twin, hops) for id in RUNS]
    paths += [mode(run.id) for run in settings.runs_for("quiet")] + [*map(batch, MEASURED)]
    paths += [*crosscheck_records("own"), *crosscheck_records("freefem")]
    return [keys.key_in(path) for path in paths]


def expected_parts(wildcards):
    """What makes each file with a plain name that is there, None where no rule does."""
    return {
        path: None if keys.key_in(path) else PLANNER.parts_or_none(path)
        for path in result_files(Path(RESULTS))
    }


rule check:
    """List what is stale, incomplete, damaged or foreign."""
    params:
        results=RESULTS,
        expected=expected_parts,
        wanted=wanted_keys,
    message:
        f"Check of {RESULTS}"
    script:
        "../scripts/check.py"


rule prune:
    """Remove datasets of earlier parameters or code."""
    params:
        results=RESULTS,
        wanted=wanted_keys,
    message:
        f"Datasets in {RESULTS} that the configuration does not ask for are removed"
    script:
        "../scripts/prune.py"


# What there is to ask for: rules with a text of their own. The others are steps on the way.
rule targets:
    params:
        listing=lambda wildcards: {r.name: r.docstring for r in workflow.rules if r.docstring},
    script:
        "../scripts/targets.py"
