"""Every quantitative statement of the paper, our number for it, and the verdict (docs/claims.md).

- ``claims.yaml``: the statements;
- :mod:`.theory`, :mod:`.friction`, :mod:`.simulations`, :mod:`.pairs`: our numbers, by subject;
- :mod:`.evidence`: the datasets that they are read from; :mod:`.printed`: the paper's formulas;
- :mod:`.expected`: the numbers that a statement allows, and the rule of the verdicts;
- :mod:`.table`, :mod:`.article`: the table and the article.
"""
