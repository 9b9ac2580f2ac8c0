"""Methods of a fault as functions of its parameters, for tests of many faults."""

from nucleation.api import Fault
from nucleation.lengths.in_use import values_of
from nucleation.run.derived import drop_of_run

ROCK = {
    "shear_modulus": 30e9,
    "poisson_ratio": 0.25,
    "normal_stress": 50e6,
    "a": 0.010,
    "b": 0.015,
    "slip_distance": 5e-6,
}
GRANITE = {
    "shear_modulus": 30e9,
    "poisson_ratio": 0.25,
    "normal_stress": 6e6,
    "a": 0.008,
    "b": 0.012,
    "slip_distance": 1e-6,
    "height": 0.1,
}


def _method(name):
    return lambda **fault: getattr(Fault(**fault), name)()


critical_length = _method("critical_length")
critical_mode = _method("critical_mode")
stability_length = _method("stability_length")
runaway_length = _method("runaway_length")


def spectrum(wavenumber, **fault):
    return Fault(**fault).spectrum(wavenumber)


def transfer_functions(wavenumber, **fault):
    neutral = {"normal_stress": 1e6, "a": 0.01, "slip_distance": 1e-6, "friction": 0.0}
    if not {"zeta", "b"} & fault.keys():
        neutral["zeta"] = 0.01
    return Fault(**neutral | fault).transfer_functions(wavenumber)


def weakening_patch_length(outside_zeta, outside_a=None, **fault):
    return Fault(**fault).weakening_patch_length(outside_zeta, outside_a)


def specimen_fit(unknown, length, criterion="critical", within=None, **fault):
    middle = {"normal_stress": 1e6, "slip_distance": 1e-6, "shear_modulus": 1e9}
    sought = unknown if unknown in middle else "normal_stress"
    given = {sought: middle[sought]} | fault
    return Fault(**given).specimen(unknown, length, criterion, within)


def lengths(weakening_rate=None, **fault):
    """All lengths but L_run and L, those of the literature too."""
    found = Fault(**fault).lengths("none", weakening_rate=weakening_rate)
    return type(found)(found | found.literature)


def lengths_in_use(weakening_rate=None, **fault):
    """Lengths of the literature by key, also those for two materials where there is one."""
    return values_of(Fault(**fault), weakening_rate)


expected_drop = drop_of_run
CRITERIA = {"critical_length": critical_length, "stability_length": stability_length}
