"use strict";
// The choice among the verdicts.
const choices = [...document.querySelectorAll("[data-show]")];
for (const choice of choices) {
  choice.addEventListener("click", () => {
    choices.forEach((other) => other.setAttribute("aria-pressed", String(other === choice)));
    for (const row of element("claims").tBodies[0].rows) {
      row.hidden = choice.dataset.show !== "all" && choice.dataset.show !== row.dataset.kind;
    }
  });
}
