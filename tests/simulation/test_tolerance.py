"""How accurately Newton's method solves for the interface."""

import pytest

from nucleation.run.run import PAPER_RUN
from nucleation.simulation.start import grid_of, interface_of


def tolerance(**values):
    parameters = PAPER_RUN.replaced(tolerance=1e-2, **values)
    return interface_of(parameters, grid_of(parameters.upper)).tolerance


def test_under_a_perturbation_it_is_a_thousandth_of_the_step_s():
    assert tolerance(perturbation="normal_load", strength=1e-2) == pytest.approx(1e-5)


def test_it_is_no_coarser_than_the_perturbation_and_no_finer_than_of_an_unperturbed_run():
    assert tolerance(perturbation="normal_load", strength=1e-7) == pytest.approx(1e-7)
    assert tolerance(perturbation="normal_load", strength=1e-12) == tolerance() == 1e-8
