"""The expected drop of a run, with its block."""

from ..model.linearised import interface_state
from ..model.parameters import Parameters
from ..theory.creep.patches import Patches
from ..theory.critical import run_length
from .expected_drop import Block, ExpectedDrop, expected_drop


def drop_of_run(parameters: Parameters) -> ExpectedDrop:
    """The expected drop of a uniform run that is pushed at its edge; raises NoLength."""
    parameters.require_edge("the law of the drop")
    loading, geometry = parameters.loading, parameters.geometry
    return expected_drop(
        Patches.of(parameters),
        parameters.perturbation,
        run_length(parameters, interface_state(parameters)),
        loading.initial_state,
        loading.initial_shear_stress / loading.normal_stress,
        Block(geometry.length, geometry.height),
    )
