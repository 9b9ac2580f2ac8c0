"use strict";
// Tables that are sorted by a click on a column, and the choice among the verdicts.
function sortTable(header) {
  const table = header.closest("table");
  const column = [...header.parentNode.children].indexOf(header);
  const ascending = header.getAttribute("aria-sort") !== "ascending";
  for (const other of header.parentNode.children) {
    if (other.hasAttribute("aria-sort")) other.setAttribute("aria-sort", "none");
  }
  header.setAttribute("aria-sort", ascending ? "ascending" : "descending");
  const rows = [...table.tBodies[0].rows].map((row) => ({ row, key: row.cells[column].dataset.key }));
  const given = rows.filter(({ key }) => key !== "" && key !== "-inf");
  const numeric = given.every(({ key }) => !Number.isNaN(Number.parseFloat(key)));
  const order = (one, other) =>
    numeric ? Number.parseFloat(one.key) - Number.parseFloat(other.key)
      : one.key.localeCompare(other.key, "en", { numeric: true });
  given.sort((one, other) => (ascending ? order(one, other) : order(other, one)));
  const without = rows.filter((row) => !given.includes(row)); // last, however it is sorted
  table.tBodies[0].append(...[...given, ...without].map(({ row }) => row));
}

for (const button of document.querySelectorAll("th button")) {
  button.addEventListener("click", () => sortTable(button.closest("th")));
}

const choices = [...document.querySelectorAll("[data-show]")];
for (const choice of choices) {
  choice.addEventListener("click", () => {
    choices.forEach((other) => other.setAttribute("aria-pressed", String(other === choice)));
    for (const row of element("claims").tBodies[0].rows) {
      row.hidden = choice.dataset.show !== "all" && choice.dataset.show !== row.dataset.kind;
    }
  });
}
