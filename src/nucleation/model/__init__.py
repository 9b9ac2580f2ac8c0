"""The parts of a simulation: quantities with unit and range, materials, friction, parameters.

The package uses nothing of the project but :mod:`nucleation.types`.
"""
