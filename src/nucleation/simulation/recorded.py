"""Variables that a simulation may record. This module does not load the solver."""

from ..datasets.variables import declared

RECORDED = declared("""
    time | s | time | t
    x | m | position along the interface, from the left edge | x
    slip_rate | m/s | slip rate | v
    slip | m | slip | epsilon
    state | s | state variable (age) of the interface | phi
    shear_stress | Pa | shear stress at the interface | tau
    sigma_yy | Pa | normal stress at the interface, negative in compression | sigma_yy
    step_time | s | time at the end of the step | t
    step_size | s | time step | dt
    driving_force | N/m | force per depth that loads the fault | f_d
    maximal_slip_rate | m/s | maximal slip rate | max v
    fastest_position | m | position of the maximal slip rate | x
    elastic_energy | J/m | elastic energy per depth at the end, since the start
    kinetic_energy | J/m | kinetic energy per depth at the end, since the start
    work | J/m | work per depth of the driven edge and the loads, since the start
    friction_work | J/m | energy per depth that friction dissipated since the start
    newton_iterations | 1 | Newton iterations of the step
""")
