"use strict";
// The theory's curve, by the values of the controls, and the measured lengths.
const heights = data.heights;
const controls = data.controls.map((control) => makeControl(control, showTheory));

const parameters = () => Object.fromEntries(controls.map((control) => [control.key, control.si()]));
const lengthOfPatch = Stability.reader(data.stability);

function lengths(p) {
  const solve = Theory.solver(p);
  return heights.map((height) => solve(height).length);
}

// Figure 3's colours that would vanish on a dark screen.
const BRIGHTER = { "#000000": "#ececec", "#6B3E12": "#c98d4b", "#D55E00": "#ff9248" };

const shade = (given) => (dark.matches && BRIGHTER[given]) || given;

function pointTraces() {
  return data.points.map(({ symbol, colour: given, ...series }) => ({
    ...series, mode: "markers", marker: { symbol, size: 9, color: shade(given) },
    hovertemplate: "%{text}<extra></extra>",
  }));
}

function line(name, y, style, symbol = "c") {
  const hovertemplate = `H = %{x:.4g} m<br>L<sub>${symbol}</sub> = %{y:.4g} m<extra>%{fullData.name}</extra>`;
  return { name, x: heights, y, mode: "lines", line: style, hovertemplate };
}

function theoryLayout() {
  return layout({
    title: heading("Lengths L<sub>c</sub> and L<sub>s</sub> (m)"),
    xaxis: axis("Height of the block H (m)", { type: "log", range: data.seen.map(Math.log10), dtick: "D2" }),
    yaxis: axis("", { type: "log", dtick: "D2" }),
    legend: { orientation: "h", x: 0, xref: "container", y: 0, yref: "container", yanchor: "bottom", font: { size: 12 } },
    uirevision: "fixed",
  });
}

const configured = lengths(parameters());

// The theory of each fault, where there are several.
const own = data.faults.filter((fault) => fault.values.zeta > 0).slice(0, 12)
  .map((fault) => ({ ...fault, length: lengths(fault.values) }));

function ownTraces() {
  return own.map(({ label, length, colour }) =>
    line(`theory, ${label}`, length, { color: shade(colour), width: 1.2 }));
}

function drawTheory() {
  const p = parameters();
  const refused = controls.map((control) => control.refused).filter(Boolean);
  const known = (value) => (refused.length ? null : value);
  const patch = lengthOfPatch(p);
  const length = lengths(p);
  const stability = heights.map((height, i) => patch(height, length[i]));
  const [blue, green] = [colour("theory"), colour("stability")];
  const at = Theory.solver(p)(p.H);
  at.stability = patch(p.H, at.length);
  const traces = [
    line("theory, as configured", configured, { color: colour("soft"), width: 1, dash: "dot" }),
    line("theory", length.map(known), { color: blue, width: 2.5 }),
    line("patch turns unstable, L<sub>s</sub>", stability.map(known), { color: green, width: 2.5 }, "s"),
    { name: "values below", ...cross(p.H, known(at.length), blue) },
    { name: "values below", ...cross(p.H, known(at.stability), green) },
    ...ownTraces(),
    ...pointTraces(),
  ];
  Plotly.react("theory-plot", traces, theoryLayout(), SETTINGS);
  showValues("values", refused.length ? [[`No values: ${refused.join("; ")}`, ""]]
    : Stability.values(p, at, data.stability, `${at.frequency.toPrecision(5)} rad/s`));
}

let waiting = false; // several inputs between two frames of the screen are drawn once
function showTheory() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    drawTheory();
  });
}

element("controls").addEventListener("submit", (event) => event.preventDefault());
element("reset").addEventListener("click", () => {
  controls.forEach((control) => control.reset());
  showTheory();
});
drawTheory();
redrawn.push(drawTheory);
element("js-plotly-tester").setAttribute("aria-hidden", "true"); // Plotly measures texts in it
