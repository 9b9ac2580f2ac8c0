"""The report: one HTML file with everything that a reader needs, which works without a network.

:func:`.page.build` makes it from datasets, figures and captions. The page computes the lengths of
any fault with ``theory.js``, ``stability.js`` and ``lengths.js``. The page of :mod:`.calculator`
has only that part.
"""

from nucleation.installed import require

require("report")
