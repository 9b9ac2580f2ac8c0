"""The workflow: recipes of results, jobs, stores, views of results, checks and archives.

This wing may import every other wing except the command line.
"""
