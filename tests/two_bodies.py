"""Single systems of two given bodies, for tests of the linear theory."""

import dataclasses
from typing import NamedTuple

import numpy as np

from nucleation.fault import Fault
from nucleation.model.material import ANTIPLANE, Material
from nucleation.run.run import PAPER_RUN
from nucleation.theory import critical, spectrum
from nucleation.theory.pair import LayerPair, Layers


@dataclasses.dataclass(frozen=True)
class Interface:
    """Friction linearised about steady sliding (SI units); by default that of the main text."""

    friction: float = 0.41
    a: float = 0.0068
    zeta: float = 0.016
    slip_length: float = 5.0e-7
    velocity: float = 1.0e-5
    normal_stress: float = 1.0e6


class Body(NamedTuple):
    """A body beside the interface; half-spaces and layers of one material."""

    material: Material = PAPER_RUN.upper.material
    height: float = np.inf
    far_side: str = "velocity"

    @property
    def layers(self):
        material = self.material
        return Layers(
            np.array(material.shear_modulus),
            np.array(material.in_plane_ratio),
            np.array(float(self.height)),
            self.far_side,
            material.plane == ANTIPLANE,
        )


class Rigid(NamedTuple):
    """A body that does not deform."""

    @property
    def layers(self):
        return None


RIGID = Rigid()


def pair(upper, lower):
    return LayerPair(upper.layers, lower.layers)


def system(upper, lower, interface):
    """One system, with fields of shape (1,)."""
    bodies = pair(upper, lower)
    assert bodies.deformable
    bodies = bodies.at(np.newaxis)
    return spectrum.Systems(
        bodies,
        np.array([interface.friction]),
        np.array([interface.a]),
        np.array([interface.zeta]),
        bodies.modulus * interface.slip_length / interface.normal_stress,
        np.array([interface.velocity / interface.slip_length]),
    )


def transfer_functions(k, upper, lower):
    """G1 and G2, shape of k."""
    k = np.asarray(k, dtype=float)
    found = pair(upper, lower).transfer_functions(np.ravel(k))
    return tuple(value.reshape(k.shape)[()] for value in found)


def growth_rates(k, upper, lower, interface):
    """Both roots, shape (2,) and that of k."""
    k = np.asarray(k, dtype=float)
    found = system(upper, lower, interface).growth_rates(np.ravel(k))
    return found.reshape(2, *k.shape)


def critical_wavenumber(upper, lower, interface):
    found = critical.unstable_modes(system(upper, lower, interface))
    return critical.CriticalMode(*(float(value[0]) for value in found))


def critical_lengths(cases):
    """L_c (m) of each system, NaN where sliding is stable."""
    k = [critical.largest_crossings(system(*case))[0] for case in cases]
    return 2.0 * np.pi / np.array(k)


def critical_length(height, material, interface):
    """L_c (m) of a block on a rigid base."""
    return fault_of(material, interface).replace(height=height).critical_length()


def fault_of(material, interface):
    """A half-space on a rigid body, with this friction."""
    return Fault(
        shear_modulus=material.shear_modulus,
        poisson_ratio=material.poisson_ratio,
        plane=material.plane,
        second_shear_modulus=np.inf,
        slip_distance=interface.slip_length,
        **{k: x for k, x in dataclasses.asdict(interface).items() if k != "slip_length"},
    )
