"""What a simulation is made of: quantities with unit and range, materials, friction, parameters.

It uses nothing of the project but :mod:`nucleation.types`.
"""
