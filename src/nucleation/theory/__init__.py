"""Linear stability of homogeneous frictional sliding and the critical nucleation length.

For a pair of elastic bodies (:mod:`.stiffness`) and a linearised rate-and-state interface
(:mod:`.spectrum`) the critical nucleation length is ``L_c = 2 pi / k_c`` with k_c the largest
marginally stable wavenumber (:mod:`.critical`). Special systems: :mod:`.closed_forms`; the
conventional approach and other lengths: :mod:`nucleation.lengths.in_use`.
"""
