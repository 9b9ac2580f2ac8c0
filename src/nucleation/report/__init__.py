"""The report: one HTML file that holds everything a reader needs and works without a network.

:func:`.page.build` puts it together from datasets, figures and captions. The lengths of any fault
are computed in the page, by ``theory.js``, ``stability.js`` and ``lengths.js``, as in the page of
:mod:`.calculator`, which has nothing else.
"""

from ..installed import require

require("report")
