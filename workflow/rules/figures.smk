# One rule draws each figure, from datasets alone. The names of a rule's inputs are the arguments of
# the function that draws.
OF_PAPER = "The paper's figures"


def drawn(name, category="Beyond the paper", caption=""):
    """The files of a figure; Snakemake's report shows the PNG with its caption."""
    place = f"{RESULTS}/figures/{name}"
    caption = f"../report/{caption or name}.rst"
    return [report(f"{place}.png", caption=caption, category=category), f"{place}.pdf"]


rule figure_1:
    """Figure 1: the two set-ups"""
    input:
        recipe=recipe("figure_1"),
    output:
        drawn("figure_1", OF_PAPER),
    log:
        f"{RESULTS}/logs/figures/figure_1.log",
    priority: EARLY
    localrule: True
    params:
        call="replication.figures.figure_1:draw",
    shell:
        JOB


rule figure_2:
    """Figure 2: bimaterial interfaces"""
    input:
        theory=f"{RESULTS}/theory.nc",
        recipe=recipe("figure_2"),
    output:
        drawn("figure_2", OF_PAPER),
    log:
        f"{RESULTS}/logs/figures/figure_2.log",
    priority: EARLY
    localrule: True
    params:
        call="replication.figures.theory:figure_2",
    shell:
        JOB


rule figure_3:
    """Figure 3: critical length against height"""
    input:
        theory=f"{RESULTS}/theory.nc",
        lengths=f"{RESULTS}/lengths.nc",
        after=lambda wildcards: batches([inset_run()]),
        recipe=recipe("figure_3"),
    output:
        drawn("figure_3", OF_PAPER),
    log:
        f"{RESULTS}/logs/figures/figure_3.log",
    localrule: True
    params:
        call="replication.figures.figure_3:draw",
        reads=lambda wildcards: {"simulation": simulations([inset_run()])[0]},
        id=lambda wildcards: inset_run().id,
    shell:
        JOB


rule figure_s1:
    """Figure S1: steady-state friction"""
    input:
        theory=f"{RESULTS}/theory.nc",
        recipe=recipe("figure_s1"),
    output:
        drawn("figure_s1", OF_PAPER),
    log:
        f"{RESULTS}/logs/figures/figure_s1.log",
    priority: EARLY
    localrule: True
    params:
        call="replication.figures.theory:figure_s1",
    shell:
        JOB


rule figure_s2:
    """Figure S2: stress in space and time"""
    input:
        lengths=lambda wildcards: table_of("paper"),
        after=lambda wildcards: batches([space_time_run()]),
        recipe=recipe("figure_s2"),
    output:
        drawn("figure_s2", OF_PAPER),
    log:
        f"{RESULTS}/logs/figures/figure_s2.log",
    localrule: True
    params:
        call="replication.figures.figure_3:figure_s2",
        reads=lambda wildcards: {"simulation": simulations([space_time_run()])[0]},
        id=lambda wildcards: space_time_run().id,
    shell:
        JOB


rule figure_patch_stability:
    """Stability of the creeping patch"""
    input:
        table=f"{RESULTS}/patch_stability.nc",
        after=lambda wildcards: patch_batches(*PATCH_TABLES["patch_stability"]),
        recipe=recipe("figure_patch_stability"),
    output:
        drawn("figure_patch_stability"),
    log:
        f"{RESULTS}/logs/figures/figure_patch_stability.log",
    localrule: True
    params:
        call="replication.figures.figure_patch:draw_stability",
        reads=lambda wildcards: {"patches": patches(*PATCH_TABLES["patch_stability"])},
    shell:
        JOB


rule figure_3_extended:
    """Lengths of the drop and of the patch's stability"""
    input:
        theory=f"{RESULTS}/theory.nc",
        lengths=f"{RESULTS}/lengths.nc",
        table=f"{RESULTS}/patch_stability.nc",
        recipe=recipe("figure_3_extended"),
    output:
        drawn("figure_3_extended"),
    log:
        f"{RESULTS}/logs/figures/figure_3_extended.log",
    localrule: True
    params:
        call="replication.figures.figure_3:draw_extended",
    shell:
        JOB


rule figure_drop:
    """Where the force drops under a declared perturbation"""
    input:
        table=f"{RESULTS}/drop.nc",
        recipe=recipe("figure_drop"),
    output:
        drawn("figure_drop"),
    log:
        f"{RESULTS}/logs/figures/figure_drop.log",
    localrule: True
    params:
        call="replication.figures.figure_drop:draw",
    shell:
        JOB


rule figure_weakening:
    """Where slow slip ends: lengths over the weakening"""
    input:
        table=f"{RESULTS}/weakening.nc",
        recipe=recipe("figure_weakening"),
    output:
        drawn("figure_weakening"),
    log:
        f"{RESULTS}/logs/figures/figure_weakening.log",
    localrule: True
    params:
        call="replication.figures.figure_weakening:draw",
    shell:
        JOB


rule figure_map:
    """Lengths over height and weakening: a map"""
    input:
        grid=f"{RESULTS}/map.nc",
        recipe=recipe("figure_map"),
    output:
        drawn("figure_map"),
    log:
        f"{RESULTS}/logs/figures/figure_map.log",
    localrule: True
    params:
        call="replication.figures.figure_weakening:draw_map",
    shell:
        JOB


def declarations(names):
    """Declarations of parameters, for the axes of a figure."""
    found = {}
    for name in names:
        entry = parameters()[name]
        found[name] = {field.name: getattr(entry, field.name) for field in fields(Quantity)}
        found[name]["choices"] = list(entry.choices)
    return found


rule draw_study:
    """A study: simulations and theory over the varied parameters"""
    input:
        table=f"{RESULTS}/lengths/{{study}}.nc",
        recipe=recipe("draw_study"),
    output:
        drawn("study_{study}", "Studies of your own", caption="figure_studies"),
    log:
        f"{RESULTS}/logs/figures/study_{{study}}.log",
    params:
        call="replication.figures.figure_studies:draw",
        loads=lambda wildcards: laws_of(runs_of(wildcards.study)),
        varied=lambda wildcards: varied(runs_of(wildcards.study)),
        entries=lambda wildcards: declarations(varied(runs_of(wildcards.study))),
        theory=lambda wildcards: theory_curves(runs_of(wildcards.study), settings),
    shell:
        JOB


rule figure_blind:
    """Blind faults: simulated against predicted lengths"""
    input:
        blind=f"{RESULTS}/blind.nc",
        recipe=recipe("figure_blind"),
    output:
        drawn("figure_blind"),
    log:
        f"{RESULTS}/logs/figures/figure_blind.log",
    localrule: True
    params:
        call="replication.figures.figure_blind:draw",
    shell:
        JOB
