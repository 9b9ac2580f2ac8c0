"""How fast it is: ``make bench``, one core, everything measured in one run.

:mod:`.steps` and :mod:`.runs` measure the solver, :mod:`.scale` and :mod:`.batched` what surrounds
thousands of runs, :mod:`.overhead` what a run costs beside its steps, :mod:`.replay` how right the
time left was.
Times of what is compared are taken in turn, block after block, and the fastest block of each
counts: other work on the machine makes blocks slower, never faster.
"""
