"use strict";
// What the page's parts share: the data, colours and axes of all plots, controls, and lists of values.
const data = JSON.parse(document.getElementById("data").textContent);
const element = (id) => document.getElementById(id);
const dark = window.matchMedia("(prefers-color-scheme: dark)");
const SETTINGS = { displayModeBar: false, responsive: true, doubleClick: "reset" };

// Colours come from the style sheet, which knows of dark screens.

function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

function axis(title, more = {}) {
  return {
    title: { text: title, standoff: 6 },
    gridcolor: colour("line"),
    linecolor: colour("soft"),
    zeroline: false,
    showline: true,
    ticks: "outside",
    tickcolor: colour("soft"),
    exponentformat: "power",
    automargin: true,
    ...more,
  };
}

function layout(more) {
  return {
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    font: { family: "inherit", size: 13, color: colour("ink") },
    margin: { l: 58, r: 12, t: 30, b: 44 },
    // a finger that moves over a plot scrolls the page
    dragmode: window.matchMedia("(pointer: coarse)").matches ? false : "zoom",
    hoverlabel: { align: "left" },
    ...more,
  };
}

// What a plot shows, above it and not beside the axis: that leaves more room on a phone.
function heading(text) {
  return { text, font: { size: 14 }, x: 0, xref: "container", y: 0.99, yanchor: "top", pad: { l: 8 } };
}

// Below a plot, for the same reason.
function legend() {
  return {
    orientation: "h", x: 0, xref: "container", y: 0, yref: "container", yanchor: "bottom",
    font: { size: 12 },
  };
}

// A cross at the values that the controls have.
function cross(x, y, shade) {
  return {
    x: [x], y: [y], mode: "markers", showlegend: false, hoverinfo: "skip",
    marker: { symbol: "cross-thin-open", size: 16, color: shade, line: { width: 2 } },
  };
}

const redrawn = []; // functions that draw again when the colours change
dark.addEventListener("change", () => redrawn.forEach((draw) => draw()));

// A control is a slider and a number in the unit shown; the number is exact, the slider coarse.
function makeControl({ key, factor, low, high, log, value, label = "Height", unit = "m" }, changed) {
  const slider = element(`range-${key}`);
  const field = element(`number-${key}`);
  const place = (v) => (log ? Math.log(v / low) / Math.log(high / low) : (v - low) / (high - low));
  const at = (part) => (log ? low * (high / low) ** part : low + part * (high - low));
  const range = `${label} must lie in ${low} to ${high} ${unit}`.trimEnd();
  const control = {
    key, current: value, refused: "", si: () => control.current * factor, set, reset: () => set(value),
  };
  function set(v) {
    control.current = v;
    control.refused = "";
    field.value = String(v);
    slider.value = String(Math.round(1000 * place(v)));
    slider.setAttribute("aria-valuetext", field.value);
    field.removeAttribute("aria-invalid");
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
    if (!good) {
      changed();
      return;
    }
    control.current = v;
    slider.value = String(Math.round(1000 * place(v)));
    slider.setAttribute("aria-valuetext", field.value);
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

// The interval between rising places in which x lies: the number of its lower end.
function placeBelow(x, places) {
  let [low, high] = [0, places.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (places[middle] <= x) low = middle;
    else high = middle;
  }
  return low;
}
