# Beyond the paper: what mesh, steps, parameters and definitions do to the critical length.
#
# The runs with the role HOPPING at the height of Figure S2, quiet ones, show the hops of the front.
CONVERGENCE = f"{RESULTS}/convergence.nc"
SENSITIVITY = f"{RESULTS}/sensitivity.nc"
HOPPING = "convergence_quiet"
CONVERGENCE_STUDIES = settings.studies_for(*REFINEMENTS)


localrules:
    figure_studies,


def hopping(wildcards):
    """The runs whose hops are shown, from coarse to fine."""
    height = settings.figures.space_time_height
    runs = [run for run in settings.runs_for(HOPPING) if run.parameters.geometry.height == height]
    if not runs:
        raise WorkflowError(f"there is no study with role: {HOPPING} and a run of height {height:g}")
    return sorted(runs, key=lambda run: run.parameters.mesh.n_x)


# Any study against the theory, by what it varies: results/figures/study_NAME.pdf and .png.
rule draw_figure_study:
    input:
        table=study_lengths("{study}"),
    output:
        figure("study_{study}"),
    log:
        f"{RESULTS}/logs/draw/study_{{study}}.log",
    wildcard_constraints:
        study="|".join(settings.studies),
    params:
        **made_by("figure_studies.py"),
        varied=lambda wildcards: varied(settings.runs_of(wildcards.study)),
        theory=lambda wildcards: theory_curves(
            settings.runs_of(wildcards.study),
            settings.studies[wildcards.study],
            settings.base,
            settings.main_text_interface,
        ),
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

    list(workflow.rules)[-1].docstring = f"Figure of the study {_study}."


rule figure_studies:
    """A figure of each study, simulations and theory."""
    input:
        needed(
            [path for study in SHARED for path in figure(f"study_{study}")],
            "study with table: lengths",
        ),
        measured(*SHARED),
    message:
        f"The studies' figures are in {RESULTS}/figures"


rule convergence:
    input:
        [study_lengths(study) for study in CONVERGENCE_STUDIES],
    output:
        dataset=CONVERGENCE,
        table=f"{RESULTS}/convergence.csv",
    log:
        f"{RESULTS}/logs/convergence.log",
    params:
        **made_by("convergence.py"),
    message:
        "Critical lengths against mesh and steps"
    script:
        "../scripts/convergence.py"


@functools.cache
def hops(id):
    """The hops of one simulation's front."""
    return of_simulation("hops", id, "hops.py")


hopped = run_of_key(hops, "hops of")


rule hops:
    input:
        lambda wildcards: simulation(hopped(wildcards).id),
    output:
        place_of("hops"),
    log:
        f"{RESULTS}/logs/hops/{{name}}.{{key}}.log",
    params:
        **made_by("hops.py", lambda wildcards: plugins(hopped(wildcards).parameters)),
        extraction=asdict(settings.extraction),
    message:
        "Hops of the front of {wildcards.name}"
    script:
        "../scripts/hops.py"


def hops_shown(wildcards):
    """The hops in the figure of convergence, and the patch of the coarsest run."""
    runs = hopping(wildcards)
    return [*(hops(run.id) for run in runs), patch(runs[0].id)]


rule sensitivity:
    input:
        needed(simulations(*settings.studies_for("sensitivity")), "study with role: sensitivity"),
    output:
        dataset=SENSITIVITY,
        table=f"{RESULTS}/sensitivity.csv",
    log:
        f"{RESULTS}/logs/sensitivity.log",
    params:
        **made_by("sensitivity.py"),
        runs=[run.to_dict() for run in settings.runs_for("sensitivity")],
        extraction=asdict(settings.extraction),
    message:
        "Sensitivity of critical lengths"
    script:
        "../scripts/sensitivity.py"
