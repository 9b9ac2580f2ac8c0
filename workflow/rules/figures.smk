# One rule draws each figure, and one target of the figure's name asks for it together with the
# simulations it stands on (see the Snakefile). What is drawn comes from datasets alone.
DRAWING = ("matplotlib", "numpy")


def drawing_digest(name):
    (path,) = Path(SOURCE, "nucleation", "figures").rglob(f"{name}.py")
    name = ".".join(path.relative_to(SOURCE).with_suffix("").parts)
    return digest(name, libraries=DRAWING)


def shown(height):
    """The simulation of the paper's study that a figure shows, by height (m)."""
    try:
        return settings.find(
            study="paper", law="aging", height=height, phi0=settings.base.loading.initial_state
        ).id
    except ParameterError as error:
        raise WorkflowError(f"a figure can't be drawn: {error}") from None


def inset_id(wildcards):
    return shown(settings.figures.inset_height)


def space_time_id(wildcards):
    return shown(settings.figures.space_time_height)


rule draw_figure_1:
    output:
        figure("figure_1"),
    params:
        digest=drawing_digest("figure_1"),
    message:
        "Figure 1: the two set-ups"
    script:
        "../scripts/figure_1.py"


rule draw_figure_2:
    input:
        theory=THEORY,
    output:
        figure("figure_2"),
    params:
        digest=drawing_digest("figure_2"),
    message:
        "Figure 2: critical length of bimaterial interfaces"
    script:
        "../scripts/figure_2.py"


rule draw_figure_3:
    input:
        theory=THEORY,
        lengths=LENGTHS,
        simulation=lambda wildcards: simulation(inset_id(wildcards)),
    output:
        figure("figure_3"),
    params:
        id=inset_id,
        digest=drawing_digest("figure_3"),
    message:
        "Figure 3: critical length against height, theory and simulations"
    script:
        "../scripts/figure_3.py"


rule draw_figure_s1:
    input:
        theory=THEORY,
    output:
        figure("figure_s1"),
    params:
        digest=drawing_digest("figure_s1"),
    message:
        "Figure S1: steady-state friction"
    script:
        "../scripts/figure_s1.py"


rule draw_figure_s2:
    input:
        lengths=study_lengths("paper"),
        simulation=lambda wildcards: simulation(space_time_id(wildcards)),
    output:
        figure("figure_s2"),
    params:
        id=space_time_id,
        digest=drawing_digest("figure_s2"),
    message:
        "Figure S2: shear stress in space and time, and the driving force"
    script:
        "../scripts/figure_s2.py"


rule write_table_s1:
    output:
        csv=f"{RESULTS}/tables/table_s1.csv",
        markdown=f"{RESULTS}/tables/table_s1.md",
    params:
        friction=asdict(settings.base.friction),
        digest=drawing_digest("table_s1"),
    message:
        "Table S1: parameters of the friction law"
    script:
        "../scripts/table_s1.py"


rule figure_1:
    input:
        figure("figure_1"),
    message:
        "Figure 1 is in {input[0]}"


rule figure_2:
    input:
        figure("figure_2"),
        THEORY,
    message:
        "Figure 2 is in {input[0]}"


rule figure_3:
    input:
        figure("figure_3"),
        THEORY,
        rules.lengths.input,
    message:
        "Figure 3 is in {input[0]}"


rule figure_s1:
    input:
        figure("figure_s1"),
        THEORY,
    message:
        "Figure S1 is in {input[0]}"


rule figure_s2:
    input:
        figure("figure_s2"),
        measured("paper"),
    message:
        "Figure S2 is in {input[0]}"


rule table_s1:
    input:
        rules.write_table_s1.output,
    message:
        "Table S1 is in {input}"
