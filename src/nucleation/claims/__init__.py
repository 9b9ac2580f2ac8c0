"""Every quantitative statement of the paper, our number for it, and the verdict (docs/claims.md).

- :mod:`.said` and :mod:`.claim`: what is said, a claim, and the rule of verdicts;
- :mod:`.evidence`: the datasets they stand on, and what they ask of a simulation;
- :mod:`.statements`: the claims, by subject;
- :mod:`.independent`: the paper's formulas as printed, and evaluations that use none of them;
- :mod:`.table`: the table as JSON, CSV and Markdown.
"""
