"""Unit, long name and paper symbol of every variable of the datasets, in one table."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import xarray as xr


class DatasetError(ValueError):
    """A dataset has an unknown variable, or a file is damaged, incomplete or foreign."""


class Variable(NamedTuple):
    """Metadata of one variable: unit ("1" if dimensionless, "" for text), name, paper symbol."""

    units: str
    long_name: str
    symbol: str = ""


VARIABLES: dict[str, Variable] = {
    # Simulation: coordinates and fields along the interface
    "time": Variable("s", "time", "t"),
    "x": Variable("m", "distance from the loaded edge", "x"),
    "y": Variable("m", "distance from the interface", "y"),
    "slip_rate": Variable("m/s", "slip rate", "v"),
    "slip": Variable("m", "slip", "epsilon"),
    "state": Variable("s", "state variable (age) of the interface", "phi"),
    "shear_stress": Variable("Pa", "shear stress at the interface", "tau"),
    "normal_stress": Variable(
        "Pa", "normal stress at the interface, negative in compression", "sigma_yy"
    ),
    # Simulation: one value per step
    "step_time": Variable("s", "time at the end of the step", "t"),
    "step_size": Variable("s", "time step", "dt"),
    "driving_force": Variable("N/m", "force per depth on the loaded edge", "f_d"),
    "maximal_slip_rate": Variable("m/s", "maximal slip rate", "max v"),
    "newton_iterations": Variable("1", "Newton iterations of the step"),
    "perturbation": Variable("1", "declared relative perturbation, as realised", "eps xi"),
    # Simulation: snapshots in the bulk
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
    # Film of a run
    "block_shear_stress": Variable("Pa", "shear stress in the block", "sigma_xy"),
    # Table of nucleation lengths, one row per simulation
    "id": Variable("", "name of the simulation"),
    "study": Variable("", "study of the configuration"),
    "law": Variable("", "state evolution law"),
    "height": Variable("m", "block height", "H"),
    "phi0": Variable("s", "initial state variable", "phi0"),
    "n_x": Variable("1", "number of elements along x", "N_x"),
    "n_y": Variable("1", "number of elements along y", "N_y"),
    "onset_time": Variable("s", "onset of the event", "t"),
    "onset_time_low": Variable("s", "earliest onset over the definitions of the drop", "t"),
    "onset_time_high": Variable("s", "latest onset over the definitions of the drop", "t"),
    "length": Variable("m", "critical nucleation length from the simulation", "L_c"),
    "length_low": Variable("m", "smallest length over the definitions", "L_c"),
    "length_high": Variable("m", "largest length over the definitions", "L_c"),
    "theory_length": Variable("m", "critical nucleation length of the linear theory", "L_c"),
    "block_length": Variable("m", "length of the block", "L"),
    "grading": Variable("1", "largest over smallest element along y"),
    "tolerance": Variable("1", "tolerance of the local error per step"),
    "longest_step": Variable("1", "longest time step over the memory time D/V"),
    "density": Variable("kg/m^3", "mass density", "rho"),
    "slip_distance": Variable("m", "characteristic slip distance", "D"),
    "applied_stress": Variable("Pa", "compressive stress on the top", "sigma0"),
    "shear_modulus": Variable("Pa", "shear modulus", "mu"),
    "poisson_ratio": Variable("1", "Poisson's ratio", "nu"),
    "friction_coefficient": Variable("1", "friction coefficient of the theory's interface", "f"),
    "friction_law": Variable("", "law of the friction coefficient"),
    "below": Variable("", "what the block slides on"),
    "initial_stress": Variable("", "static field at the start"),
    "initial_shear_stress": Variable("Pa", "shear stress at the start, if it is uniform", "tau0"),
    "simulated_time": Variable("s", "time at the end of the run", "t"),
    "reached_length": Variable(
        "m", "patch length at the onset, or at the end of a run without an event", "L(t)"
    ),
    "status": Variable("", "how the simulation ended"),
    "steps": Variable("1", "number of time steps"),
    "wall_seconds": Variable("s", "wall time of the simulation"),
    "peak_megabytes": Variable("1", "largest memory of the simulation (megabytes)"),
    # Two deformable bodies
    "far_side": Variable("", "far side of the second body"),
    "second_height": Variable("m", "height of the second body", "H2"),
    "second_shear_modulus": Variable("Pa", "shear modulus of the second body", "mu2"),
    "second_poisson_ratio": Variable("1", "Poisson's ratio of the second body", "nu2"),
    "friction": Variable("1", "friction coefficient of steady sliding at V", "f"),
    "second_n_y": Variable("1", "number of elements along y of the second body", "N_y2"),
    "length_ratio": Variable("1", "length at the drop over that of the theory", "L/L_c"),
    "half_space_ratio": Variable(
        "1", "Eq. (9): half-spaces over those without contrast", "L_c/L_c^M"
    ),
    # Declared perturbations, and the drop that they make
    "kind": Variable("", "what is perturbed"),
    "strength": Variable("1", "relative strength of the declared perturbation", "eps"),
    "seed": Variable("1", "seed of its realisation"),
    "realisations": Variable("1", "number of realisations"),
    "correlation_length": Variable("m", "its correlation length along x"),
    "predicted_length": Variable("m", "length at the drop by the law, median", "L_d"),
    "predicted_low": Variable("m", "length by which 16 % have dropped by the law", "L_d"),
    "predicted_high": Variable("m", "length by which 84 % have dropped by the law", "L_d"),
    "closed_form_length": Variable("m", "length at the drop by the law in one line", "L_d"),
    "effective_strength": Variable("1", "strength in the law's one line", "eps_eff"),
    "realised_length": Variable("m", "length at the drop by the law for its own seed", "L_d"),
    "floor_normal_load": Variable("1", "strength of the load at which the law drops there"),
    "floor_state": Variable("1", "strength of the state at which the law drops there"),
    # The oscillating mode along a quiet run, and how forcings stir its amplitude
    "mode_time": Variable("s", "time at which the patch is frozen", "t"),
    "mode_length": Variable("m", "length of the creep patch", "L(t)"),
    "mode_rate": Variable("1/s", "growth and angular frequency of the oscillating mode", "Lambda"),
    "mode_normal_load": Variable("1/s", "weight of a relative change of the load", "g"),
    "mode_drive": Variable("1/(m s)", "weight of a displacement of the driven edge", "g"),
    "mode_strength": Variable("1/s", "weight of a relative change of friction at a node", "g"),
    "mode_state": Variable("1", "weight of a source of log(phi) at a node", "g"),
    # Stability of the frozen patch along a simulation
    "instant_time": Variable("s", "time at which the patch is frozen", "t"),
    "patch_length": Variable("m", "length of the creep patch", "L(t)"),
    "growth_rate": Variable("1/s", "fastest growth of the frozen patch", "max Re Lambda"),
    "growth_frequency": Variable("1/s", "angular frequency of that mode", "|Im Lambda|"),
    "stability_length": Variable("m", "patch length where growth begins", "L_s"),
    "creep_length": Variable("m", "L_s by theory, steady creep with constant a and b", "L_s"),
    "front_length": Variable("m", "L_s by theory, with the advancing front", "L_s"),
    "front_frequency": Variable("1/s", "angular frequency there, by theory", "omega"),
    "front_time": Variable("s", "time at which the patch has that length, by theory", "t"),
    "curve_ratio": Variable("1", "weakening over direct effect", "zeta/a"),
    "curve_length": Variable("1", "L_s over L_c of a thin layer", "L_s/L_c"),
    "shown_beta": Variable("1", "friction times bimaterial contrast", "f beta"),
    "shown_x": Variable("1", "distance from the edge over L_s", "x/L_s"),
    "shown_rate": Variable("1", "slip rate of the creep over V", "v/V"),
    "shown_stress": Variable("1", "compression over the applied one", "sigma/sigma0"),
    "stability_length_low": Variable("m", "L_s less the scatter as the front hops", "L_s"),
    "stability_length_high": Variable("m", "L_s with the scatter as the front hops", "L_s"),
    "stability_length_error": Variable("m", "standard error of L_s", "L_s"),
    "stability_frequency": Variable("1/s", "angular frequency where growth begins", "omega"),
    "stability_ratio": Variable("1", "patch length where growth begins over theory", "L_s/L_c"),
    "stability_change": Variable("1", "L_s over that of the converged run, minus one"),
    "oscillation_growth": Variable("1/s", "growth of the patch's oscillating mode", "Re Lambda"),
    "oscillation_frequency": Variable("1/s", "angular frequency of that mode", "Im Lambda"),
    "mode_real": Variable("1", "slip in that mode where growth begins, real part"),
    "mode_imaginary": Variable("1", "slip in that mode where growth begins, imaginary part"),
    # Twin runs: a kick of the patch followed in time, beside the frozen patch
    "twin_time": Variable("s", "time of the kick", "t"),
    "twin_length": Variable("m", "mean patch length while the kick is followed", "L(t)"),
    "twin_length_first": Variable("m", "patch length at the kick", "L(t)"),
    "twin_length_last": Variable("m", "patch length at the end", "L(t)"),
    "twin_growth": Variable("1/s", "growth rate of the kick", "Re Lambda"),
    "twin_frequency": Variable("1/s", "angular frequency of the kick", "Im Lambda"),
    "frozen_growth": Variable("1/s", "mean growth rate of the frozen patch", "Re Lambda"),
    "frozen_frequency": Variable("1/s", "mean frequency of the frozen patch", "Im Lambda"),
    # Refinement of mesh and steps, and the hops of the front
    "length_change": Variable("1", "relative change of L_c against the base"),
    "length_difference": Variable("1", "relative difference of L_c from the finest run"),
    "elements_difference": Variable("1", "the same in elements of the run along x"),
    "onset_difference": Variable("1", "relative difference of the onset from the finest run"),
    "length_over_theory": Variable("1", "critical length over that of the linear theory"),
    "hop_time": Variable("s", "time at which the front reaches the node", "t"),
    "hop_length": Variable("m", "position of the node", "x"),
    "hop_frequency": Variable("1/s", "angular frequency of the hops", "2 pi (dL/dt)/dx"),
    "inner_slip_rate": Variable("m/s", "slip rate half-way along the patch", "v"),
    "sample_time": Variable("s", "middle of the window of the amplitude", "t"),
    "oscillation_amplitude": Variable("m/s", "amplitude of the slip rate about its trend"),
    # Sensitivity to parameters and definitions
    "varied": Variable("", "parameter or definition that is varied"),
    "variation": Variable("", "how it is varied"),
    "ratio_change": Variable("1", "relative change of L_c over the theory's length"),
    "onset_change": Variable("1", "relative change of the onset time"),
    # Theory
    "critical_length": Variable("m", "critical nucleation length", "L_c"),
    "critical_wavenumber": Variable("1/m", "critical wavenumber", "k_c"),
    "critical_frequency": Variable("1/s", "angular frequency at the critical wavenumber", "omega"),
    "thin_limit_length": Variable("m", "critical nucleation length for Hk -> 0", "L_c"),
    "f_beta": Variable("1", "friction coefficient times bimaterial contrast", "f beta"),
    "zeta_over_a": Variable("1", "velocity weakening over direct effect", "zeta/a"),
    "bimaterial_length_ratio": Variable(
        "1", "critical length of a bimaterial interface over L_c^M", "L_c/L_c^M"
    ),
    "steady_friction": Variable("1", "steady-state friction, full law", "f"),
    "steady_friction_logarithmic": Variable("1", "steady-state friction, logarithmic law", "f"),
    "friction_reference": Variable("1", "friction coefficient at V", "f0"),
    "direct_effect": Variable("1", "direct effect at V", "a"),
    "velocity_weakening": Variable("1", "velocity weakening at V", "zeta"),
    "velocity": Variable("m/s", "imposed velocity", "V"),
    # Dispersion: modes of homogeneous sliding, measured and by Eq. (5)
    "mode_wavenumber": Variable("1/m", "wavenumber of the seeded mode", "k"),
    "measured_growth": Variable("1/s", "growth rate in the time integration", "Re Lambda"),
    "measured_frequency": Variable("1/s", "angular frequency in the time integration", "Im Lambda"),
    "theory_growth": Variable("1/s", "growth rate of the seeded mode, Eq. (5)", "Re Lambda"),
    "theory_frequency": Variable(
        "1/s", "angular frequency of the seeded mode, Eq. (5)", "Im Lambda"
    ),
    "curve_wavenumber": Variable("1/m", "wavenumber of the theory's curve", "k"),
    "curve_growth": Variable("1/s", "growth rate, Eq. (5)", "Re Lambda"),
    "curve_frequency": Variable("1/s", "angular frequency, Eq. (5)", "Im Lambda"),
    "memory_time": Variable("s", "time over which friction forgets at V", "D/V"),
    # The same runs by an independent solver, FreeFem++
    "factorisations": Variable("1", "factorised matrices of the step"),
    "elapsed_time": Variable("s", "processor time since the start of the run"),
    "onset_time_freefem": Variable("s", "onset of the event, by FreeFem++", "t"),
    "length_freefem": Variable("m", "critical nucleation length, by FreeFem++", "L_c"),
    "patch_length_rms": Variable("1", "relative difference of L(t), root mean square"),
    "patch_length_largest": Variable("1", "relative difference of L(t), largest"),
    "patch_length_elements": Variable("1", "largest difference of L(t) over the element's length"),
    "driving_force_rms": Variable("1", "relative difference of f_d(t), root mean square"),
    "driving_force_largest": Variable("1", "relative difference of f_d(t), largest"),
    "step_seconds": Variable("s", "processor time of a step, median"),
    "step_seconds_freefem": Variable("s", "processor time of a step of FreeFem++, median"),
    "steps_freefem": Variable("1", "number of time steps of FreeFem++"),
    # Orders of convergence on manufactured solutions
    "problem": Variable("", "elastodynamics alone, or with friction by an evolution law"),
    "refinement": Variable("", "what is refined from level to level"),
    "element_size": Variable("m", "length of the elements along x", "h"),
    "quasi_static_step_size": Variable("s", "time step of quasi-static fields", "dt"),
    "displacement_error": Variable("1", "error of the displacement over its scale"),
    "slip_rate_error": Variable("1", "error of the slip rate over V"),
    "log_state_error": Variable("1", "error of the log of the state variable"),
}


def annotate(dataset: xr.Dataset) -> xr.Dataset:
    """A copy of the dataset whose every variable carries units, long_name and symbol.

    Raises
    ------
    DatasetError
        If a variable is not in :data:`VARIABLES`.
    """
    unknown = sorted(str(name) for name in dataset.variables if name not in VARIABLES)
    if unknown:
        raise DatasetError(f"not in the table of variables (nucleation.datasets.netcdf): {unknown}")
    annotated = dataset.copy()
    for name in dataset.variables:
        entry = VARIABLES[str(name)]
        attributes = {k: text for k, text in entry._asdict().items() if text}
        annotated[name].attrs.update(attributes)
    return annotated
