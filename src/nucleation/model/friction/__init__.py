"""Friction: the law, the evolution of its state, and the constants of its expansion.

It uses :mod:`nucleation.model.quantities`.
"""
