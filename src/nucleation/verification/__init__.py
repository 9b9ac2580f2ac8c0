"""Why to believe the solver: manufactured solutions, dispersion, an independent solver."""
