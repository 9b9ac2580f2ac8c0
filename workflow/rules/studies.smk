# Beyond the paper: what mesh, steps, parameters and definitions do to the critical length.
#
# Every study whose name begins with `convergence` takes part in the table of refinement; the first
# of them refines along x, and its runs at the height of Figure S2 show the hops of the front.
CONVERGENCE = f"{RESULTS}/convergence.nc"
SENSITIVITY = f"{RESULTS}/sensitivity.nc"
CONVERGENCE_STUDIES = [study for study in settings.studies if study.startswith("convergence")]


localrules:
    figure_convergence, figure_sensitivity, figure_studies,


def hopping(wildcards):
    """The runs whose hops are shown, from coarse to fine."""
    height = settings.figures.space_time_height
    studies = CONVERGENCE_STUDIES[:1]
    runs = [run for study in studies for run in settings.runs_of(study)]
    runs = [run for run in runs if run.parameters.geometry.height == height]
    if not runs:
        raise WorkflowError(f"no study convergence... has a run with height {height:g}")
    return sorted(runs, key=lambda run: run.parameters.mesh.n_x)


# Any study against the theory, by what it varies: results/figures/study_NAME.pdf and .png.
rule draw_figure_study:
    input:
        table=study_lengths("{study}"),
    output:
        figure("study_{study}"),
    wildcard_constraints:
        study="|".join(settings.studies),
    params:
        varied=lambda wildcards: varied(settings.runs_of(wildcards.study)),
        digest=drawing_digest("figure_studies"),
    message:
        "Figure of the study {wildcards.study}: simulations and theory"
    script:
        "../scripts/figure_studies.py"


for _study in settings.studies:

    rule:
        name:
            f"figure_study_{_study}"
        input:
            figure(f"study_{_study}"),
            measured(_study),
        localrule: True
        message:
            "The study's figure is in {input[0]}"


rule figure_studies:
    input:
        needed([path for study in SHARED for path in figure(f"study_{study}")],
               "study with table: lengths"),
        measured(*SHARED),
    message:
        f"The studies' figures are in {RESULTS}/figures"


rule convergence:
    input:
        [study_lengths(study) for study in CONVERGENCE_STUDIES],
    output:
        dataset=CONVERGENCE,
        table=f"{RESULTS}/convergence.csv",
    params:
        digest=digest("nucleation.analysis.convergence"),
    message:
        "Critical lengths against mesh and steps"
    script:
        "../scripts/convergence.py"


rule hops:
    input:
        simulation("{id}"),
    output:
        f"{RESULTS}/hops/{{id}}.nc",
    params:
        extraction=asdict(settings.extraction),
        digest=digest("nucleation.patch.hops"),
    message:
        "Hops of the front of {wildcards.id}"
    script:
        "../scripts/hops.py"


rule draw_figure_convergence:
    input:
        table=CONVERGENCE,
        hops=lambda wildcards: [f"{RESULTS}/hops/{run.id}.nc" for run in hopping(wildcards)],
        patch=lambda wildcards: f"{RESULTS}/patches/{hopping(wildcards)[0].id}.nc",
    output:
        figure("figure_convergence"),
    params:
        digest=drawing_digest("figure_convergence"),
    message:
        "Convergence figure: critical length against mesh and steps"
    script:
        "../scripts/figure_convergence.py"


rule figure_convergence:
    input:
        rules.draw_figure_convergence.output,
        rules.draw_figure_convergence.input,
        rules.convergence.output,
        measured(*CONVERGENCE_STUDIES),
    message:
        "The convergence figure is in {input[0]}, its table in {CONVERGENCE}"


rule sensitivity:
    input:
        needed(simulations("sensitivity"), "study sensitivity"),
    output:
        dataset=SENSITIVITY,
        table=f"{RESULTS}/sensitivity.csv",
    params:
        runs=[run.to_dict() for run in settings.runs_of("sensitivity")],
        extraction=asdict(settings.extraction),
        digest=digest("nucleation.analysis.sensitivity"),
    message:
        "Sensitivity of critical lengths"
    script:
        "../scripts/sensitivity.py"


rule draw_figure_sensitivity:
    input:
        table=SENSITIVITY,
    output:
        figure("figure_sensitivity"),
    params:
        digest=drawing_digest("figure_sensitivity"),
    message:
        "Sensitivity figure: changes of the critical length"
    script:
        "../scripts/figure_sensitivity.py"


rule figure_sensitivity:
    input:
        rules.draw_figure_sensitivity.output,
        rules.sensitivity.output,
        simulations("sensitivity"),
    message:
        "The sensitivity figure is in {input[0]}, its table in {SENSITIVITY}"
