"""Every quantitative statement of the paper, our number for it, and the verdict (docs/claims.md).

- :mod:`.said` and :mod:`.claim`: what is said, a claim, and the rule of verdicts;
- :mod:`.evidence`: the datasets they stand on, with :mod:`.measure` for simulations;
- :mod:`.sliding`, :mod:`.bimaterial`, :mod:`.finite_height`, :mod:`.friction_law`,
  :mod:`.simulations` and :mod:`.course`: the claims, by subject;
- :mod:`.printed`, :mod:`.elastic_layers`, :mod:`.marginal`: the paper's formulas as printed, and
  evaluations that use none of them;
- :mod:`.table`: the table as JSON, CSV and Markdown.
"""
