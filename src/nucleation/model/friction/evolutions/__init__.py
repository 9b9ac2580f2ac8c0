"""The evolution laws of the state variable, one file each; its name is the law's name.

Each file has three functions of ``omega = phi w / D`` and ``rate = w / D`` (1/s):

    growth(omega)     dphi/dt = g(omega), with g(1) = 0 and g'(1) = -1
    slope(omega)      g'(omega)
    implicit_log_state(history, step, rate)
                      psi = log(phi) of psi = history + step dpsi/dt(psi, rate), and dpsi/drate (s);
                      history is the part of psi that follows from earlier steps, step (s) the time
                      step times the coefficient of the time scheme

They use this module and nothing else of the project.
"""

from ....types import Array


def wright_omega(z: Array) -> Array:
    """The positive solution of ``w + log(w) = z`` for real z.

    A simulation compiles :func:`nucleation.simulation.passes.wright_omega` in its place.
    """
    from scipy.special import wrightomega  # not loaded by what reads the parameters alone

    return wrightomega(z)
