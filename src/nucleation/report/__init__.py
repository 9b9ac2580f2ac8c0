"""The report: one HTML file that holds everything a reader needs and works without a network.

:func:`.page.build` puts it together from datasets, figures and captions. What can be moved in the
page is computed there: the theory's curve by ``theory.js``, ``stability.js`` and ``explorer.js``.
Plotly draws; ``page.js`` and ``plots.js`` have what the page's parts share.

:mod:`.calculator` is another page, of a fault's lengths alone, by the same code.
"""

from ..datasets.installed import require

require("report")
