"""Files written whole or not at all: netCDF, what variables are, where a result is from.

It uses nothing of the project.
"""
