"""What is asked of a fault: all lengths in use, with the error of its numbers, and backwards.

They stand on the linear theory (:mod:`nucleation.theory`) and that of the creeping patch.
"""
