"use strict";
// What all pages share: the data, controls, lists of values, arrays.
const data = JSON.parse(document.getElementById("data").textContent);
const element = (id) => document.getElementById(id);

// A control is a slider and a number in the unit shown; the number is exact, the slider coarse.
function makeControl({ key, factor, low, high, log, value, label, unit }, changed) {
  const slider = element(`range-${key}`);
  const field = element(`number-${key}`);
  const place = (v) => (log ? Math.log(v / low) / Math.log(high / low) : (v - low) / (high - low));
  const at = (part) => (log ? low * (high / low) ** part : low + part * (high - low));
  const range = `${label} must lie in ${low} to ${high} ${unit}`.trimEnd();
  const control = {
    key, current: value, refused: "", si: () => control.current * factor, set, reset: () => set(value),
  };
  function show(v) {
    control.current = v;
    slider.value = String(Math.round(1000 * place(v)));
    slider.setAttribute("aria-valuetext", field.value);
  }
  function set(v) {
    control.refused = "";
    field.value = String(v);
    field.removeAttribute("aria-invalid");
    show(v);
  }
  slider.addEventListener("input", () => {
    set(Number(at(slider.value / 1000).toPrecision(3)));
    changed();
  });
  field.addEventListener("input", () => {
    const v = field.valueAsNumber;
    const good = v >= low && v <= high;
    field.setAttribute("aria-invalid", String(!good));
    control.refused = good ? "" : range;
    if (good) show(v);
    changed();
  });
  set(value);
  return control;
}

function showValues(id, rows) {
  element(id).innerHTML = rows.map(([term, value]) => `<dt>${term}</dt><dd>${value}</dd>`).join("");
}

function floats(text) {
  const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  return new Float32Array(bytes.buffer);
}
