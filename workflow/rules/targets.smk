# Targets with names. Every file is a target as well: results/figures/figure_3.pdf.
def shared(files):
    """An input function for files of the studies that share lengths.csv."""
    return needed(lambda: files([*filter(is_usable, SHARED)]), "study with table: lengths")


def of_studies(names):
    """The tables and figures of some studies."""
    names = list(names)
    figures = [
        f"{RESULTS}/figures/study_{name}.{kind}" for name in names for kind in ("png", "pdf")
    ]
    tables = [path.replace(".nc", ".csv") for path in lengths_of(*names)]
    return figures + tables


rule simulations:
    """The simulations of all studies that share lengths.csv"""
    input:
        shared(lambda names: batches(runs_in(*names))),


rule lengths:
    """Onset and critical length of each of them"""
    input:
        rules.gather_lengths.output,


rule claims:
    """A verdict on every statement of the paper"""
    input:
        rules.evaluate_claims.output,


rule article:
    """The replication as a short article, with the paper's figures"""
    input:
        rules.write_article.output,
        rules.evaluate_claims.output,
        [f"{RESULTS}/figures/{name}.png" for name in PAPERS_FIGURES],


rule replication:
    """The article with figures of L_s, drop and map: PDF, LaTeX and Markdown"""
    input:
        rules.article.input,
        rules.print_article.output,


rule figure_1:
    """Figure 1: the two set-ups"""
    input:
        rules.draw_figure_1.output,


rule figure_2:
    """Figure 2: bimaterial interfaces"""
    input:
        rules.draw_figure_2.output,


rule figure_3:
    """Figure 3: critical length against height"""
    input:
        rules.draw_figure_3.output,


rule figure_s1:
    """Figure S1: steady-state friction"""
    input:
        rules.draw_figure_s1.output,


rule figure_s2:
    """Figure S2: stress in space and time"""
    input:
        rules.draw_figure_s2.output,


rule figure_patch_stability:
    """Stability of the creeping patch"""
    input:
        rules.draw_figure_patch_stability.output,
        [f"{RESULTS}/patch_convergence.csv"] if in_role("patch_convergence") else [],


rule figure_3_extended:
    """Lengths of the drop and of the patch's stability"""
    input:
        rules.draw_figure_3_extended.output,


rule figure_drop:
    """Where the force drops under a declared perturbation"""
    input:
        rules.draw_figure_drop.output,


rule figure_weakening:
    """Where slow slip ends: lengths over the weakening"""
    input:
        rules.draw_figure_weakening.output,


rule other_faults:
    """Drops of faults that the expected drop was not fitted to"""
    input:
        rules.gather_other_faults.output,


rule figure_weakening_patches:
    """Weakening patches among strengthening surroundings"""
    input:
        rules.draw_figure_weakening_patches.output,


rule figure_map:
    """Lengths over height and weakening: a map"""
    input:
        rules.draw_figure_map.output,


rule figure_patch_theory:
    """Stability of the creeping patch by theory"""
    input:
        rules.draw_figure_patch_theory.output,


rule figure_dispersion:
    """Growth of single modes: simulation and theory"""
    input:
        rules.draw_figure_dispersion.output,


rule figure_verification:
    """Orders of convergence on manufactured solutions"""
    input:
        rules.draw_figure_verification.output,


rule figure_convergence:
    """Length at the drop against mesh and steps"""
    input:
        rules.draw_figure_convergence.output,


rule figure_sensitivity:
    """Sensitivity to parameters and definitions"""
    input:
        rules.draw_figure_sensitivity.output,


rule figure_pairs:
    """Two deformable bodies"""
    input:
        rules.draw_figure_pairs.output,


rule figure_2_simulated:
    """Figure 2 with simulations, in both senses of the contrast"""
    input:
        rules.draw_figure_2_simulated.output,


rule figure_literature:
    """Lengths of the literature, simulated in their own settings"""
    input:
        rules.draw_figure_literature.output,


rule animation:
    """Creep, nucleation and rupture"""
    input:
        rules.draw_animation.output,


rule figure_studies:
    """A figure of each study that shares lengths.csv"""
    input:
        shared(of_studies),


rule pairs:
    """Two deformable bodies: lengths over the theory of the same pair, and verdicts"""
    input:
        rules.gather_pairs.output,
        rules.evaluate_pairs.output,
        rules.pair_modes.output,


rule patch_convergence:
    """Lengths at which patches become unstable on refined meshes"""
    input:
        f"{RESULTS}/patch_convergence.csv",


rule figure_crosscheck:
    """Patch length and driving force by both solvers"""
    input:
        rules.draw_figure_crosscheck.output,


rule crosscheck:
    """The same runs by an independent solver, and the figure of both"""
    input:
        rules.draw_figure_crosscheck.output,
        rules.compare_crosscheck.output,


rule report:
    """Everything on one page, results/report.html"""
    input:
        rules.write_report.output,


# Checks of the results; they make no result.
rule check:
    """List results that are stale, incomplete, damaged or foreign"""
    log:
        f"{RESULTS}/logs/check.log",
    localrule: True
    params:
        results=lambda wildcards: recipe.results,
        expected=lambda wildcards: recipe.write_expected(of_studies(settings.studies)),
    message:
        "Check of the results"
    shell:
        f"{PYTHON} -m nucleation.pipeline.check check {{params.results:q}} {{params.expected:q}}"
        " | tee {log:q}"


rule prune:
    """List results that are not in use; PRUNE=yes in the environment removes them"""
    log:
        f"{RESULTS}/logs/prune.log",
    localrule: True
    params:
        results=lambda wildcards: recipe.results,
        expected=lambda wildcards: recipe.write_expected(of_studies(settings.studies)),
    message:
        "Results that are not in use"
    shell:
        f"{PYTHON} -m nucleation.pipeline.check prune {{params.results:q}} {{params.expected:q}}"
        " | tee {log:q}"
