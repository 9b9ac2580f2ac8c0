"""Evidence for the solver: manufactured solutions, dispersion, and an independent solver."""
