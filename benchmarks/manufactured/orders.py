"""Orders of convergence in h and in dt, measured on manufactured solutions.

``python -m benchmarks.manufactured.orders`` writes ``results/verification.csv``, of which
``results/reference/verification.csv`` is a copy.

The errors in space and in time are separate. For the order in h the fields are smooth in space and
quadratic in time, for which BDF2 is exact; for the order in dt they oscillate in time and are
bilinear in space, for which the elements are exact. There are three problems: elastodynamics with a
prescribed displacement of the interface, and the block on its frictional interface with the aging
and with the slip law. The latter two are also solved with fields so slow that waves cross the block
many times within a step: there the solver steps slip and state by BDF3, and the order in dt is
three.
"""

import itertools
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from nucleation.run.run import PAPER_RUN, Run
from nucleation.simulation.stepping import BDF
from nucleation.types import Array

from .dynamics import Manufactured
from .fields import Displacement, Factor, Term, power, sine

PROBLEMS = ("elastodynamics", "aging", "slip")
REFINEMENTS = ("mesh", "step", "quasi_static_step")
ERRORS = ("displacement_error", "slip_rate_error", "log_state_error")
"""Of the displacement over its scale, of the slip rate over V, of the log of the state."""

MATERIAL = PAPER_RUN.upper.material
HEIGHT, LENGTH = 0.3, 1.0  # m
SCALE = 1e-6  # m, of displacements; inertia and elasticity are comparable for times of 1e-3 s
DISTANCE = 2e-6  # m, D: D/V is about the duration, and slip rates vary between V/2 and 2 V
GRADING = 3.0  # of the meshes

ROWS = (4, 8, 16, 32)  # elements along y, and half of those along x
MESH_RUNG, MESH_STEPS = -56, 12  # 12 steps of 9.2e-5 s
STEP_ROWS = 4
STEP_RUNGS = {
    "step": (-72, -76, -80, -84),  # steps of 5.7e-6 s, each next one half as long
    "quasi_static_step": (-24, -28, -32, -36),  # of 2.3e-2 s; waves cross the block in 1.9e-4 s
}
MOST_STEPS = 48  # of the longest steps

COMPRESSION = Term(-1e-4, power(1.0), power(0.0, 1.0), power(1.0))  # sigma_yy = -1.2 MPa


class _Fields(NamedTuple):
    """A displacement and its interface: V (m/s) is of the order of the displacement's velocity.

    The state is psi = log(D/V), that of steady sliding, and a term with the factor `state` in time.
    """

    displacement: Displacement
    velocity: float
    state: Factor
    lumped: bool = True  # see Manufactured


def _displacement(w_x: Sequence[Factor], u_y: Sequence[Factor]) -> Displacement:
    """The displacement with these factors in x, y and t."""
    along_x = Term(SCALE, *w_x)
    along_y = Term(2 * SCALE, *u_y)
    return Displacement(((along_x,), (along_y, COMPRESSION)), MATERIAL)


def _bilinear(along: Factor, across: Factor) -> Displacement:
    """A field bilinear in space, with these factors in time of w_x and u_y."""
    w_x = (power(0.0, 1.0), power(1.0, 0.7), along)
    u_y = (power(1.0, 0.6), power(0.0, 1.0), across)
    return _displacement(w_x, u_y)


QUADRATIC = power(1.0, -6e2, 4e5)  # of the state
FIELDS = {
    "mesh": _Fields(
        _displacement(
            (sine(2.1), sine(1.7, 1.9), power(1.0, 1e3, 5e5)),
            (sine(1.9, 2.0), sine(2.3), power(1.0, -7e2, 6e5)),
        ),
        2e-3,
        QUADRATIC,
        lumped=False,
    ),
    "step": _Fields(_bilinear(sine(1e4, 0.3), sine(1.5e4, 1.1)), 2e-2, sine(1.2e4, 0.5)),
    "quasi_static_step": _Fields(_bilinear(sine(4.0, 0.3), sine(6.0, 1.1)), 8e-6, sine(5.0, 0.5)),
    # bilinear and quadratic at once: solved exactly
    "exact": _Fields(_bilinear(power(1.0, 8e2, 7e5), power(1.0, -5e2, 7e5)), 2e-3, QUADRATIC),
}


def log_state(fields: _Fields, run: Run) -> tuple[Term, Term]:
    """The terms of psi = log(phi): steady sliding, and what varies."""
    constant = power(1.0)
    steady = Term(np.log(run.memory_time), constant, constant, constant)
    varying = Term(0.5, sine(3.0, 1.0), constant, fields.state)
    return steady, varying


def manufactured(problem: str, name: str, rows: int, grading: float = GRADING) -> Manufactured:
    """The solver with the loads of a problem and of named fields, on 2 rows x rows elements."""
    fields = FIELDS[name]
    alone = problem == "elastodynamics"
    evolution = "aging" if alone else problem
    run = PAPER_RUN.replaced(
        slip_distance=DISTANCE,
        evolution=evolution,
        velocity=fields.velocity,
        height=HEIGHT,
        block_length=LENGTH,
        n_x=2 * rows,
        n_y=rows,
        grading=grading,
    )
    terms = () if alone else log_state(fields, run)
    return Manufactured(run, fields.displacement, terms, fields.lumped)


def _errors(problem: Manufactured, rungs: Iterable[int]) -> tuple[float, float, float]:
    """Dimensionless errors after steps of the given rungs, in the order of :data:`ERRORS`.

    Root mean squares of the nodal values' errors: of the displacement over :data:`SCALE`, of the
    slip rate over V, of log(phi). Without friction only the first has a meaning.
    """
    state, _ = problem.run(*rungs)
    return (
        problem.displacement_error(state) / SCALE,
        problem.slip_rate_error(state) / problem.velocity,
        problem.log_state_error(state),
    )


def _mesh_errors(problem: str) -> Array:
    """Errors of a problem on the meshes of :data:`ROWS`, (level, 3)."""
    rungs = [MESH_RUNG] * MESH_STEPS
    found = []
    for rows in ROWS:
        solved = manufactured(problem, "mesh", rows)
        found.append(_errors(solved, rungs))
    return np.array(found)


def step_errors(problem: str, name: str = "step", pattern: ArrayLike = (0,)) -> Array:
    """Errors of a problem with the steps of :data:`STEP_RUNGS`, (level, 3).

    The numbers of `pattern` are added to the rungs of successive steps, repeated.
    """
    solved = manufactured(problem, name, STEP_ROWS)
    found = []
    for level, rung in enumerate(STEP_RUNGS[name]):
        steps = MOST_STEPS * 2**level
        rungs = rung + np.resize(pattern, steps)
        found.append(_errors(solved, rungs))
    return np.array(found)


def orders(errors: ArrayLike) -> Array:
    """The orders between successive errors (first axis), each of half the spacing."""
    values = np.asarray(errors, dtype=float)
    return np.log2(values[:-1] / values[1:])


def convergence() -> pd.DataFrame:
    """Errors of all problems on all meshes and with all steps, with their orders.

    Elastodynamics has only the error of the displacement, and none in the quasi-static limit.
    """
    tables = []
    for problem, refinement in itertools.product(PROBLEMS, REFINEMENTS):
        alone = problem == "elastodynamics"
        if refinement == "mesh":
            errors, spacing = _mesh_errors(problem), LENGTH / (2.0 * np.array(ROWS))
        elif alone and refinement == "quasi_static_step":
            continue
        else:
            errors = step_errors(problem, refinement)
            spacing = np.array([BDF().steady_step(rung) for rung in STEP_RUNGS[refinement]])
        columns = {"problem": problem, "refinement": refinement, "spacing": spacing}
        for i, name in enumerate(ERRORS):
            own = np.full_like(spacing, np.nan) if alone and i else errors[:, i]
            columns[name] = own
            columns[f"{name}_order"] = np.append(np.nan, orders(own))
        tables.append(pd.DataFrame(columns))
    return pd.concat(tables, ignore_index=True)


if __name__ == "__main__":
    path = Path("results", "verification.csv")
    path.parent.mkdir(exist_ok=True)
    convergence().to_csv(path, index=False, float_format="%.6g")
