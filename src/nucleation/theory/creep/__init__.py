"""Linear stability of a patch that creeps, from the theory's transfer functions alone.

The patch ``0 < x < L`` is driven at ``x = 0`` and stuck beyond its front L. Its slip is expanded in
modes that fit both ends, between given bodies (:mod:`.response`), and the creep itself follows from
the loading. Small perturbations of it obey an eigenproblem (:mod:`.linearised`) for patches of any
length (:mod:`.patches`). The shortest patch with a growing oscillating mode has the stability
length L_s (:mod:`.lengths`); in thin layers it is one equation. The
fracture energy of the front, the time at which the patch has a length, and L_s with the front are
in :mod:`.front`. The derivation is in ``docs/creeping_patch.md``.
"""
