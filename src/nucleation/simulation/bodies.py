"""The elastic body of a run: one block on a rigid base, or two; finite, or periodic."""

from ..fem.body import Body
from ..fem.grid import Grid
from ..run import run as runs
from ..run.checks import require_consistent
from ..run.run import Run


def grid_of(body: runs.Body, periodic: bool = False) -> Grid:
    """The mesh of a block."""
    return Grid(
        body.length,
        body.height,
        body.n_x,
        body.n_y,
        body.grading,
        periodic,
    )


def body_of(run: Run) -> Body:
    """The body of a run: pushed at its left edge, or periodic under a remote load.

    A ParameterError names contradictions.
    """
    require_consistent(run)
    return _of(run, periodic=run.fault.loading == "remote")


def period_of(run: Run) -> Body:
    """One period, as long as the block, of a run's body or bodies; ``n_x`` is odd."""
    return _of(run, periodic=True)


def _of(run: Run, periodic: bool) -> Body:
    upper, below = run.upper, run.below
    first = grid_of(upper, periodic), upper.material
    if below is None:
        return Body(first)
    return Body(
        first,
        (grid_of(below, periodic), below.material),
        below.far_side,
    )
