"""The independent solver in the workflow: what it plans, and that it is optional."""

import shutil

import pytest

from nucleation.verification.crosscheck import freefem


def test_plan(workflow, freefem_program):
    """Five runs by both solvers, two of them of two blocks."""
    once = ("compare_crosscheck", "draw_figure_crosscheck")
    expected = {"crosscheck_own": 5, "crosscheck_freefem": 5, **dict.fromkeys(once, 1)}
    assert workflow.planned("crosscheck") == expected


@pytest.mark.parametrize("target", ["crosscheck", "figure_crosscheck"])
def test_without_the_program_one_sentence_says_how_to_get_it(
    workflow, monkeypatch, tmp_path_factory, target
):
    programs = tmp_path_factory.mktemp("programs")
    for name in ("bash", "sh", "which"):  # what Snakemake itself wants to find
        (programs / name).symlink_to(shutil.which(name))
    monkeypatch.setenv("PATH", str(programs))
    assert shutil.which(freefem.PROGRAM) is None
    done = workflow(target)
    assert done.returncode != 0
    assert freefem.MISSING in done.stdout
    assert "workflow/install-debian.sh crosscheck" in freefem.MISSING
    assert not (workflow.directory / "results").exists()
