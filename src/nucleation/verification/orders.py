"""Orders of convergence in h and in dt, measured on manufactured solutions.

Neither order is polluted by the other. In space the fields are smooth, and quadratic in time, for
which BDF2 is exact; in time they oscillate, and are bilinear in space, for which the elements are
exact. Three problems: elastodynamics with the interface's displacement prescribed, and the block
on its frictional interface with the aging and with the slip law. The latter two are also solved
with fields so slow that waves cross the block many times within a step: there the solver steps
slip and state by BDF3, and the order in dt is three.
"""

from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from ..datasets.variables import Variable, annotate
from ..model.friction.law import Friction
from ..model.material import Material
from ..model.parameters import Geometry, Loading, Mesh, Parameters
from ..simulation.recorded import RECORDED
from ..stepping.scheme import BDF
from ..types import Array
from .manufactured.dynamics import Manufactured, ManufacturedFriction
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
    change_of_state: Term  # added to the psi = log(D/V) of steady sliding
    lumped: bool  # of ManufacturedFriction


def _bilinear(along: Factor, across: Factor) -> Displacement:
    """The same field bilinear in space with these factors in time, of w_x and u_y."""
    w_x = Term(SCALE, Power(0.0, 1.0), Power(1.0, 0.7), along)
    u_y = Term(2 * SCALE, Power(1.0, 0.6), Power(0.0, 1.0), across)
    return Displacement(((w_x,), (u_y, COMPRESSION)), MATERIAL)


FIELDS = {
    "mesh": Fields(
        Displacement(
            (
                (Term(SCALE, Sine(2.1), Sine(1.7, 1.9), Power(1.0, 1e3, 5e5)),),
                (Term(2 * SCALE, Sine(1.9, 2.0), Sine(2.3), Power(1.0, -7e2, 6e5)), COMPRESSION),
            ),
            MATERIAL,
        ),
        2e-3,
        Term(0.5, Sine(3.0, 1.0), Power(1.0), Power(1.0, -6e2, 4e5)),
        lumped=False,
    ),
    "step": Fields(
        _bilinear(Sine(1e4, 0.3), Sine(1.5e4, 1.1)),
        2e-2,
        Term(0.5, Sine(3.0, 1.0), Power(1.0), Sine(1.2e4, 0.5)),
        lumped=True,
    ),
    "quasi_static_step": Fields(
        _bilinear(Sine(4.0, 0.3), Sine(6.0, 1.1)),
        8e-6,
        Term(0.5, Sine(3.0, 1.0), Power(1.0), Sine(5.0, 0.5)),
        lumped=True,
    ),
    # bilinear and quadratic at once: solved exactly
    "exact": Fields(
        _bilinear(Power(1.0, 8e2, 7e5), Power(1.0, -5e2, 7e5)),
        2e-3,
        Term(0.5, Sine(3.0, 1.0), Power(1.0), Power(1.0, -6e2, 4e5)),
        lumped=True,
    ),
}


def manufactured(problem: str, name: str, rows: int, grading: float = GRADING) -> Manufactured:
    """The solver under the loads of a problem of :data:`PROBLEMS`.

    Parameters
    ----------
    problem, name : what is solved, and the name of the :data:`FIELDS`.
    rows : elements along y, half of those along x.
    grading : height of the top row of elements over that of the bottom row.
    """
    fields = FIELDS[name]
    law = "aging" if problem == "elastodynamics" else problem
    parameters = Parameters(
        MATERIAL,
        Friction(characteristic_slip_distance=DISTANCE, evolution=law),
        Loading(velocity=fields.velocity),
        GEOMETRY,
        Mesh(n_x=2 * rows, n_y=rows, grading=grading),
    )
    if problem == "elastodynamics":
        return Manufactured(parameters, fields.displacement)
    steady = Term(np.log(parameters.memory_time), Power(1.0), Power(1.0), Power(1.0))
    log_state = (steady, fields.change_of_state)
    return ManufacturedFriction(parameters, fields.displacement, log_state, fields.lumped)


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
        known = 1 if problem == "elastodynamics" else len(ERRORS)
        found[i, 0, :, :known] = mesh_errors(problem)[:, :known]
        for j, name in enumerate(REFINEMENTS[1:], start=1):
            if problem != "elastodynamics" or name == "step":
                found[i, j, :, :known] = step_errors(problem, name)[:, :known]
    on = ("problem", "refinement", "level")
    sizes = [GEOMETRY.length / (2.0 * np.array(ROWS)), *map(step_sizes, REFINEMENTS[1:])]
    dataset = xr.Dataset(
        {
            **{name: (on, found[..., i]) for i, name in enumerate(ERRORS)},
            **{name: ("level", size) for name, size in zip(SPACINGS, sizes, strict=True)},
        },
        {"problem": list(PROBLEMS), "refinement": list(REFINEMENTS)},
    )
    return annotate(dataset, COORDINATES | SPACINGS | ERRORS)


def step_sizes(name: str) -> Array:
    """Lengths (s) of the steps of :data:`STEP_RUNGS`."""
    return np.array([BDF().steady_step(rung) for rung in STEP_RUNGS[name]])


def to_csv(dataset: xr.Dataset) -> str:
    """The errors and their orders as comma-separated text, a line per problem and level."""
    lines = ["problem,refinement,spacing," + ",".join(f"{n},{n}_order" for n in ERRORS)]
    for problem in PROBLEMS:
        for refinement, spacing in zip(REFINEMENTS, SPACINGS, strict=True):
            values = dataset.sel(problem=problem, refinement=refinement)
            columns = [dataset[spacing].values]
            for name in ERRORS:
                columns += [values[name].values, np.append(np.nan, orders(values[name].values))]
            for row in zip(*columns, strict=True):
                if np.isfinite(row[1]):
                    numbers = ("" if np.isnan(x) else f"{x:.6g}" for x in row)
                    lines.append(f"{problem},{refinement}," + ",".join(numbers))
    return "\n".join(lines) + "\n"


def files() -> dict[str, Any]:
    """The step ``verification``: :func:`convergence_dataset` with its CSV."""
    found = convergence_dataset()
    return {".nc": found, ".csv": to_csv(found)}
