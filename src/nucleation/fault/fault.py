"""A fault, two bodies in frictional contact: one or many, and every answer about it."""

from __future__ import annotations

import dataclasses
import html
import inspect
import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from ..model.friction import Friction
from ..model.friction.constants import law_of, roughness_length
from ..model.hints import hint
from ..model.quantities import ParameterError, declared
from ..model.settings import Perturbation
from ..model.units import magnitude
from ..theory.critical import CriticalMode, critical_modes
from ..theory.evaluation import PMMA, bodies_differ, completed, evaluate, require_broadcast
from ..theory.spectrum import Systems
from ..theory.values import QUANTITIES, WORDS, Values, checked, labelled, named, numbers_of
from .flat import flat, keywords, read_parameters
from .setting import friction, second_body

if TYPE_CHECKING:
    from ..answers.lengths import Lengths
    from ..answers.specimen import Fit

_MISSING: Any = None
"""The default of parameters without one, so that an error can name all that are missing."""

_WAVENUMBER = declared("wavenumber, of either sign,", "[1e-30, 1e30] 1/m", symbol="k")
_OF_LAW = ("friction", "a", "zeta", "slip_distance")
"""The constants that a friction law has at V."""


@dataclasses.dataclass(frozen=True, kw_only=True, eq=False)
class Fault:
    """Two bodies in frictional contact that slide steadily; scalars, arrays or DataArrays.

    Parameters
    ----------
    shear_modulus : array_like
        mu (Pa) of the first body. Every number may be an array, a DataArray, a pint quantity or a
        text with a unit such as "0.5um"; they broadcast as NumPy's or, by name, as xarray's do.
    poisson_ratio : array_like
        nu of the first body; not needed in antiplane shear.
    normal_stress : array_like
        sigma0 (Pa), compressive positive.
    a : array_like
        Direct effect, ``a = v df/dv`` at fixed state, by the **natural** logarithm: divide a value
        per decade by ``ln 10 = 2.303``.
    zeta : array_like, optional
        Velocity weakening ``zeta = b - a = -df_ss/dlog v``; either this or `b` is given.
    b : array_like, optional
        Coefficient of the logarithm of the state, ``b = a + zeta``.
    slip_distance : array_like
        Characteristic slip distance D (m); ``ell = D`` for the aging and the slip law.
    friction : array_like, optional
        Friction coefficient f of steady sliding. Bodies that differ need it, since slip then
        changes the normal stress, and so does the length at the drop.
    velocity : array_like, optional
        Sliding velocity V (m/s); rates, frequencies and the length at the drop need it.
    height : array_like, optional
        Height (m) of the first body; inf, the default, makes it a half-space.
    second_shear_modulus : array_like, optional
        mu (Pa) of the second body; that of the first one by default, inf for a rigid body.
    second_poisson_ratio, second_height : array_like, optional
        The same for nu and the height (m).
    far_side : {"free", "velocity", "clamped", "roller"}
        Boundary condition on the first body's side away from the interface: both stresses (Eq. 10),
        u_x and sigma_yy, u_x and u_y, or u_y and sigma_xy are imposed. ``"traction"`` is read as
        ``"free"``.
    second_far_side : str, optional
        The same of the second body; that of the first one by default.
    zone_thickness : array_like, optional
        Thickness h (m) of a zone of other stiffness, gouge or damaged rock, between the fault and
        each body that is not rigid; heights do not include it. By default there is no zone.
    zone_shear_modulus, zone_poisson_ratio : array_like, optional
        mu (Pa) and nu of the zone; the first body's nu by default.
    plane : {"strain", "stress", "antiplane"}
        Plane strain, or plane stress of thin plates, with ``nu/(1 + nu)`` in place of nu, or
        antiplane shear (mode III), in which nu and f do not matter.
    loading : {"edge", "remote"}
        Where the creeping patch begins: at an edge that is pushed, or in the interior under a load
        from afar. The bodies' `far_side` sets the boundary condition there.
    evolution : str
        Evolution of the state, ``aging`` by default; a `friction_law` has its own.
    friction_law : Friction, optional
        The full law, which gives the local a(v), b(v) along a creeping patch; needs `velocity`.
        Those of f, a, zeta and D that are not given are the law's, expanded about V; a law has the
        values that are given. By default a and b are constant.
    density : array_like, optional
        Mass density (kg/m3), 1200 of PMMA (the paper's) by default; only inertia depends on it.
    second_density : array_like, optional
        The same of the second body; that of the first one by default.
    initial_state : array_like, optional
        Age phi0 (s) of the interface when the loading begins; 20 D/V by default.

    Raises
    ------
    ParameterError
        If a parameter is outside its range, missing, given twice or of another unit's dimension. An
        ImplausibleWarning warns of magnitudes that no known fault has, as a modulus of 30 Pa.

    Examples
    --------
    >>> granite = Fault(
    ...     shear_modulus="30GPa", poisson_ratio=0.25, normal_stress=[50e6, 100e6],
    ...     a=0.010, b=0.015, slip_distance="5um",
    ... )
    >>> granite.critical_length()
    array([2.51327412, 1.25663706])
    """

    shear_modulus: Any = _MISSING
    poisson_ratio: Any = _MISSING
    normal_stress: Any = _MISSING
    a: Any = _MISSING
    zeta: Any = None
    b: Any = None
    slip_distance: Any = _MISSING
    friction: Any = None
    velocity: Any = None
    height: Any = math.inf
    second_shear_modulus: Any = None
    second_poisson_ratio: Any = None
    second_height: Any = None
    far_side: str = "free"
    second_far_side: str | None = None
    zone_thickness: Any = None
    zone_shear_modulus: Any = None
    zone_poisson_ratio: Any = None
    plane: str = "strain"
    loading: str = "edge"
    evolution: str | None = None
    friction_law: Friction | None = None
    density: Any = PMMA
    second_density: Any = None
    initial_state: Any = None
    registry: Any = dataclasses.field(default=None, init=False, repr=False, compare=False)
    """The pint registry of a parameter that was a quantity; the fields are in SI units."""

    def __new__(cls, **given: Any) -> Self:
        for name in given:
            if name not in QUANTITIES and name != "friction_law":
                suggestion = hint(name, QUANTITIES) or f"known: {', '.join(QUANTITIES)}"
                raise ParameterError(
                    f"the fault got an unexpected keyword argument {name!r}; {suggestion}"
                )
        return super().__new__(cls)

    def __post_init__(self) -> None:
        vars(self).update(completed(vars(self)))

    def keys(self) -> list[str]:
        """Names of the parameters with a value; with ``[name]`` they make ``**fault`` possible."""
        names = [field.name for field in dataclasses.fields(self)]
        return [n for n in names if getattr(self, n) is not None and not self._follows(n)]

    def __repr__(self) -> str:
        """All parameters, and in a comment what they mean: the second body and the law."""
        fields = [field.name for field in dataclasses.fields(self) if field.repr]
        given = ", ".join(f"{name}={getattr(self, name)!r}" for name in fields)
        return f"{type(self).__name__}({given})  # {second_body(self)} {friction(self)}"

    def _repr_html_(self) -> str:
        """All parameters with their units, of both bodies and the law, for a notebook."""
        lines = []
        for name in (*QUANTITIES, "friction_law"):
            value = getattr(self, name)
            if value is None and name != "friction_law":
                continue
            unit = QUANTITIES[name].unit if name in QUANTITIES else "1"
            shown = f"{name:<22}{value}"
            lines.append(shown if unit == "1" else f"{shown} {unit}")
        lines += [second_body(self), friction(self)]
        return f"<pre>{html.escape(chr(10).join(lines))}</pre>"

    def __eq__(self, other: object) -> bool:
        """Whether all parameters are equal, arrays in all their values."""
        if not isinstance(other, Fault):
            return NotImplemented
        return all(map(_equal, self._compared, other._compared))

    def __hash__(self) -> int:
        # faults that are equal have equal numbers, whichever kind of array holds them
        return hash(tuple(tuple(np.ravel(x).tolist()) for x in self._compared))

    @property
    def _compared(self) -> list[Any]:
        """What two equal faults share: all parameters but the registry of their units."""
        return [getattr(self, field.name) for field in dataclasses.fields(self) if field.compare]

    def _follows(self, name: str) -> bool:
        """Whether a value follows from others: zeta has b's, the first body or the law has it."""
        if name == "evolution":
            return self.friction_law is not None
        first = name.removeprefix("second_")
        if first != name:
            return getattr(self, name) is getattr(self, first)
        if name in _OF_LAW and self.friction_law is not None and not np.ndim(self.velocity):
            law = self.friction_law
            own = (*law.expansion(self.velocity), law.slip_distance)
            return bool(np.all(getattr(self, name) == own[_OF_LAW.index(name)]))
        return name in ("b", "registry")

    def __getitem__(self, name: str) -> Any:
        value = getattr(self, name)
        if self.registry is None or name in (*WORDS, "friction_law"):
            return value
        return self.registry.Quantity(value, QUANTITIES[name].unit)

    def replace(self, **changes: Any) -> Self:
        """The fault with other parameters; ``b`` replaces ``zeta``, and the other way round."""
        kept = {name: self[name] for name in self.keys() if name not in changes}
        if "b" in changes:
            kept.pop("zeta", None)
        law = kept.get("friction_law")
        if law is not None and changes.get("evolution") is not None:
            kept["friction_law"] = law.changed({"evolution": changes["evolution"]})
        return type(self)(**kept | changes)

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> Self:
        """The fault of a flat mapping, the inverse of :meth:`to_dict`.

        Beside the names of the parameters it may have ``second_body`` (rigid or deformable),
        ``zeta_over_a``, and ``friction_law`` by its name with parameters of the law.
        """
        return cls(**keywords(values))

    @classmethod
    def from_file(cls, path: Path | str) -> Self:
        """The fault in a YAML or JSON file, a mapping as of :meth:`from_dict`; units in texts."""
        return cls(**keywords(read_parameters(path)))

    def to_dict(self) -> dict[str, Any]:
        """The parameters of a single fault as plain values in SI units, with the law's."""
        return flat(self)

    def law(self) -> Friction:
        """The full friction law of a single fault with velocity and friction.

        The given law, or the regularised Dieterich-Ruina law, with the fault's constants at V.
        """
        names = ("velocity", "slip_distance", "friction", "a", "zeta")
        return law_of(self.friction_law, str(self.evolution), *map(self.single, names))

    def single(self, name: str) -> float:
        """The number that a parameter of a single fault has, which is not missing (SI units)."""
        value, entry = getattr(self, name), QUANTITIES[name]
        if value is None:
            unit = f" ({entry.unit})" if entry.unit != "1" else ""
            raise ParameterError(f"{name}{unit} is missing: give the {entry.description}")
        if np.size(value) != 1:
            raise ParameterError(f"{name} has {np.size(value)} values: it must have one here")
        return float(np.ravel(value)[0])

    def critical_length(self) -> Any:
        """Critical nucleation length L_c of the linear theory of homogeneous sliding.

        k_c is the largest wavenumber at which a root of Eq. (5) is marginal. Two half-spaces of one
        material have Eq. (6), of different ones Eq. (9), a thin layer on a rigid body Eq. (11).
        ``L_c = 2 pi/k_c`` (m) is NaN where sliding is stable (:meth:`lengths` has the reason), and
        inf where it is longer than any that can be computed, more than 1e70 times the height. It
        is a DataArray if there is one among the parameters, else a pint quantity if there is one.
        """
        return self._critical().length

    def critical_mode(self) -> CriticalMode:
        """Critical length (m), wavenumber (1/m) and angular frequency (rad/s); needs `velocity`."""
        self._require_velocity()
        return self._critical()

    def spectrum(self, wavenumber: Values) -> Any:
        """Growth rates of both modes of homogeneous sliding, the roots of Eq. (5).

        Parameters
        ----------
        wavenumber : array_like or DataArray
            k (1/m), of either sign, 1e-30 to 1e30; broadcasts with the parameters.

        Returns
        -------
        ndarray or DataArray
            Lambda (1/s), complex, of perturbations ``exp(Lambda t - i k x)``; shape ``(2,)`` and
            the broadcast shape, the faster root first (dimension ``root`` of a DataArray).
        """
        self._require_velocity()

        found = self._at(wavenumber, Systems.growth_rates, dtype=complex)
        if labelled(found):
            found = found.rename(row="root")
        return named(found, "growth_rate", "1/s", "growth rate of the mode", self)

    def transfer_functions(self, wavenumber: Values) -> tuple[Any, Any]:
        """Elastic transfer functions G1 and G2 of the pair of bodies (Eqs. 7, 10).

        Parameters
        ----------
        wavenumber : array_like or DataArray
            k (1/m), of either sign, 1e-30 to 1e30; broadcasts with the parameters.

        Returns
        -------
        G1, G2 : ndarray or DataArray
            ``delta sigma_xy = -mu k G1 delta epsilon``, ``delta sigma_yy = i mu k G2 delta
            epsilon`` with mu of the first body; dimensionless, broadcast shape.
        """
        shear, normal = self._at(wavenumber, lambda own, k: own.pair.transfer_functions(k))
        return (
            named(shear, "G1", "1", "shear response", self),
            named(normal, "G2", "1", "normal response", self),
        )

    def stability_length(self) -> Any:
        """Stability length L_s (m), where the creeping patch turns unstable; NaN without one."""
        from ..theory.creep.lengths import stability_answers

        found = stability_answers(self)[0]
        return named(found, "stability_length", "m", "stability length of the creeping patch", self)

    def runaway_length(self) -> Any:
        """Runaway length L_run, beyond which a creeping patch can't slip slowly.

        Between L_s and L_run a patch slips slowly. Where friction weakens little, zeta/a below 2,
        the force drops at L_run or later. L_run (m) is known within 2 % in thin layers and up to
        7 % between half-spaces; NaN where there is none, and for zeta/a of 2 or more. Without a
        velocity or f, a and b are constant.
        """
        from ..theory.creep.runaway import runaway_answers

        return named(runaway_answers(self)[0], "runaway_length", "m", "runaway length", self)

    def weakening_patch_length(self, outside_zeta: Values, outside_a: Values | None = None) -> Any:
        """Smallest width W_c of a weakening patch that nucleates among strengthening surroundings.

        A narrower patch creeps at V like its surroundings, whatever disturbs it a little; on a
        wider one slip oscillates with a growing amplitude. It ends in slow slip or in an event.

        Parameters
        ----------
        outside_zeta : array_like
            zeta of the surroundings, negative where they strengthen with slip rate.
        outside_a : array_like, optional
            Their direct effect; that of the patch by default.

        Returns
        -------
        float, ndarray or DataArray
            W_c (m), within 1e-4; NaN where sliding is stable with the friction of the patch or
            unstable with that of the surroundings, and where no patch up to ``10 L_c`` is unstable.
        """
        from ..theory.weakening_patch import weakening_patch_values

        found = weakening_patch_values(self, outside_zeta, outside_a)
        return named(found, "weakening_patch_length", "m", "smallest patch that nucleates", self)

    def lengths(
        self,
        perturbation: str = "normal_load",
        strength: float | None = None,
        *,
        correlation_time: float = 1.0,
        correlation_length: float | None = None,
        weakening_rate: Values | None = None,
    ) -> Lengths:
        """The length at which the patch runs away, and those that it rests on, with their ranges.

        Parameters
        ----------
        perturbation : {"normal_load", "drive_velocity", "strength", "state", "none"}
            What fluctuates, until the patch runs away; with "none" L and L_run are left out.
        strength : float, optional
            Its relative strength (standard deviation); 1e-4 by default.
        correlation_time : float
            Over D/V.
        correlation_length : float, optional
            In m; a fifth of L_b by default.
        weakening_rate : array_like, optional
            Slip weakening W (Pa/m) of Uenishi and Rice's length; ``b sigma0/D`` by default.

        Returns
        -------
        Lengths
            By key: ``drop_length`` L, at which the patch runs away, ``stability_length`` L_s,
            ``critical_length`` L_c, ``runaway_length`` L_run and ``process_zone``. Its ``sentence``
            is the answer in words, ``literature`` has the lengths of the literature, and
            ``dataset()`` makes a Dataset of it.

        Examples
        --------
        >>> granite = Fault(
        ...     shear_modulus="30GPa", poisson_ratio=0.25, normal_stress="50MPa",
        ...     a=0.010, b=0.015, slip_distance="5um",
        ... )
        >>> granite.lengths()["stability_length"].value.round(2)
        1.95
        """
        from ..answers.lengths import lengths_of

        if perturbation == "none":
            return lengths_of(self, None, weakening_rate)
        given = 0.0 if strength is None else strength
        scale = 1.0 if correlation_length is None else correlation_length
        declared = Perturbation(perturbation, given, correlation_time, scale)
        if correlation_length is None and declared.along_x:
            roughness = roughness_length(self, self.single("b"))
            declared = dataclasses.replace(declared, correlation_length=roughness)
        return lengths_of(self, declared, weakening_rate)

    def literature(self, weakening_rate: Values | None = None) -> Lengths:
        """The lengths of the literature alone, closed forms; W (Pa/m) is of Uenishi and Rice's.

        The ``doubt`` of each names how this fault differs from the setting of the length.
        """
        from ..answers.lengths import Lengths
        from ..answers.literature import answers_of_literature

        return Lengths(answers_of_literature(self, weakening_rate))

    def specimen(
        self,
        unknown: str,
        length: Values,
        criterion: str = "critical",
        within: tuple[float, float] | None = None,
    ) -> Fit:
        """Values of one parameter at which a nucleation length fits a specimen.

        Parameters
        ----------
        unknown : {"normal_stress", "slip_distance", "shear_modulus"}
            The parameter to find: sigma0 (Pa), D (m) or mu (Pa) of the first body; its value in
            this fault has no effect. A second body like the first has the same mu.
        length : float or text
            Length of the specimen along the fault (m).
        criterion : {"critical", "stability"}
            The length that has to fit: L_c, or L_s of a creeping patch.
        within : (float, float), optional
            Range of the search, in SI units; by default all known values.

        Returns
        -------
        Fit

        """
        from ..answers.specimen import specimen_fit

        return specimen_fit(self, unknown, length, criterion, within)

    def _critical(self) -> CriticalMode:
        length, k, omega = evaluate(self, critical_modes, rows=3)
        mirrored = np.logical_not(bodies_differ(vars(self)))
        omega = omega + (abs(omega) - omega) * mirrored  # keeps the dimensions' names
        frequency = "frequency of the critical mode"
        return CriticalMode(
            length=named(length, "critical_length", "m", "critical nucleation length", self),
            wavenumber=named(k, "critical_wavenumber", "1/m", "critical wavenumber", self),
            angular_frequency=named(omega, "critical_frequency", "rad/s", frequency, self),
        )

    def _at(self, wavenumber: Values, function: Callable[..., Any], dtype: type = float) -> Any:
        """Two rows of a function of Systems and wavenumbers, which must not be zero."""
        k = magnitude("wavenumber", wavenumber, _WAVENUMBER)
        checked("wavenumber", abs(k if labelled(k) else np.asarray(k)), _WAVENUMBER)
        require_broadcast(numbers_of(self) | {"wavenumber": k})
        return evaluate(self, function, k, rows=2, dtype=dtype)

    def _require_velocity(self) -> None:
        if self.velocity is None:
            raise ParameterError("velocity (m/s) is missing: rates and frequencies depend on it")


def _equal(first: Any, second: Any) -> bool:
    """Whether two values of a parameter are the same; arrays of one kind, shape and values."""
    if type(first) is not type(second):
        return False
    if np.ndim(first):
        return bool(first.equals(second) if labelled(first) else np.array_equal(first, second))
    return bool(first == second)


_own = inspect.signature(Fault.__init__).parameters.values()
Fault.__signature__ = inspect.Signature([x for x in _own if x.name != "self"])  # type: ignore
