# One rule draws each figure. What is drawn comes from datasets alone: a rule's inputs bear the names
# of the parameters of the function that draws.
def drawing(name):
    """The module that draws a figure."""
    (path,) = Path(SOURCE, "nucleation", "figures").rglob(f"{name}.py")
    return ".".join(path.relative_to(SOURCE).with_suffix("").parts)


DRAWN = {
    "figure_1": {},
    "figure_2": {"theory": only("theory")},
    "figure_3": {
        "theory": only("theory"),
        "lengths": only("gather_lengths"),
        "simulation": lambda wildcards: steps("simulate", inset_id(wildcards)),
    },
    "figure_s1": {"theory": only("theory")},
    "figure_s2": {
        "lengths": lambda wildcards: table_of("paper"),
        "simulation": lambda wildcards: steps("simulate", space_time_id(wildcards)),
    },
    "figure_patch_stability": {
        "table": only("gather_patches", "patch_stability"),
        "patches": lambda wildcards: patches(*PATCH_TABLES["patch_stability"]),
    },
    "figure_3_extended": {
        "theory": only("theory"),
        "lengths": only("gather_lengths"),
        "table": only("gather_patches", "patch_stability"),
        "noisy": lambda wildcards: table_of("noisy"),
    },
    "figure_drop": {"table": only("gather_drop")},
    "figure_map": {"grid": only("gather_map")},
    "figure_patch_theory": {"table": only("gather_patch_theory")},
    "figure_dispersion": {"dispersion": only("dispersion")},
    "figure_verification": {"convergence": only("verification")},
    "figure_convergence": {"table": only("convergence")},
    "figure_sensitivity": {"table": only("sensitivity")},
    "figure_pairs": {"table": only("gather_pairs")},
    "figure_2_simulated": {"table": only("gather_pairs")},
    "figure_literature": {"table": only("gather_literature")},
}
"""The figures that are drawn from datasets alone, with these."""

SHOWN_RUNS = {"figure_3": inset_id, "figure_s2": space_time_id, "animation": inset_id}
"""The simulation of which a figure shows more than its lengths."""

for _name, _inputs in DRAWN.items():
    make_rule(
        f"draw_{_name}",
        call=f"{drawing(_name)}:{'draw_run' if _name in SHOWN_RUNS else 'draw'}",
        shows=f"figures/{_name}",
        suffix="png",
        local=True,
        inputs=_inputs,
        message=FIGURES[_name].title,
        **({"id": SHOWN_RUNS[_name]} if _name in SHOWN_RUNS else {}),
    )


def declarations(names):
    """What parameters are, for the axes of a figure."""
    found = {name: asdict(study_parameters()[name]) for name in names}
    return {name: entry | {"choices": list(entry["choices"])} for name, entry in found.items()}


# Any study against the theory, by what it varies.
make_rule(
    "draw_study",
    call="nucleation.figures.beyond.figure_studies:draw_study",
    shows="figures/study_{name}",
    suffix="png",
    local=True,
    inputs={"table": lambda wildcards: lengths_of(wildcards.name)[0]},
    varied=lambda wildcards: varied(settings.runs_of(wildcards.name)),
    entries=lambda wildcards: declarations(varied(settings.runs_of(wildcards.name))),
    theory=lambda wildcards: theory_curves(
        settings.runs_of(wildcards.name),
        settings.studies[wildcards.name],
        settings.base,
        settings.main_text_interface,
    ),
    message="Figure of the study {wildcards.name}: simulations and theory",
)

make_rule(
    "film",
    call="nucleation.analysis.film:of_run",
    shows="film",
    inputs={
        "lengths": only("gather_lengths"),
        "simulation": lambda wildcards: steps("simulate", inset_id(wildcards)),
    },
    id=inset_id,
    message="Film: a run once more, for the stress in its block",
)

make_rule(
    "draw_animation",
    call="nucleation.figures.beyond.animation:of_run",
    shows="figures/animation",
    suffix="gif",
    local=True,
    inputs={"film": only("film"), "lengths": only("gather_lengths")},
    id=inset_id,
    message="Animation of creep, nucleation and rupture",
)
