"""What surrounds a computation: a job, its progress, the cache, checks, archives.

It may use every other wing but the command line.
"""
