"""One simulation: a fault with its block, mesh, steps, perturbation, heterogeneity and record."""
