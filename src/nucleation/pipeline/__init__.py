"""What surrounds a computation: jobs, their stores, views of results, checks, archives.

It may use every other wing but the command line.
"""
