"""The cost of a step, a run, a refined mesh and the workflow: ``make bench``, on one core.

Measurements that are compared take turns, block after block, and the fastest block of each counts:
other work on the machine makes blocks slower, never faster.
"""
