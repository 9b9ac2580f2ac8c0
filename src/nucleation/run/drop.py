"""The expected drop of a run, in its block."""

from ..drop.expected_drop import Block, ExpectedDrop, expected_drop
from ..theory.critical import critical_length_of
from ..theory.evaluation import single_system
from .checks import require_uniform_edge
from .run import Run


def drop_of_run(run: Run) -> ExpectedDrop:
    """The expected drop of a uniform run that is pushed at its edge; raises NoLength."""
    require_uniform_edge(run, "the law of the drop")
    fault = run.fault
    return expected_drop(
        run.patches,
        run.perturbation,
        critical_length_of(single_system(fault)),
        fault.initial_state,
        run.start.initial_shear_stress / fault.normal_stress,
        Block(run.block.length, fault.height),
    )
