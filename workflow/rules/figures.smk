# One rule draws each figure, and one target of the figure's name asks for it together with what it
# stands on (see the Snakefile). What is drawn comes from datasets alone: a rule's inputs bear the
# names of the parameters of the figure's `draw`.
def shown(height):
    """The simulation that a figure shows, by height (m)."""
    try:
        return settings.shown(height).id
    except ParameterError as error:
        raise WorkflowError(f"a figure can't be drawn: {error}") from None


def inset_id(wildcards):
    return shown(settings.figures.inset_height)


def space_time_id(wildcards):
    return shown(settings.figures.space_time_height)


def drawing(name):
    """The module that draws a figure."""
    (path,) = Path(SOURCE, "nucleation", "figures").rglob(f"{name}.py")
    return ".".join(path.relative_to(SOURCE).with_suffix("").parts)


DRAWN = {
    "figure_1": {},
    "figure_2": {"theory": THEORY},
    "figure_3": {
        "theory": THEORY,
        "lengths": LENGTHS,
        "inset_simulation": lambda wildcards: simulation(inset_id(wildcards)),
    },
    "figure_s1": {"theory": THEORY},
    "figure_s2": {
        "lengths": lengths_of("paper"),
        "simulation": lambda wildcards: simulation(space_time_id(wildcards)),
    },
    "figure_patch_stability": {
        "table": PATCHES,
        "patches": patches(*PATCH_TABLES["patch_stability"]),
        "twins": TWINS,
    },
    "figure_3_extended": {
        "theory": THEORY,
        "lengths": LENGTHS,
        "table": PATCHES,
        "noisy": lengths_of("noisy"),
    },
    "figure_drop": {"table": DROP},
    "figure_map": {"grid": MAP},
    "figure_dispersion": {"dispersion": DISPERSION},
    "figure_verification": {"convergence": VERIFICATION},
    "figure_convergence": {
        "table": CONVERGENCE,
        "hops": lambda wildcards: [hops(run.id) for run in hopping(wildcards)],
        "patch": lambda wildcards: patch(hopping(wildcards)[0].id),
    },
    "figure_sensitivity": {"table": SENSITIVITY},
    "figure_pairs": {"table": PAIRS},
    "figure_2_simulated": {"table": PAIRS},
}
"""The figures that are drawn from datasets alone, with these."""

SHOWN_RUNS = {"figure_3": inset_id, "figure_s2": space_time_id, "animation": inset_id}
"""The simulation of which a figure shows more than its lengths."""

for _name, _inputs in DRAWN.items():

    rule:
        name:
            f"draw_{_name}"
        input:
            **_inputs,
        output:
            figure(_name),
        log:
            f"{RESULTS}/logs/draw/{_name}.log",
        params:
            **made_by("draw.py", [drawing(_name)]),
            id=SHOWN_RUNS.get(_name, ""),
        message:
            FIGURES[_name].title
        script:
            "../scripts/draw.py"


rule write_table_s1:
    output:
        csv=f"{RESULTS}/tables/table_s1.csv",
        markdown=f"{RESULTS}/tables/table_s1.md",
    log:
        f"{RESULTS}/logs/table_s1.log",
    params:
        **made_by("table_s1.py", plugins(settings.base)),
        friction=asdict(settings.base.friction),
    message:
        "Table S1: parameters of the friction law"
    script:
        "../scripts/table_s1.py"


TARGETS = {
    "figure_1": [],
    "figure_2": [THEORY],
    "figure_3": [THEORY, rules.lengths.input],
    "figure_s1": [THEORY],
    "figure_s2": [measured(*settings.studies_for("paper"))],
    "figure_patch_stability": [
        frozen("patch_stability"),
        frozen("patch_convergence") if settings.runs_for("patch_convergence") else [],
        with_csv(TWINS),
        twins(),
    ],
    "figure_3_extended": [
        THEORY,
        rules.lengths.input,
        frozen("patch_stability"),
        measured(*settings.studies_for("noisy")),
    ],
    "figure_drop": [
        with_csv(DROP),
        modes,
        measured(*settings.studies_for("drop", "quiet"), *FLOORS),
    ],
    "figure_map": [with_csv(MAP), measured(*settings.studies_for("map"))],
    "figure_dispersion": [rules.dispersion.output],
    "figure_verification": [rules.verification.output],
    "figure_convergence": [rules.convergence.output, hops_shown, measured(*CONVERGENCE_STUDIES)],
    "figure_sensitivity": [rules.sensitivity.output, simulations(*settings.studies_for("sensitivity"))],
    "figure_pairs": [pairs()],
    "figure_2_simulated": [pairs()],
}
"""What stands behind each figure, all the way down."""

for _name, _behind in TARGETS.items():

    rule:
        name:
            _name
        input:
            figure(_name),
            *_behind,
        localrule: True
        message:
            f"{FIGURES[_name].title} is in {{input[0]}}"

    list(workflow.rules)[-1].docstring = f"{FIGURES[_name].title}."


rule table_s1:
    """Table S1: parameters of the friction law."""
    input:
        rules.write_table_s1.output,
    message:
        "Table S1 is in {input}"
