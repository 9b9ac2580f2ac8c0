"""Formulas of the time integration and the ladder of its step sizes; other integrators go here.

It uses nothing of the project but :mod:`nucleation.types`.
"""
