# The report: one HTML file with every figure that the configuration has the studies for, the
# theory with sliders, a player of the run of Figure S2, tables and provenance; and the animation,
# of the run in the inset of Figure 3.
from nucleation.figures import catalogue

FILM = f"{RESULTS}/film.nc"
ANIMATION = f"{RESULTS}/figures/animation.gif"
REPORT_FILES = [
    str(Path(SOURCE, "nucleation", "report", name))
    for name in ("template.html", "page.css", "page.js", "theory.js", "drop.js", "map.js")
]
OF_THE_PAPER = DEFAULT == "paper"
REPORTED = catalogue.drawable({study.role for study in settings.studies.values()}, OF_THE_PAPER)
OWN_STUDIES = {
    study: settings.studies[study].description for study in SHARED if study not in CLAIMED
}
"""What the studies are for on which no verdict stands and that share lengths.csv."""
ENTRIES = {name: FIGURES[name] for name in REPORTED} | catalogue.of_studies(OWN_STUDIES)
"""What is shown. A configuration that isn't the paper's leads with its own studies, and has neither
the paper's figures nor the verdicts, which are about the paper's runs."""


def explored():
    """Material and interface that the page's controls begin with: the paper's, or the first run's."""
    own = [run for run in runs_in(*OWN_STUDIES) if run.interface.zeta > 0.0]
    if OF_THE_PAPER or not own:
        return settings.base.material, settings.main_text_interface
    return own[0].parameters.material, own[0].interface


localrules:
    animation,
    report,


def shown_files(name):
    """The files of a figure or of the animation, the one that is looked at last."""
    return [ANIMATION] if name == "animation" else figure(name)


def caption_params(wildcards):
    shown = {name: {"id": chosen(wildcards)} for name, chosen in SHOWN_RUNS.items()
             if name in REPORTED}  # fmt: skip
    return shown | {f"study_{study}": {"study": study} for study in OWN_STUDIES}


def player_input(wildcards):
    """The run in the player; without the paper's study there is none."""
    if "figure_s2" not in REPORTED:
        return []
    return simulation(space_time_id(wildcards))


def quiet_modes(wildcards):
    """The modes from which the page has the law of the drop."""
    return modes(wildcards)


rule film:
    input:
        lengths=LENGTHS,
        simulation=lambda wildcards: simulation(inset_id(wildcards)),
    output:
        FILM,
    log:
        f"{RESULTS}/logs/film.log",
    threads: 1
    params:
        **made_by("film.py"),
        id=inset_id,
    message:
        "Film: a run once more, for the stress in its block"
    script:
        "../scripts/film.py"


rule draw_animation:
    input:
        film=FILM,
        lengths=LENGTHS,
    output:
        captioned(ANIMATION, "animation"),
    log:
        f"{RESULTS}/logs/draw/animation.log",
    params:
        **made_by("animation.py"),
        id=inset_id,
    message:
        "Animation of creep, nucleation and rupture"
    script:
        "../scripts/animation.py"


rule animation:
    """Creep, nucleation and rupture as an animation."""
    input:
        rules.draw_animation.output,
        FILM,
        rules.lengths.input,
    message:
        "The animation is in {input[0]}"


rule write_report:
    input:
        figures=[path for name in ENTRIES for path in shown_files(name)],
        captions=[caption_file(name if name in FIGURES else "figure_studies") for name in ENTRIES],
        datasets=[f"{RESULTS}/{name}.nc" for name in catalogue.datasets_of(ENTRIES.values())],
        player=player_input,
        modes=quiet_modes,
        claims=CLAIMS if OF_THE_PAPER else [],
        page=REPORT_FILES,
    output:
        f"{RESULTS}/report.html",
    log:
        f"{RESULTS}/logs/report.log",
    params:
        **made_by("report.py", [*plugins(settings.base), *laws_of(settings.runs_for("quiet"))]),
        figures=list(ENTRIES),
        studies=OWN_STUDIES,
        captions=caption_params,
        material=asdict(explored()[0]),
        friction=asdict(settings.base.friction),
        main_text_interface=asdict(explored()[1]),
        warnings=(
            {}
            if OF_THE_PAPER
            else {
                study: [warning.partition(": ")[2] for warning in advise(settings.runs_of(study))]
                for study in OWN_STUDIES
            }
        ),
        leads=not OF_THE_PAPER,
        extraction=asdict(settings.extraction),
        config=config,
        player=lambda wildcards: space_time_id(wildcards) if "figure_s2" in REPORTED else "",
    message:
        "Report"
    script:
        "../scripts/report.py"


rule report:
    """Everything on one page, results/report.html."""
    input:
        rules.write_report.output,
        rules.claims.input if OF_THE_PAPER else [],
        [getattr(rules, name).input for name in REPORTED],
        [getattr(rules, f"figure_study_{study}").input for study in OWN_STUDIES],
        rules.lengths.input if OWN_STUDIES else [],
    message:
        "The report is in {input[0]}"
