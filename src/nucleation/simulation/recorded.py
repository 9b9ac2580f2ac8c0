"""Variables that a simulation may record. This module does not load the solver."""

from ..datasets.variables import Variable

RECORDED = {
    "time": Variable("s", "time", "t"),
    "x": Variable("m", "position along the interface, from the left edge", "x"),
    "slip_rate": Variable("m/s", "slip rate", "v"),
    "slip": Variable("m", "slip", "epsilon"),
    "state": Variable("s", "state variable (age) of the interface", "phi"),
    "shear_stress": Variable("Pa", "shear stress at the interface", "tau"),
    "sigma_yy": Variable(
        "Pa", "normal stress at the interface, negative in compression", "sigma_yy"
    ),
    "step_time": Variable("s", "time at the end of the step", "t"),
    "step_size": Variable("s", "time step", "dt"),
    "driving_force": Variable("N/m", "force per depth that loads the fault", "f_d"),
    "maximal_slip_rate": Variable("m/s", "maximal slip rate", "max v"),
    "fastest_position": Variable("m", "position of the maximal slip rate", "x"),
    "elastic_energy": Variable("J/m", "elastic energy per depth at the end, since the start"),
    "kinetic_energy": Variable("J/m", "kinetic energy per depth at the end, since the start"),
    "work": Variable("J/m", "work per depth of the driven edge and the loads, since the start"),
    "friction_work": Variable("J/m", "energy per depth that friction dissipated since the start"),
    "newton_iterations": Variable("1", "Newton iterations of the step"),
}
