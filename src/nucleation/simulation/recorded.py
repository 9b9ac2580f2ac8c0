"""Variables that a simulation may record. This module does not load the solver."""

from ..datasets.variables import Column, columns

X = Column("x", "m", "position along the interface, from the left edge", "x")
SLIP_RATE = Column("slip_rate", "m/s", "slip rate", "v")

RECORDED = columns(
    Column("time", "s", "time", "t"),
    X,
    SLIP_RATE,
    Column("slip", "m", "slip", "epsilon"),
    Column("state", "s", "state variable (age) of the interface", "phi"),
    Column("shear_stress", "Pa", "shear stress at the interface", "tau"),
    Column("sigma_yy", "Pa", "normal stress at the interface, negative in compression", "sigma_yy"),
    Column("step_time", "s", "time at the end of the step", "t"),
    Column("step_size", "s", "time step", "dt"),
    Column("driving_force", "N/m", "force per depth that loads the fault", "f_d"),
    Column("maximal_slip_rate", "m/s", "maximal slip rate", "max v"),
    Column("fastest_position", "m", "position of the maximal slip rate", "x"),
    Column("elastic_energy", "J/m", "elastic energy per depth at the end, since the start"),
    Column("kinetic_energy", "J/m", "kinetic energy per depth at the end, since the start"),
    Column("work", "J/m", "work per depth of the driven edge and the loads, since the start"),
    Column("friction_work", "J/m", "energy per depth that friction dissipated since the start"),
    Column("newton_iterations", "1", "Newton iterations of the step"),
)
