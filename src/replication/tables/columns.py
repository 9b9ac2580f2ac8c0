"""Columns that several tables have: what a run is, its cost, and what theory predicts for it.

A column of one table alone is declared where that table is made, and a measured one in
:mod:`nucleation.extraction.definitions`. Columns of tables with realisations have a rule for them.
"""

import numpy as np

from nucleation.datasets.variables import Column, first

# -- the run ------------------------------------------------------------------------------------

ID = Column("id", "", "name of the simulation", realisations=first)
STUDY = Column("study", "", "study of the configuration", realisations=first)
ROLE = Column("role", "", "what the study is for", realisations=first)
FAULT = Column("fault", "", "digest of all that the fault's physics depends on", realisations=first)
ENSEMBLE = Column(
    "ensemble", "", "digest of all that the run is given but its seed", realisations=first
)

# -- the fault ----------------------------------------------------------------------------------

EVOLUTION = Column("evolution", "", "state evolution law", realisations=first)
FRICTION_LAW = Column("friction_law", "", "law of the friction coefficient", realisations=first)
HEIGHT = Column("height", "m", "block height", "H", realisations=first)
BELOW = Column("below", "", "what the block slides on", realisations=first)
FAR_SIDE = Column("far_side", "", "far side of the second body", realisations=first)
SECOND_HEIGHT = Column("second_height", "m", "height of the second body", "H2", realisations=first)
SHEAR_MODULUS = Column("shear_modulus", "Pa", "shear modulus", "mu", realisations=first)
SECOND_SHEAR_MODULUS = Column(
    "second_shear_modulus", "Pa", "shear modulus of the second body", "mu2", realisations=first
)
POISSON_RATIO = Column("poisson_ratio", "1", "Poisson's ratio", "nu", realisations=first)
SECOND_POISSON_RATIO = Column(
    "second_poisson_ratio", "1", "Poisson's ratio of the second body", "nu2", realisations=first
)
PLANE = Column("plane", "", "plane of deformation, strain or stress", realisations=first)
NORMAL_STRESS = Column(
    "normal_stress", "Pa", "compressive stress on the top", "sigma0", realisations=first
)
VELOCITY = Column("velocity", "m/s", "imposed velocity", "V", realisations=first)
SLIP_DISTANCE = Column(
    "slip_distance", "m", "characteristic slip distance", "D", realisations=first
)
FRICTION = Column(
    "friction", "1", "friction coefficient of steady sliding at V", "f", realisations=first
)
A = Column("a", "1", "direct effect at V", "a", realisations=first)
ZETA = Column("zeta", "1", "velocity weakening at V", "zeta", realisations=first)
ZETA_OVER_A = Column(
    "zeta_over_a", "1", "velocity weakening over direct effect", "zeta/a", realisations=first
)
F_BETA = Column(
    "f_beta", "1", "friction coefficient times bimaterial contrast", "f beta", realisations=first
)
WIDTH = Column("width", "m", "width of the change along the interface, of a bump half-way", "W")
INITIAL_STATE = Column("initial_state", "s", "initial state variable", "phi0", realisations=first)

# -- its perturbation ---------------------------------------------------------------------------

KIND = Column("kind", "", "perturbed quantity", realisations=first)
STRENGTH = Column(
    "strength", "1", "relative strength of the declared perturbation", "eps", realisations=first
)
SEED = Column("seed", "1", "seed of its realisation", realisations=first)
CORRELATION_LENGTH = Column(
    "correlation_length", "m", "its correlation length along x", realisations=first
)

# -- mesh and steps -----------------------------------------------------------------------------

BLOCK_LENGTH = Column("block_length", "m", "length of the block", "L", realisations=first)
N_X = Column("n_x", "1", "number of elements along x", "N_x", realisations=first)
N_Y = Column("n_y", "1", "number of elements along y", "N_y", realisations=first)
GRADING = Column("grading", "1", "largest over smallest element along y", realisations=first)
TOLERANCE = Column("tolerance", "1", "tolerance of the local error per step", realisations=first)
LONGEST_STEP = Column(
    "longest_step", "1", "longest time step over the memory time D/V", realisations=first
)

# -- how the run went ---------------------------------------------------------------------------

STATUS = Column("status", "", "how the simulation ended", realisations=first)
STEPS = Column("steps", "1", "number of time steps", realisations=first)
WALL_SECONDS = Column("wall_seconds", "s", "wall time of the simulation", realisations=first)
PEAK_MEGABYTES = Column(
    "peak_megabytes", "Mbyte", "largest memory of the simulation", realisations=first
)
SIMULATED_TIME = Column(
    "simulated_time", "s", "time at the end of the run", "t", realisations=first
)
REACHED_LENGTH = Column(
    "reached_length",
    "m",
    "patch length at the onset, or at the end of a run without an event",
    "L(t)",
    realisations=first,
)

# -- theory -------------------------------------------------------------------------------------

CRITICAL_LENGTH = Column(
    "critical_length", "m", "critical nucleation length", "L_c", realisations=first
)
CRITICAL_WAVENUMBER = Column("critical_wavenumber", "1/m", "critical wavenumber", "k_c")
STABILITY_STATUS = Column(
    "stability_status",
    "",
    "value, or why there is none: stable, beyond or unknown",
    realisations=first,
)
FRONT_LENGTH = Column("front_length", "m", "L_s by theory, with the advancing front", "L_s")
RUNAWAY_LENGTH = Column(
    "runaway_length", "m", "runaway length by theory, NaN where zeta/a > 2", "L_run"
)
RUNAWAY_STATUS = Column(
    "runaway_status", "", "value, or why there is none: stable, beyond or unknown"
)
LAW_LENGTH = Column("law_length", "m", "length at the drop by the law, median", "L")
LAW_LOW = Column("law_low", "m", "length by which 16 % have dropped by the law", "L")
LAW_HIGH = Column("law_high", "m", "length by which 84 % have dropped by the law", "L")
EXPECTED_LENGTH = Column("expected_length", "m", "expected length at the drop", "L")
EXPECTED_LOW = Column("expected_low", "m", "least length at the drop that is expected", "L")
EXPECTED_HIGH = Column("expected_high", "m", "largest length at the drop that is expected", "L")
DOUBT = Column("doubt", "", "why the expected length should not be relied upon")

# -- simulations over theory --------------------------------------------------------------------

LENGTH_RATIO = Column(
    "length_ratio", "1", "length at the drop over that of the theory", "L/L_c", realisations=np.mean
)
STABILITY_RATIO = Column(
    "stability_ratio",
    "1",
    "patch length where growth begins over theory",
    "L_s/L_c",
    realisations=first,
)
REALISATIONS = Column("realisations", "1", "number of realisations")
INSIDE = Column("inside", "1", "number of realisations in the expected range")
