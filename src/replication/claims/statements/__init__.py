"""How our number for each statement is computed: one module for each subject of ``claims.yaml``.

A claim's function has the claim's name. Where a function is one line, it is in the module's
``SHORT`` instead.
"""
