// The search has theory and glossary first and the reference of single functions last.
const FIRST = { which_length: 40, theory: 40, creeping_patch: 30, drop: 30, conventions: 20 };

var Scorer = { // var: Sphinx looks for it among the globals
  score: ([docname, , , , score]) => score + (FIRST[docname] ?? 0) - (docname.startsWith("generated/") ? 30 : 0),
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
