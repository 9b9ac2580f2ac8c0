"use strict";
// What the pages share: the data, lists of values, arrays; and the choice among verdicts.
const data = JSON.parse(document.getElementById("data").textContent);
const element = (id) => document.getElementById(id);

function showValues(id, rows) {
  element(id).innerHTML = rows.map(([term, value]) => `<dt>${term}</dt><dd>${value}</dd>`).join("");
}

function floats(text) {
  const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  return new Float32Array(bytes.buffer);
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
