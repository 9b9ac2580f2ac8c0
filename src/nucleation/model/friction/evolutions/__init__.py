"""The evolution laws of the state variable, one file each; its name is the law's name.

They use :mod:`nucleation.model.friction.evolution` and nothing else of the project.
"""
