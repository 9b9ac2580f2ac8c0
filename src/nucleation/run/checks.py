"""Parameters of one run that are each allowed but contradict each other."""

from collections.abc import Iterator

from ..model.perturbations import KINDS
from ..model.quantities import ParameterError
from ..model.settings import ELEMENTS_PER_CORRELATION, FIRST_STEP
from .run import Run

_SECOND_FAR_SIDES = ("free", "clamped", "roller")


def require_consistent(run: Run) -> None:
    """Raise a ParameterError if the solver can't make the body of a run."""
    problems = list(_of_body(run))
    if problems:
        raise ParameterError("; ".join(problems))


def contradictions(run: Run) -> Iterator[str]:
    """The contradictions in a run, one text for each, with name, value and what is allowed."""
    yield from _of_body(run)
    tau, kind = run.start.initial_shear_stress, run.start.initial_stress
    if tau and kind == "no_slip":
        yield (
            f"initial_shear_stress = {tau:g} Pa is not allowed with initial_stress = no_slip: it "
            "must be 0 Pa, or initial_stress uniform_shear"
        )
    shortest, longest, memory = run.stepping.shortest_step, run.longest_step, run.memory_time
    first = FIRST_STEP * memory
    if shortest >= min(longest, first):
        yield (
            f"shortest_step = {shortest:g} s is not allowed: it must be less than the first step, "
            f"{first:.3g} s, and the longest one, {longest / memory:.3g} D/V = {longest:.3g} s"
        )
    declared = run.perturbation
    if declared.kind == "none" and declared.strength > 0.0:
        yield (
            f"strength = {declared.strength:g} is not allowed with perturbation = none, "
            f"which perturbs nothing: it must be 0, or perturbation one of {', '.join(KINDS)}"
        )
    length, element = declared.correlation_length, run.block.length / run.block.n_x
    if declared.acts and declared.along_x and length < element:
        yield (
            f"correlation_length = {length:g} m is not allowed: it "
            f"must be at least an element, {element:.3g} m, better {ELEMENTS_PER_CORRELATION:g}"
        )


def _of_body(run: Run) -> Iterator[str]:
    loading, rate, n_x = run.fault.loading, run.start.stress_rate, run.block.n_x
    remote = loading == "remote"
    if remote != (rate > 0.0):
        rule = "more than 0" if remote else "0"
        yield (
            f"stress_rate = {rate:g} Pa/s is not allowed with loading = {loading}: it must be "
            f"{rule} Pa/s"
        )
    if remote and n_x % 2 == 0:
        yield f"n_x = {n_x} is not allowed with loading = remote: it must be odd"
    length, own = run.block.length, run.heterogeneity
    limits = (
        ("centre", own.centre, 0.0, "on the block"),
        ("width", own.width, length / n_x, "from an element to the block"),
    )
    for name, value, low, rule in limits if own.varies != "none" else ():
        if value is not None and not low <= value <= length:
            yield (
                f"{name} = {value:g} m is not allowed: it must lie in [{low:.3g}, {length:.3g}] m, "
                f"{rule}"
            )
    below = run.below
    if below is not None and below.far_side not in _SECOND_FAR_SIDES:
        yield (
            f"second_far_side = {below.far_side} is not allowed in a simulation: it must be one of "
            f"{', '.join(_SECOND_FAR_SIDES)}"
        )


def require_uniform_edge(run: Run) -> None:
    """Raise a ParameterError unless the fault is uniform and pushed at its edge."""
    for key, value, needed in (
        ("loading", run.fault.loading, "edge"),
        ("heterogeneity", run.heterogeneity.varies, "none"),
    ):
        if value != needed:
            raise ParameterError(
                f"{key} = {value} is not allowed with the law of the drop, which applies only to a "
                f"uniform fault that is pushed at its edge: it must be {needed}; measure = "
                "stability gives L_s of other faults, docs/loadings.md"
            )


def memory_problem(run: Run, key: str, limit: float) -> Iterator[str]:
    """Why a run needs more memory than a limit (MB), which is called `key`; else nothing."""
    need = estimated_megabytes(run)
    if need > limit:
        second = f", second_n_y = {run.below.n_y}" if run.below else ""
        yield (
            f"n_x = {run.block.n_x}, n_y = {run.block.n_y}{second} is not allowed: the simulation "
            f"would need about {need:.0f} MB, more than {key} = {limit:g} MB"
        )


def estimated_megabytes(run: Run) -> float:
    """Memory (MB) that a simulation needs, rounded up from measured runs.

    The memory consists of the libraries, some hundred vectors of the bodies (mostly the stored
    factors for step sizes in use) and some dense matrices of the interface, two in each factor.
    """
    n_x = run.block.n_x
    rows = run.block.n_y + (run.below.n_y if run.below else 0)
    vector = 8e-6 * 2 * n_x * rows
    matrix = 8e-6 * n_x**2
    return 250.0 + 400.0 * vector + 8.0 * matrix
