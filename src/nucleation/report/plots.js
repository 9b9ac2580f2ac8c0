"use strict";
// What all plots share: colours, axes, headings, legends.
const dark = window.matchMedia("(prefers-color-scheme: dark)");
const SETTINGS = { displayModeBar: false, responsive: true, doubleClick: "reset" };

// Colours come from the style sheet, which knows of dark screens.
const probe = document.head.appendChild(document.createElement("span"));
function colour(name) {
  probe.style.color = `var(--${name})`;
  return getComputedStyle(probe).color;
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

// A cross at the values that the controls have.
function cross(x, y, shade) {
  return {
    x: [x], y: [y], mode: "markers", showlegend: false, hoverinfo: "skip",
    marker: { symbol: "cross-thin-open", size: 16, color: shade, line: { width: 2 } },
  };
}

const redrawn = []; // functions that draw again when the colours change
dark.addEventListener("change", () => redrawn.forEach((draw) => draw()));
