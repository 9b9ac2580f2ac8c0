"""What a step costs, a run, a refined mesh, and what surrounds runs: ``make bench``, on one core.

Times of what is compared are taken in turn, block after block, and the fastest block of each
counts: other work on the machine makes blocks slower, never faster.
"""
