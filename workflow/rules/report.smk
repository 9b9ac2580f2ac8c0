# The report: one HTML file with all figures whose studies are in the configuration, a calculator for
# any fault, tables and provenance.
OF_THE_PAPER = DEFAULT == "paper"
REPORTED = catalogue.drawable({study.role for study in settings.studies.values()}, OF_THE_PAPER)
OWN_STUDIES = {
    study: settings.studies[study].description for study in SHARED if study not in CLAIMED
}
"""Descriptions of the studies that share lengths.csv, except those that claims are about."""
ENTRIES = {name: FIGURES[name] for name in REPORTED} | catalogue.of_studies(OWN_STUDIES)
"""The shown figures. If the configuration is not the paper's, its own studies come first, and the
paper's figures and verdicts, which are about the paper's runs, are left out."""


def first_fault():
    """The first fault in the calculator: that of the paper, or of the first run."""
    own = [] if OF_THE_PAPER else runs_in(*OWN_STUDIES)
    own = [run for run in own if run.interface.zeta > 0.0]
    material, interface, height = settings.base.material, settings.main_text_interface, 0.1
    if own:
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


SHOWN_RUNS = {"figure_3": inset_run, "figure_s2": space_time_run}
"""Figures of a single simulation, and the functions that select it."""


def caption_values(wildcards):
    """Values for the captions, by figure: the shown run or study."""
    shown = {name: {"id": run().id} for name, run in SHOWN_RUNS.items() if name in REPORTED}
    return shown | {f"study_{study}": {"study": study} for study in OWN_STUDIES}


def pictures(wildcards):
    """The files of the shown figures."""
    return [f"{RESULTS}/figures/{name}.png" for name in ENTRIES]


def own_warnings(wildcards):
    """The warnings about each study of the user, without the name of the study."""
    if OF_THE_PAPER:
        return {}
    found = {}
    for study in OWN_STUDIES:
        found[study] = [warning.partition(": ")[2] for warning in advise(runs_of(study))]
    return found


# The calculator's lengths that take two minutes to tabulate. No configuration changes them, so that the
# report reads those of the reference set.
rule patch_tables:
    """Tables of L_run and W_c, between which the calculator interpolates"""
    input:
        recipe=recipe("patch_tables"),
    output:
        f"{RESULTS}/patch_tables.json",
    log:
        f"{RESULTS}/logs/patch_tables.log",
    params:
        call="replication.report.patch_tables:files",
    message:
        "Tables of L_run and W_c"
    shell:
        JOB


rule report:
    """Everything on one page"""
    input:
        figures=pictures,
        captions=[
            str(BASE / f"workflow/report/{name if name in FIGURES else 'figure_studies'}.rst")
            for name in ENTRIES
        ],
        datasets=[f"{RESULTS}/{name}.nc" for name in catalogue.datasets_of(ENTRIES.values())],
        patch_tables=str(Path(BASE, "results", "reference", "patch_tables.json")),
        claims=[f"{RESULTS}/tables/claims.json"] if OF_THE_PAPER else [],
        page_files=sorted(
            str(path)
            for kind in ("html", "css", "js")
            for path in Path(SOURCE, "replication", "report").glob(f"*.{kind}")
        ),
        recipe=recipe("report"),
    output:
        f"{RESULTS}/report.html",
    log:
        f"{RESULTS}/logs/report.log",
    localrule: True
    params:
        call="replication.report.page:write",
        loads=plugins(settings.base),
        names=list(ENTRIES),
        dataset_names=catalogue.datasets_of(ENTRIES.values()),
        studies=OWN_STUDIES,
        caption_values=caption_values,
        fault=lambda wildcards: first_fault(),
        friction=asdict(settings.base.friction),
        warnings=own_warnings,
        leads=not OF_THE_PAPER,
        config=lambda wildcards: completed(config),
    message:
        "Report"
    shell:
        JOB
