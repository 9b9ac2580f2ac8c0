"""Answers about a fault: every length with its range, or the reason why there is none.

They are based on the law of the drop (:mod:`nucleation.drop`), the theory of homogeneous sliding
and of the creeping patch (:mod:`nucleation.theory`), and the literature
(:mod:`nucleation.lengths`).
"""
