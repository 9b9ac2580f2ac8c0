"""What a user may ask for."""

import re


def test_configuration_of_ones_own_needs_no_target(workflow):
    """By default it makes its lengths and figures; the paper's are not among them."""
    defaults = {"n_x": 20, "n_y": 4, "end_time": 0.2}
    studies = {
        "mine": {"defaults": defaults, "runs": [{"height": [0.01, 0.02]}]},
        "alone": {"defaults": defaults, "table": "own", "runs": [{"height": 0.01}]},
    }
    planned = workflow.configured({"studies": studies}).planned()
    assert planned["simulate"] == 2, "a run that two studies have in common is made once"
    assert planned["draw_study"] == 2
    assert planned["gather_lengths"] == 1
    assert not {"paper", "draw_figure_3", "evaluate_claims"} & planned.keys()


def test_every_target_has_a_text(workflow):
    listed = re.findall(r"^(\w+)  +\S", workflow("targets", "--quiet", "all").stdout, re.M)
    assert {"paper", "lengths", "figure_3", "report"} <= set(listed)
    assert not {"simulate", "extract", "draw_figure_3"} & set(listed)


def test_article_on_paper_has_the_figures_beyond(workflow):
    planned = workflow.planned("replication")
    made = {"write_article", "draw_figure_3", "draw_figure_drop", "draw_figure_map"}
    assert planned["print_article"] == 1 and made <= planned.keys()
