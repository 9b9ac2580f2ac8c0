"""Every quantitative statement of the paper, our number for it, and the verdict (docs/claims.md).

- ``claims.yaml``: the statements;
- :mod:`.theory`, :mod:`.simulations`, :mod:`.pairs`: our numbers, by subject;
- :mod:`.evidence`: the datasets that they are read from; :mod:`.printed`: the paper's formulas;
- :mod:`.verdicts`: the numbers that a statement allows, and the rule of the verdicts;
- :mod:`.changes`: what a verdict on runs is tried with, and the least change that flips it;
- :mod:`.table`: the table of all claims, and the article.
"""
