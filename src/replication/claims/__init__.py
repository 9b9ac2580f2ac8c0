"""Every quantitative statement of the paper, our number for it, and the verdict (docs/claims.md).

- :mod:`.expected` and :mod:`.claim`: the numbers that a statement allows, a claim, and its verdict;
- :mod:`.evidence`: the datasets that the claims are judged by;
- :mod:`.statements`: how our numbers are computed, by subject;
- :mod:`.independent`: the paper's formulas as printed, and evaluations that use none of them;
- :mod:`.table`: the table as JSON, CSV and Markdown;
- :mod:`.article` and :mod:`.printing`: the article as Markdown, LaTeX and PDF.
"""
