"""The parts of a simulation: quantities with unit and range, materials, friction, parameters.

The wing uses nothing of the project but :mod:`nucleation.types`.
"""
