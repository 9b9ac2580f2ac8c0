"""One fault, and every question about it: the object behind the functions of the library."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from ..lengths.in_use import lengths_in_use
from ..model.friction.law import Friction
from ..model.own_fault import follows_from
from ..model.parameters import Parameters
from ..model.quantities import ParameterError, plain
from ..theory import arrays
from ..theory.critical import CriticalMode
from ..theory.fault import FaultParameters
from ..theory.of_runs import fault_of_run
from ..theory.stiffness import FAR_SIDES
from ..theory.values import OF_THEORY, ZONE, Values

if TYPE_CHECKING:
    import xarray as xr

    from ..drop.expected_drop import ExpectedDrop
    from ..lengths.specimen import Fit


@dataclasses.dataclass(frozen=True, kw_only=True)
class Fault(FaultParameters):
    __doc__ = f"""{FaultParameters.__doc__}
    Notes
    -----
    ``fault.critical_length()`` is ``critical_length(**fault)``, and likewise for every function of
    a fault in :mod:`nucleation.api`. Questions about a simulation, :meth:`parameters`,
    :meth:`expected_drop` and :meth:`simulate`, need a single fault with `velocity` and `friction`.
    """

    @classmethod
    def of(cls, parameters: Parameters) -> Self:
        """The fault of a simulation, with its friction law.

        Parameters
        ----------
        parameters : Parameters
            Of the simulation; ``Parameters()`` has the paper's fault.

        Returns
        -------
        Fault

        Examples
        --------
        >>> round(float(Fault.of(Parameters()).critical_length()), 3)
        0.328
        """
        return cls(**fault_of_run(parameters))

    @classmethod
    def from_file(cls, path: Path | str) -> Self:
        """The fault in a file of parameters.

        Parameters
        ----------
        path : Path or str
            YAML or JSON, by the names of the commands' options, with values in SI units or with
            units. Without ``second_body`` the bodies are alike.

        Returns
        -------
        Fault
            With the friction law of `nucleation drop` and `simulate`, if its constants are known.

        Raises
        ------
        ParameterError
            If a name or a value is wrong, or a parameter is missing.
        """
        from replication.configuration.given_fault import fault_from
        from replication.configuration.parameter_files import read_parameters

        given = {"second_body": "deformable"} | read_parameters(Path(path))
        of_theory = {name: given.pop(name) for name in OF_THEORY if name in given}
        completed = given | follows_from(given)
        return cls(**fault_from(completed), **of_theory)

    def critical_length(self) -> Any:
        """L_c (m), :func:`nucleation.api.critical_length`."""
        return arrays.critical_length(**self)

    def critical_mode(self) -> CriticalMode:
        """Length, wavenumber and frequency, :func:`nucleation.api.critical_mode`."""
        return arrays.critical_mode(**self)

    def spectrum(self, wavenumber: Values) -> Any:
        """Growth rates (1/s) at wavenumbers (1/m), :func:`nucleation.api.spectrum`."""
        return arrays.spectrum(wavenumber, **self)

    def transfer_functions(self, wavenumber: Values) -> tuple[Any, Any]:
        """G1 and G2 at wavenumbers (1/m), :func:`nucleation.api.transfer_functions`."""
        return arrays.transfer_functions(wavenumber, **self)

    def stability_length(self) -> Any:
        """L_s (m), :func:`nucleation.api.stability_length`."""
        from ..theory.creep.lengths import stability_length

        return stability_length(**self)

    def runaway_length(self) -> Any:
        """L_run (m), :func:`nucleation.api.runaway_length`."""
        from ..theory.creep.runaway import runaway_length

        return runaway_length(**self)

    def weakening_patch_length(self, outside_zeta: Values, outside_a: Values | None = None) -> Any:
        """W_c (m), :func:`nucleation.api.weakening_patch_length`.

        Parameters
        ----------
        outside_zeta : array_like
            Velocity weakening of the surroundings, negative.
        outside_a : array_like, optional
            Their direct effect; that of the patch by default.

        Returns
        -------
        ndarray or DataArray
            Broadcast shape.
        """
        from ..theory.weakening_patch import weakening_patch_length

        return weakening_patch_length(outside_zeta=outside_zeta, outside_a=outside_a, **self)

    def lengths_in_use(self, **options: Any) -> xr.Dataset:
        """The lengths of the literature (m), :func:`nucleation.api.lengths_in_use`."""
        return lengths_in_use(**options, **self)

    def length_statuses(self, **options: Any) -> xr.Dataset:
        """All lengths with reasons, :func:`nucleation.api.length_statuses`."""
        from ..lengths.status import length_statuses

        return length_statuses(**options, **self)

    def specimen_fit(self, unknown: str, length: Any, criterion: str = "critical") -> Fit:
        """Where a nucleation fits into a specimen, :func:`nucleation.api.specimen_fit`.

        Parameters
        ----------
        unknown : str
            Name of the parameter to find; its value in this fault has no effect.
        length : float or text
            Length of the specimen (m).
        criterion : {"critical", "stability"}
            L_c or L_s.

        Returns
        -------
        Fit
        """
        from ..lengths.specimen import specimen_fit

        others = {name: value for name, value in dict(self).items() if name != unknown}
        return specimen_fit(unknown, length, criterion, **others)

    def parameters(self, **changes: Any) -> Parameters:
        """The parameters of a simulation of this fault, checked as those of a configuration.

        Parameters
        ----------
        **changes
            Other parameters by their names in studies, in SI units: ``n_x``, ``perturbation``,
            ``block_length``, ... By default the block is 6 L_c long. Half-spaces become blocks that
            are 4 L_c high and 35 L_c long, which changes L_s by 2 % or less.

        Returns
        -------
        Parameters

        Raises
        ------
        ParameterError
            If the fault is an array, lacks V or f, or can't be simulated.
        """
        from replication.configuration.half_spaces import without_half_spaces
        from replication.configuration.single_run import merged, single_run

        given = self._by_study_names() | changes
        fixed, _ = without_half_spaces(None, given | follows_from(given))
        return single_run(merged(None, fixed)).parameters

    def expected_drop(self, **perturbation: Any) -> ExpectedDrop:
        """L_s, L_run and L under a perturbation, :func:`nucleation.api.expected_drop`.

        Parameters
        ----------
        **perturbation
            ``perturbation`` (its kind), ``strength``, ``correlation_time`` and so on; by default a
            normal load that fluctuates by 1e-4.

        Returns
        -------
        ExpectedDrop
        """
        from ..drop.expected_drop import expected_drop

        usual = {"perturbation": "normal_load", "strength": 1e-4}
        return expected_drop(self.parameters(**usual | perturbation))

    def simulate(self, **changes: Any) -> xr.Dataset:
        """Simulate this fault, :func:`nucleation.api.simulate`.

        Parameters
        ----------
        **changes
            As of :meth:`parameters`.

        Returns
        -------
        Dataset
        """
        from ..simulation.progress import simulate

        return simulate(self.parameters(**changes))

    def _by_study_names(self) -> dict[str, Any]:
        """The parameters by their names in studies, also those of a law that V does not set."""
        found: dict[str, Any] = {}
        for name in self.keys():
            value = getattr(self, name)
            if name in ZONE:
                raise ParameterError(f"{name} is not allowed: no simulation has a zone")
            if np.ndim(value):
                raise ParameterError(f"{name} has {np.size(value)} values: it must have one here")
            found[name] = value if isinstance(value, str | Friction) else float(value)
        far_side = found.pop("far_side")
        if FAR_SIDES[far_side] is not FAR_SIDES["free"]:
            raise ParameterError(
                f"far_side = {far_side!r} is not allowed: the far side of a simulated block is free"
            )
        found["second_body"] = "deformable"
        if math.isinf(found.get("second_shear_modulus", 0.0)):
            found["second_body"] = "rigid"
            found = {name: x for name, x in found.items() if not name.startswith(_SECOND)}
        elif found.get("second_far_side") == "traction":
            found["second_far_side"] = "free"
        law = found.pop("friction_law", None)
        if law is not None:
            own = plain(law)
            found["friction_law"] = own.pop("law")
            for name in ("slip_distance", *law.set_by_expansion):
                del own[name]
            found |= own
        return found


_SECOND = ("second_shear_modulus", "second_poisson_ratio", "second_height", "second_far_side")
"""Parameters that a rigid second body does not have."""
