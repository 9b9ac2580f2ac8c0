"""Why to believe the solver: manufactured solutions, dispersion, an independent solver.

It uses every wing but those of figures, claims, the report and the workflow.
"""
