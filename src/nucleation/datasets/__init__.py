"""Files written whole or not at all: netCDF, the table of variables, where a result is from.

It uses nothing of the project.
"""
