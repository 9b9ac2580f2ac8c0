"""Files written whole or not at all, what variables are, where a result is from; what is installed.

It uses nothing of the project.
"""
