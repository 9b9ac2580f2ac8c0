"""Orders of convergence in h and in dt, measured on manufactured solutions.

Neither order is polluted by the other. In space the fields are smooth, and quadratic in time, for
which BDF2 is exact; in time they oscillate, and are bilinear in space, for which the elements are
exact. Three problems: elastodynamics with the interface's displacement prescribed, and the block
on its frictional interface with the aging and with the slip law. The latter two are also solved
with fields so slow that waves cross the block many times within a step: there the solver steps
slip and state by BDF3, and the order in dt is three.
"""

import itertools
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import ArrayLike

from ..datasets.variables import Variable, annotate
from ..model.friction.law import Friction
from ..model.material import Material
from ..model.parameters import Geometry, Loading, Mesh, Parameters
from ..simulation.recorded import RECORDED
from ..simulation.stepping import BDF
from ..types import Array
from .manufactured.dynamics import Manufactured
from .manufactured.fields import Displacement, Factor, Power, Sine, Term

PROBLEMS = ("elastodynamics", "aging", "slip")
REFINEMENTS = ("mesh", "step", "quasi_static_step")
SPACINGS = {
    "element_size": Variable("m", "length of the elements along x", "h"),
    "step_size": RECORDED["step_size"],
    "quasi_static_step_size": Variable("s", "time step of quasi-static fields", "dt"),
}
ERRORS = {
    "displacement_error": Variable("1", "error of the displacement over its scale"),
    "slip_rate_error": Variable("1", "error of the slip rate over V"),
    "log_state_error": Variable("1", "error of the log of the state variable"),
}
COORDINATES = {
    "problem": Variable("", "elastodynamics alone, or with friction by an evolution law"),
    "refinement": Variable("", "what is refined from level to level"),
}

MATERIAL = Material()
GEOMETRY = Geometry(height=0.3, length=1.0)
SCALE = 1e-6  # m, of the displacements; inertia and elasticity are alike for times of 1e-3 s
DISTANCE = 2e-6  # m: D; D/V is about the duration, and slip rates vary between V/2 and 2 V
GRADING = 3.0  # of the meshes

ROWS = (4, 8, 16, 32)  # elements along y, and half of those along x
MESH_RUNG, MESH_STEPS = -56, 12  # 12 steps of 9.2e-5 s
STEP_ROWS = 4
STEP_RUNGS = {
    "step": (-72, -76, -80, -84),  # steps of 5.7e-6 s, each next one half as long
    "quasi_static_step": (-24, -28, -32, -36),  # of 2.3e-2 s; waves cross the block in 1.9e-4 s
}
MOST_STEPS = 48  # of the longest steps

COMPRESSION = Term(-1e-4, Power(1.0), Power(0.0, 1.0), Power(1.0))  # sigma_yy = -1.2 MPa


class Fields(NamedTuple):
    """A displacement, and what the interface is given to go with it."""

    displacement: Displacement
    velocity: float  # m/s, V: of the order of the displacement's own velocity
    state: Factor  # in time, of what is added to the psi = log(D/V) of steady sliding
    lumped: bool = True  # of Manufactured


def _displacement(w_x: Sequence[Factor], u_y: Sequence[Factor]) -> Displacement:
    """The displacement with these factors in x, y and t."""
    return Displacement(((Term(SCALE, *w_x),), (Term(2 * SCALE, *u_y), COMPRESSION)), MATERIAL)


def _bilinear(along: Factor, across: Factor) -> Displacement:
    """The same field bilinear in space with these factors in time, of w_x and u_y."""
    return _displacement(
        (Power(0.0, 1.0), Power(1.0, 0.7), along), (Power(1.0, 0.6), Power(0.0, 1.0), across)
    )


QUADRATIC = Power(1.0, -6e2, 4e5)  # of the state
FIELDS = {
    "mesh": Fields(
        _displacement(
            (Sine(2.1), Sine(1.7, 1.9), Power(1.0, 1e3, 5e5)),
            (Sine(1.9, 2.0), Sine(2.3), Power(1.0, -7e2, 6e5)),
        ),
        2e-3,
        QUADRATIC,
        lumped=False,
    ),
    "step": Fields(_bilinear(Sine(1e4, 0.3), Sine(1.5e4, 1.1)), 2e-2, Sine(1.2e4, 0.5)),
    "quasi_static_step": Fields(_bilinear(Sine(4.0, 0.3), Sine(6.0, 1.1)), 8e-6, Sine(5.0, 0.5)),
    # bilinear and quadratic at once: solved exactly
    "exact": Fields(_bilinear(Power(1.0, 8e2, 7e5), Power(1.0, -5e2, 7e5)), 2e-3, QUADRATIC),
}


def log_state(fields: Fields, parameters: Parameters) -> tuple[Term, Term]:
    """Terms of psi = log(phi)."""
    steady = Term(np.log(parameters.memory_time), Power(1.0), Power(1.0), Power(1.0))
    return steady, Term(0.5, Sine(3.0, 1.0), Power(1.0), fields.state)


def manufactured(problem: str, name: str, rows: int, grading: float = GRADING) -> Manufactured:
    """The solver under the loads of a problem of :data:`PROBLEMS`.

    Parameters
    ----------
    problem, name : what is solved, and the name of the :data:`FIELDS`.
    rows : elements along y, half of those along x.
    grading : height of the top row of elements over that of the bottom row.
    """
    fields = FIELDS[name]
    alone = problem == "elastodynamics"
    friction = Friction(
        characteristic_slip_distance=DISTANCE, evolution="aging" if alone else problem
    )
    loading, mesh = Loading(velocity=fields.velocity), Mesh(2 * rows, rows, grading)
    parameters = Parameters(MATERIAL, friction, loading, GEOMETRY, mesh)
    terms = () if alone else log_state(fields, parameters)
    return Manufactured(parameters, fields.displacement, terms, fields.lumped)


def errors(problem: Manufactured, rungs: ArrayLike) -> tuple[float, float, float]:
    """Dimensionless errors after steps of the given rungs, in the order of :data:`ERRORS`.

    Root mean squares of the nodal values' errors: of the displacement over :data:`SCALE`, of the
    slip rate over V, of log(phi). Without friction only the first has a meaning.
    """
    state, _ = problem.run(*rungs)  # type: ignore[misc]
    return (
        problem.displacement_error(state) / SCALE,
        problem.slip_rate_error(state) / problem.velocity,
        problem.log_state_error(state),
    )


def mesh_errors(problem: str, grading: float = GRADING) -> Array:
    """:func:`errors` on the meshes of :data:`ROWS`, (level, 3)."""
    rungs = [MESH_RUNG] * MESH_STEPS
    return np.array([errors(manufactured(problem, "mesh", n, grading), rungs) for n in ROWS])


def step_errors(problem: str, name: str = "step", pattern: ArrayLike = (0,)) -> Array:
    """:func:`errors` with the steps of :data:`STEP_RUNGS`, (level, 3).

    Parameters
    ----------
    problem, name : what is solved, and the name of the fields and rungs.
    pattern : what is added to the rungs of successive steps, again and again.
    """
    solved, found = manufactured(problem, name, STEP_ROWS), []
    for level, rung in enumerate(STEP_RUNGS[name]):
        found.append(errors(solved, rung + np.resize(pattern, MOST_STEPS * 2**level)))
    return np.array(found)


def orders(errors: ArrayLike) -> Array:
    """Orders between successive errors (along the first axis), each of half the spacing."""
    errors = np.asarray(errors, dtype=float)
    return np.log2(errors[:-1] / errors[1:])


def convergence_dataset() -> xr.Dataset:
    """Errors of all problems on all meshes and with all steps.

    :data:`ERRORS` on (problem, refinement, level), and :data:`SPACINGS` of the levels.
    Elastodynamics has the error of the displacement alone, and none in the quasi-static limit.
    """
    found = np.full((len(PROBLEMS), len(REFINEMENTS), len(ROWS), len(ERRORS)), np.nan)
    for i, problem in enumerate(PROBLEMS):
        alone = problem == "elastodynamics"
        for j, name in enumerate(REFINEMENTS[: 2 if alone else 3]):
            measured = mesh_errors(problem) if name == "mesh" else step_errors(problem, name)
            found[i, j] = np.where([True, not alone, not alone], measured, np.nan)
    sizes = [GEOMETRY.length / (2.0 * np.array(ROWS))]
    sizes += [np.array([*map(BDF().steady_step, STEP_RUNGS[name])]) for name in REFINEMENTS[1:]]
    errors_on = {
        name: (("problem", "refinement", "level"), found[..., i]) for i, name in enumerate(ERRORS)
    }
    levels = {name: ("level", size) for name, size in zip(SPACINGS, sizes, strict=True)}
    coordinates = {"problem": list(PROBLEMS), "refinement": list(REFINEMENTS)}
    dataset = xr.Dataset(errors_on | levels, coordinates)
    return annotate(dataset, COORDINATES | SPACINGS | ERRORS)


def to_csv(dataset: xr.Dataset) -> str:
    """The errors and their orders as comma-separated text, a line per problem and level."""
    tables = []
    for problem, refinement in itertools.product(PROBLEMS, REFINEMENTS):
        own = dataset.sel(problem=problem, refinement=refinement)
        spacing = own[dict(zip(REFINEMENTS, SPACINGS, strict=True))[refinement]].values
        columns = {"problem": problem, "refinement": refinement, "spacing": spacing}
        for name in ERRORS:
            columns[name] = own[name].values
            columns[f"{name}_order"] = np.append(np.nan, orders(own[name].values))
        tables.append(pd.DataFrame(columns).dropna(subset="displacement_error"))
    return pd.concat(tables).to_csv(index=False, float_format="%.6g")


def files() -> dict[str, Any]:
    """The step ``verification``: :func:`convergence_dataset` with its CSV."""
    found = convergence_dataset()
    return {".nc": found, ".csv": to_csv(found)}
