"""Variables that a simulation may record. This module does not load the solver."""

from ..datasets.variables import Variable

RECORDED = {
    "time": Variable("s", "time", "t"),
    "x": Variable("m", "position along the interface, from the left edge", "x"),
    "y": Variable("m", "distance from the interface", "y"),
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
    "newton_iterations": Variable("1", "Newton iterations of the step"),
    "perturbation": Variable("1", "declared relative perturbation, as realised", "eps xi"),
    "snapshot_time": Variable("s", "time of the snapshot", "t"),
    "displacement_x": Variable("m", "displacement along x", "u_x"),
    "displacement_y": Variable("m", "displacement along y", "u_y"),
    "velocity_x": Variable("m/s", "velocity along x", "du_x/dt"),
    "velocity_y": Variable("m/s", "velocity along y", "du_y/dt"),
    "second_y": Variable("m", "position in the second body, negative below the interface", "y"),
    "second_displacement_x": Variable("m", "displacement along x in the second body", "u_x"),
    "second_displacement_y": Variable("m", "displacement along y in the second body", "u_y"),
    "second_velocity_x": Variable("m/s", "velocity along x in the second body", "du_x/dt"),
    "second_velocity_y": Variable("m/s", "velocity along y in the second body", "du_y/dt"),
}
