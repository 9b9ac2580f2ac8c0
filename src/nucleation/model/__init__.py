"""What a simulation is made of: quantities with unit and range, materials, friction laws, parameters.

It uses nothing of the project.
"""
