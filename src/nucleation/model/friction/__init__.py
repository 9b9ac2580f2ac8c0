"""Rate-and-state friction: the base class of all laws, and how they are found by name.

The friction coefficient ``f(v, phi)`` depends on the slip rate and on the state variable ``phi``
(s). It is an odd function of the slip rate, so that friction opposes slip in either direction. The
state evolves with the regularised slip speed ``w = sqrt(v^2 + v0^2)``:

    dphi/dt = g(phi w / D)

Each file of ``laws`` has one law f, a class ``Law``, and each file of ``evolutions`` one g; the
file's name is the law's name. No module imports them by an import statement. So a run depends only
on the laws that it uses, and a new file does not affect the runs of other laws. The simulation uses
the logarithm ``psi = log(phi)``: phi stays positive, and friction depends on it almost linearly.
"""

from __future__ import annotations

import copy
import dataclasses
import importlib
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any, ClassVar, NamedTuple, Self, cast

import numpy as np
from numpy.typing import ArrayLike

from ...types import Array
from ..quantities import ParameterError, Quantity, check, declarations, quantity
from ..units import Checked

USUAL_LAW = "product"
USUAL_EVOLUTION = "aging"

LAWS, EVOLUTIONS = (
    tuple(sorted(file.stem for file in (Path(__file__).parent / package).glob("[!_]*.py")))
    for package in ("laws", "evolutions")
)
"""Laws of the friction coefficient, and of the evolution of the state variable, by name."""


@cache
def module(package: str, name: str) -> ModuleType:
    """The module of one law; a ParameterError names a file that can't be loaded."""
    try:
        return importlib.import_module(f".{package}.{name}", __name__)
    except Exception as error:
        path = Path(__file__).parent / package / f"{name}.py"
        raise ParameterError(
            f"{path}: the law {name} can't be loaded: {type(error).__name__}: {error}"
        ) from error


def law_class(name: str) -> type[Friction]:
    """The class of a law."""
    return module("laws", name).Law


def plugins(friction: Any) -> tuple[str, str]:
    """The dotted names of the two modules that a friction law loads by name.

    A digest that follows import statements does not find them: the digest of a simulation's code
    starts from these modules too.
    """
    return f"{__name__}.laws.{friction.law}", f"{__name__}.evolutions.{friction.evolution}"


def law_declarations() -> dict[str, Quantity]:
    """The declared parameters of all friction laws, by name; the usual law's come first.

    The description of a parameter that only some laws have names these laws.
    """
    laws = sorted(LAWS, key=lambda law: law != USUAL_LAW)
    declared = {law: declarations(law_class(law)) for law in laws}
    found: dict[str, Quantity] = {}
    for own in declared.values():
        for key, entry in own.items():
            found.setdefault(key, entry)
    for key, entry in found.items():
        having = [law for law in laws if key in declared[law]]
        if len(having) < len(laws):
            which = f"friction law{'s' if len(having) > 1 else ''} {', '.join(having)}"
            description = f"{entry.description} ({which})"
            found[key] = dataclasses.replace(entry, description=description)
    return found


class Expansion(NamedTuple):
    """Coefficients of the logarithmic law about steady sliding at one slip rate (Eq. S-log)."""

    f0: float
    a: float
    zeta: float


def law_name(name: str) -> Any:
    """The field `law` of a law's class; `name` is the file's ``__name__``."""
    return quantity(
        "friction law: how friction follows from slip rate and state",
        choices=LAWS,
        name="friction_law",
        default=name.rpartition(".")[2],
    )


@dataclasses.dataclass(frozen=True)
class Friction(Checked):
    """Rate-and-state friction by one of the laws (SI units).

    ``Friction(law="dieterich_ruina", ...)`` makes an object of that law's class, as
    :class:`pathlib.Path` does for the operating system. ``Friction(law="product")`` is the paper's;
    parameters that are not given have the values of the paper in every law.

    Raises
    ------
    ParameterError
        If `law` is missing or there is no such law, the law has no such parameter, or a value is
        out of its range.

    Examples
    --------
    >>> law = Friction(law="dieterich_ruina", slip_distance=5e-6)
    >>> law.slip_distance, law.evolution
    (5e-06, 'aging')
    """

    law: str = law_name(USUAL_LAW)
    evolution: str = quantity("state evolution law", choices=EVOLUTIONS, default=USUAL_EVOLUTION)
    slip_distance: float = quantity(
        "characteristic slip distance", "[1e-15, 1e3) m", symbol="D", default=5.0e-7
    )
    regularisation_slip_rate: float = quantity(
        "regularisation slip rate", "[1e-30, 1.0) m/s", symbol="v0", default=1.0e-9
    )

    set_by_expansion: ClassVar[tuple[str, ...]] = ()
    """The parameters that `with_expansion` determines."""

    constants: ClassVar[Any]
    """Of each law: the parameters that `formula` uses."""

    formula: ClassVar[Any]
    """Of each law: f, df/dv (s/m) and df/dpsi of slip rates v (m/s), psi and `constants`.

    A static function of arrays of equal shape, which the simulation compiles.
    """

    with_expansion: ClassVar[Any]
    """Of each law: the law of V (m/s), f, a and zeta with this :meth:`expansion`.

    It has other values of `set_by_expansion`, or raises a ParameterError.
    """

    asinh_of_rate: ClassVar[bool] = False
    """Whether f is proportional to ``asinh(v/s) + step v/hypot(v, s)`` at fixed state.

    s is :meth:`linear_below`, and the step :meth:`step_at_rest`.
    """

    def __new__(cls, law: str = "", *_: Any, **values: Any) -> Self:
        if cls is not Friction:
            return super().__new__(cls)
        if not law:
            known = ", ".join(LAWS)
            raise ParameterError(
                f"friction law is missing: give law, one of {known}; the paper's is {USUAL_LAW}"
            )
        check("friction_law", law, declarations(Friction)["law"])
        own = declarations(law_class(law))
        foreign = [f"{key} = {value!r}" for key, value in values.items() if key not in own]
        if foreign:
            raise ParameterError(
                f"{', '.join(foreign)} is not allowed: the friction law {law} has no such "
                f"parameter; it has {', '.join(own)}"
            )
        return cast(Self, super().__new__(law_class(law)))

    def __post_init__(self) -> None:
        try:
            super().__post_init__()
        except ParameterError as error:
            raise ParameterError(f"{error} (friction law {self.law})") from None
        if self.law != type(self).law:
            raise ParameterError(f"friction_law = {self.law!r} is not that of {type(self).law}")

    def changed(self, values: dict[str, Any]) -> Friction:
        """The law with other parameters; with another `law`, that law with the common parameters.

        Raises a ParameterError if the law has no such parameter, or a value is out of its range.
        """
        if not values:
            return self
        same = values.get("law", self.law) == self.law
        own = type(self) if same else Friction
        kept = {name: getattr(self, name) for name in declarations(own)}
        return Friction(**kept | values)

    def along_x(self, **values: Array) -> Friction:
        """The law with parameters that vary from node to node, which are allowed at each."""
        varied = copy.copy(self)
        vars(varied).update(values)
        return varied

    @property
    def evolution_law(self) -> ModuleType:
        """The module of the state evolution, :mod:`nucleation.model.friction.evolutions`."""
        return module("evolutions", self.evolution)

    def linear_below(self, log_state: ArrayLike) -> Any:
        """Slip rate (m/s) below which friction is linear in it: about its scale of change there."""
        return self.regularisation_slip_rate

    def step_at_rest(self, log_state: ArrayLike) -> Any:
        """The step of f across rest, over its slope by log v; zero where asinh(v/s) has it all."""
        return 0.0

    def coefficient_and_slopes(
        self, slip_rate: ArrayLike, log_state: ArrayLike
    ) -> tuple[Array, Array, Array]:
        """The friction coefficient, and its slopes by slip rate (s/m) and logarithm of the state.

        Parameters
        ----------
        slip_rate, log_state : array_like
            v (m/s) and psi, the logarithm of the state (s); they broadcast.
        """
        v = np.asarray(slip_rate, dtype=float)
        psi = np.asarray(log_state, dtype=float)
        return self.formula(v, psi, self.constants)

    def slip_speed(self, slip_rate: ArrayLike) -> Array:
        """Regularised slip speed ``w = sqrt(v^2 + v0^2)`` (m/s) of a slip rate (m/s)."""
        v = np.asarray(slip_rate, dtype=float)
        return np.sqrt(v * v + self.regularisation_slip_rate**2)

    def coefficient(self, slip_rate: ArrayLike, state: ArrayLike) -> Array:
        """Friction coefficient ``f(v, phi)``.

        Parameters
        ----------
        slip_rate, state : array_like
            v (m/s) and phi (s); they broadcast.
        """
        return self.coefficient_and_slopes(slip_rate, np.log(state))[0]

    def derivatives(self, slip_rate: ArrayLike, state: ArrayLike) -> tuple[Array, Array]:
        """``df/dv`` (s/m) at fixed state and ``df/dphi`` (1/s) at fixed slip rate, exactly.

        Parameters
        ----------
        slip_rate, state : array_like
            v (m/s) and phi (s); they broadcast.
        """
        _, by_rate, by_log_state = self.coefficient_and_slopes(slip_rate, np.log(state))
        return by_rate, by_log_state / np.asarray(state, dtype=float)

    def state_rate(self, slip_rate: ArrayLike, state: ArrayLike) -> Array:
        """``dphi/dt``, dimensionless, by the evolution law.

        Parameters
        ----------
        slip_rate, state : array_like
            v (m/s) and phi (s); they broadcast.
        """
        omega = np.asarray(state) * self.slip_speed(slip_rate) / self.slip_distance
        return self.evolution_law.growth(omega)

    def steady_state(self, slip_rate: ArrayLike) -> Array:
        """State variable (s) of steady sliding, ``phi = D / w``, the same for all evolutions."""
        return self.slip_distance / self.slip_speed(slip_rate)

    def steady_coefficient(self, slip_rate: ArrayLike) -> Array:
        """Friction coefficient of steady sliding at a slip rate (m/s) (Fig. S1)."""
        return self.coefficient(slip_rate, self.steady_state(slip_rate))

    def expansion(self, slip_rate: float) -> Expansion:
        """``f0``, ``a = v df/dv`` and ``zeta = -v df_ss/dv`` about steady sliding (Eq. S-log)."""
        v = float(slip_rate)
        state = self.steady_state(v)
        by_rate, by_state = self.derivatives(v, state)
        steady_slope = by_rate - by_state * state * v / self.slip_speed(v) ** 2
        return Expansion(
            f0=float(self.coefficient(v, state)),
            a=float(v * by_rate),
            zeta=float(-v * steady_slope),
        )
