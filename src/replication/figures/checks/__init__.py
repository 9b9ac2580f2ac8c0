"""Figures that show why to believe the solver.

One module each, with a function ``draw``.
"""
