# The report: one HTML file with every figure that the configuration has the studies for, the theory
# for any fault, tables and provenance.
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
    """The fault that the calculator begins with: the paper's, or the first run's."""
    own = [run for run in runs_in(*OWN_STUDIES) if run.interface.zeta > 0.0]
    material, interface, height = settings.base.material, settings.main_text_interface, 0.1
    if own and not OF_THE_PAPER:
        material, interface = own[0].parameters.material, own[0].interface
        height = own[0].parameters.geometry.height
    return {
        "shear_modulus": material.shear_modulus,
        "poisson_ratio": material.poisson_ratio,
        "plane": material.plane,
        "height": height,
        "normal_stress": interface.normal_stress,
        "a": interface.a,
        "b": interface.a + interface.zeta,
        "slip_distance": interface.slip_length,
        "friction": interface.friction,
        "velocity": interface.velocity,
    }


def caption_values(wildcards):
    shown = {name: {"id": chosen(wildcards)} for name, chosen in SHOWN_RUNS.items()
             if name in REPORTED}  # fmt: skip
    return shown | {f"study_{study}": {"study": study} for study in OWN_STUDIES}


make_rule(
    "write_report",
    call="nucleation.report.page:write",
    shows="report",
    suffix="html",
    local=True,
    inputs={
        "figures": lambda wildcards: [
            *[steps(f"draw_{name}") for name in REPORTED],
            *steps.several("draw_study", OWN_STUDIES),
        ],
        "captions": [
            str(BASE / f"workflow/report/{name if name in FIGURES else 'figure_studies'}.rst")
            for name in ENTRIES
        ],
        "datasets": lambda wildcards: [
            steps("gather_patches", name) if name in PATCH_TABLES else steps(SHOWN_BY[name])
            for name in catalogue.datasets_of(ENTRIES.values())
        ],
        "claims": lambda wildcards: [steps("evaluate_claims")] if OF_THE_PAPER else [],
        "page_files": sorted(
            str(path)
            for kind in ("html", "css", "js")
            for path in Path(SOURCE, "nucleation", "report").glob(f"*.{kind}")
        ),
    },
    loads=plugins(settings.base),
    names=list(ENTRIES),
    dataset_names=catalogue.datasets_of(ENTRIES.values()),
    studies=OWN_STUDIES,
    caption_values=caption_values,
    fault=explored(),
    friction=asdict(settings.base.friction),
    warnings=(
        {}
        if OF_THE_PAPER
        else {
            study: [warning.partition(": ")[2] for warning in advise(settings.runs_of(study))]
            for study in OWN_STUDIES
        }
    ),
    leads=not OF_THE_PAPER,
    config=config,
    message="Report",
)
