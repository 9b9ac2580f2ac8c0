"use strict";
// The theory's curve, by the values of the controls, and the measured lengths.
const heights = data.heights;
const controls = data.controls.map((control) => makeControl(control, showTheory));
const plot = element("theory-plot");

const parameters = () => Object.fromEntries(controls.map((control) => [control.key, control.si()]));
const lengthOfPatch = Stability.reader(data.stability);

function curves(p) {
  const solve = Theory.solver(p);
  return {
    length: heights.map((height) => solve(height).length),
    thin: heights.map((height) => Theory.thinLength(height, p)),
  };
}

// Figure 3's colours that would vanish on a dark screen.
const BRIGHTER = { "#000000": "#ececec", "#6B3E12": "#c98d4b", "#D55E00": "#ff9248" };

function pointTraces() {
  return data.points.map((series) => ({
    name: series.label,
    x: series.height,
    y: series.length,
    error_y: {
      type: "data",
      symmetric: false,
      array: series.length.map((v, i) => Math.max(series.length_high[i] - v, 0)),
      arrayminus: series.length.map((v, i) => Math.max(v - series.length_low[i], 0)),
      thickness: 1,
      width: 3,
    },
    customdata: series.id.map((id, i) => [
      id, series.length_low[i], series.length_high[i], series.onset_time[i],
      series.length[i] / series.theory_length[i],
    ]),
    hovertemplate: "<b>%{customdata[0]}</b><br>H = %{x:.4g} m<br>L<sub>c</sub> = %{y:.4g} m "
      + "(%{customdata[1]:.3g} to %{customdata[2]:.3g})<br>%{customdata[4]:.3g} of the theory"
      + "<br>onset at %{customdata[3]:.4g} s<extra></extra>",
    mode: "markers",
    marker: {
      symbol: series.symbol + (series.filled ? "" : "-open"),
      size: 9,
      color: (dark.matches && BRIGHTER[series.colour]) || series.colour,
    },
  }));
}

function line(name, y, style, more = {}, symbol = "c") {
  const hovertemplate = `H = %{x:.4g} m<br>L<sub>${symbol}</sub> = %{y:.4g} m<extra>%{fullData.name}</extra>`;
  return { name, x: heights, y, mode: "lines", line: style, hovertemplate, ...more };
}

function theoryLayout() {
  return layout({
    title: heading("Lengths L<sub>c</sub> and L<sub>s</sub> (m)"),
    xaxis: axis("Height of the block H (m)", { type: "log", range: data.seen.map(Math.log10), dtick: "D2" }),
    yaxis: axis("", { type: "log", dtick: "D2" }),
    legend: legend(),
    uirevision: "fixed",
  });
}

const configured = curves(parameters());

// The theory of each fault, where there are several.
const own = data.faults.filter((fault) => fault.values.zeta > 0).slice(0, 12)
  .map((fault) => ({ ...fault, length: curves(fault.values).length }));

function ownTraces() {
  return own.map(({ label, length, colour }) =>
    line(`theory, ${label}`, length, { color: (dark.matches && BRIGHTER[colour]) || colour, width: 1.2 }));
}

function drawTheory() {
  const p = parameters();
  const refused = controls.map((control) => control.refused).filter(Boolean);
  const patch = lengthOfPatch(p);
  const plotted = curves(p);
  plotted.stability = heights.map((height, i) => patch(height, plotted.length[i]));
  for (const name of refused.length ? Object.keys(plotted) : []) plotted[name] = heights.map(() => null);
  const [blue, green] = [colour("theory"), colour("field-2")];
  const at = Theory.solver(p)(p.H);
  at.stability = patch(p.H, at.length);
  const traces = [
    line("theory, as configured", configured.length, { color: colour("soft"), width: 1, dash: "dot" }),
    line("theory, H k → 0", plotted.thin, { color: blue, width: 1.3, dash: "dash" }),
    line("theory", plotted.length, { color: blue, width: 2.5 }),
    line("patch turns unstable, L<sub>s</sub>", plotted.stability, { color: green, width: 2.5 }, {}, "s"),
    { name: "values below", ...cross(p.H, refused.length ? null : at.length, blue) },
    { name: "values below", ...cross(p.H, refused.length ? null : at.stability, green) },
    ...ownTraces(),
    ...pointTraces(),
  ];
  Plotly.react(plot, traces, theoryLayout(), SETTINGS);
  showValues("values", refused.length ? [[`No values: ${refused.join("; ")}`, ""]] : values(p, at));
}

function values(p, at) {
  return [
    ["Critical length L<sub>c</sub>", `${at.length.toPrecision(5)} m`],
    ["Stability length of the patch L<sub>s</sub>", Stability.words(p, at, data.stability)],
    ["Critical wavenumber k<sub>c</sub>", `${at.wavenumber.toPrecision(5)} rad/m`],
    ["Angular frequency ω", `${at.frequency.toPrecision(5)} rad/s`],
    ["L<sub>c</sub> for H k → 0, Eq. (11)", `${Theory.thinLength(p.H, p).toPrecision(5)} m`],
  ];
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
