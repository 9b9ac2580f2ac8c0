"""Linear stability of a patch that creeps, from the theory's transfer functions alone.

The patch ``0 < x < L`` is driven at ``x = 0`` and stuck beyond its front L. Its slip is expanded in
modes that know both ends, the creep itself follows from the loading (both in
:mod:`.modes`), and small perturbations of it obey an eigenproblem (:mod:`.linearised`). The
shortest patch with a growing oscillating mode is the stability length L_s (:mod:`.lengths`); in
thin layers it is one equation (:mod:`.thin`). What the front costs, and with it the time at which
the patch has a length, is in :mod:`.front`. The derivation is in ``docs/creeping_patch.md``.
"""
