"""How long must a slipping patch of a frictional fault grow before it runs away?

Linear stability theory (:mod:`nucleation.theory`), an inertial finite-element simulation
(:mod:`nucleation.simulation.run`) and the extraction of the critical nucleation length
(:mod:`nucleation.extraction.extraction`) after Aldam et al. (2017).
"""

__version__ = "0.1.0"
