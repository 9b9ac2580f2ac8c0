"use strict";
// Connects the page's controls with what they show: tables, the theory's curve, the player.
const data = JSON.parse(document.getElementById("data").textContent);
const element = (id) => document.getElementById(id);
const dark = window.matchMedia("(prefers-color-scheme: dark)");
const SETTINGS = { displayModeBar: false, responsive: true, doubleClick: "reset" };

// ---- What all plots share. Colours come from the style sheet, which knows of dark screens.

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

const redrawn = []; // functions that draw again when the colours change
dark.addEventListener("change", () => redrawn.forEach((draw) => draw()));

// ---- Tables

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

// ---- The theory's curve

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

const heights = data.heights;
const [lowest, highest] = [heights[0], heights[heights.length - 1]];
const HEIGHT = { key: "H", factor: 1, low: lowest, high: highest, log: true, value: data.start };
const controls = [...data.controls, HEIGHT].map((control) => makeControl(control, showTheory));
const plot = element("theory-plot");

// A second block is as high as the first, and has its Poisson's ratio.
function secondBody(p) {
  const [farSide, contrast] = [element("below").value, Number(element("contrast").value)];
  return farSide && contrast > 0 ? { mu: p.mu * contrast, nu: p.nu, heightRatio: 1, farSide } : undefined;
}

function parameters() {
  const p = Object.fromEntries(controls.map((control) => [control.key, control.si()]));
  return { ...p, second: secondBody(p) };
}

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

function line(name, y, style, more = {}) {
  const hovertemplate = "H = %{x:.4g} m<br>L<sub>c</sub> = %{y:.4g} m<extra>%{fullData.name}</extra>";
  return { name, x: heights, y, mode: "lines", line: style, hovertemplate, ...more };
}

function theoryLayout() {
  const linear = element("linear").checked;
  const type = linear ? "linear" : "log";
  const end = data.linear; // of the linear axes
  const seen = heights.map((height, i) => (height <= end ? plotted.length[i] : 0));
  const shown = data.points.flatMap((series) => series.length_high);
  const top = 1.15 * Math.max(...seen, ...shown);
  const ticks = linear ? {} : { dtick: "D2" };
  const ranges = linear ? [[0, end], [0, top]] : [data.seen.map(Math.log10)];
  return layout({
    title: heading("Critical nucleation length L<sub>c</sub> (m)"),
    xaxis: axis("Height of the block H (m)", { type, range: ranges[0], ...ticks }),
    yaxis: axis("", { type, ...ticks, ...(linear ? { range: ranges[1] } : { autorange: true }) }),
    legend: {
      orientation: "h", x: 0, xref: "container", y: 0, yref: "container", yanchor: "bottom",
      font: { size: 12 },
    },
    uirevision: type,
  });
}

let plotted = { length: [], thin: [] };
const configured = curves(data.base);

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
  plotted = curves(p);
  if (refused.length) plotted = { length: heights.map(() => null), thin: heights.map(() => null) };
  const blue = colour("theory");
  const at = Theory.solver(p)(p.H);
  const traces = [
    line("theory, as configured", configured.length, { color: colour("soft"), width: 1, dash: "dot" }),
    line("theory, H k → 0", plotted.thin, { color: blue, width: 1.3, dash: "dash" }),
    line("theory", plotted.length, { color: blue, width: 2.5 }),
    { name: "values below", x: [p.H], y: [refused.length ? null : at.length], mode: "markers", showlegend: false,
      marker: { symbol: "cross-thin-open", size: 16, color: blue, line: { width: 2 } },
      hoverinfo: "skip" },
    ...ownTraces(),
    ...pointTraces(),
  ];
  Plotly.react(plot, traces, theoryLayout(), SETTINGS);
  if (refused.length) element("values").innerHTML = `<dt>No values: ${refused.join("; ")}</dt><dd></dd>`;
  else showValues(p, at);
}

function showValues(p, at) {
  const rows = [
    ["Critical length L<sub>c</sub>", `${at.length.toPrecision(5)} m`],
    ["Critical wavenumber k<sub>c</sub>", `${at.wavenumber.toPrecision(5)} rad/m`],
    ["Angular frequency ω", `${at.frequency.toPrecision(5)} rad/s`],
    ["L<sub>c</sub> for H k → 0, Eq. (11)", `${Theory.thinLength(p.H, p).toPrecision(5)} m`],
  ];
  element("values").innerHTML = rows.map(([term, value]) => `<dt>${term}</dt><dd>${value}</dd>`).join("");
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
element("linear").addEventListener("change", showTheory);
element("below").addEventListener("change", showTheory);
element("contrast").addEventListener("input", showTheory);
element("reset").addEventListener("click", () => {
  controls.forEach((control) => control.reset());
  [element("below").value, element("contrast").value] = ["", "1"];
  showTheory();
});
drawTheory();
redrawn.push(drawTheory);
element("js-plotly-tester").setAttribute("aria-hidden", "true"); // Plotly measures texts in it

// ---- The player

function floats(text) {
  const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  return new Float32Array(bytes.buffer);
}

const FIELDS = [
  { name: "slip_rate", title: "Slip rate v (m/s)", log: true, low: 1e-9 },
  { name: "stress_ratio", title: "Shear stress τ/σ₀", log: false },
  { name: "state", title: "State φ (s)", log: true },
];

function makePlayer(run) {
  const x = floats(run.x);
  const since = floats(run.since);
  const edge = floats(run.edge);
  const fields = FIELDS.map((field, i) => ({
    ...field, values: floats(run[field.name]), colour: `field-${i + 1}`,
  }));
  const force = { since: floats(run.force_since), value: floats(run.force) };
  const slider = element("moment");
  const play = element("play");
  let frame = 0;
  let timer = null;

  const row = (field, i) => field.values.subarray(i * x.length, (i + 1) * x.length);

  function range(field) {
    let [low, high] = [Infinity, -Infinity];
    for (const value of field.values) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
    if (!field.log) return [low - 0.05 * (high - low), high + 0.05 * (high - low)];
    return [Math.log10(field.low || low) - 0.1, Math.log10(high) + 0.3];
  }

  // Lines across a plot: the patch's edge, which moves, and the critical length, which doesn't.
  function marks(i) {
    const vertical = (at, dash, shade) => ({
      type: "line", xref: "x", yref: "paper", x0: at, x1: at, y0: 0, y1: 1,
      line: { color: colour(shade), width: 1.3, dash },
    });
    const length = run.length === null ? [] : [vertical(run.length, "dot", "soft")];
    return [vertical(edge[i], "dash", "mark"), ...length];
  }

  function drawFields() {
    for (const field of fields) {
      const trace = {
        x, y: row(field, frame), mode: "lines", line: { color: colour(field.colour), width: 2 },
        hovertemplate: "x = %{x:.3g} m<br>%{y:.3g}<extra></extra>",
      };
      Plotly.react(`plot-${field.name}`, [trace], layout({
        title: heading(field.title),
        xaxis: axis("x (m)", { range: [0, x[x.length - 1]] }),
        yaxis: axis("", { type: field.log ? "log" : "linear", range: range(field) }),
        shapes: marks(frame),
        uirevision: "fixed",
      }), SETTINGS);
    }
  }

  // The force twice: over the whole run, and near the onset, in milliseconds.
  function drawForce() {
    const near = run.event.map((t) => 1e3 * t);
    const inside = [...force.value].filter((_, i) => {
      const t = 1e3 * force.since[i];
      return t >= near[0] && t <= near[1];
    });
    const [low, high] = [Math.min(...inside), Math.max(...inside)];
    const pad = 0.08 * (high - low) || 1;
    const style = { mode: "lines", line: { color: colour("theory"), width: 1.6 } };
    const hovertemplate = "%{x:.5g}, %{y:.4g} kN/m<extra></extra>";
    const dot = { mode: "markers", marker: { color: colour("mark"), size: 10 }, hoverinfo: "skip" };
    const traces = [
      { x: force.since.map((t) => t + run.onset), y: force.value, ...style, hovertemplate },
      { x: force.since.map((t) => 1e3 * t), y: force.value, xaxis: "x2", yaxis: "y2", ...style, hovertemplate },
      { ...moment(frame, 1, run.onset), ...dot },
      { ...moment(frame, 1e3, 0), xaxis: "x2", yaxis: "y2", ...dot },
    ];
    Plotly.react("plot-force", traces, layout({
      title: heading("Driving force −f<sub>d</sub> (kN/m)"),
      showlegend: false,
      xaxis: axis("t (s)", { domain: [0, 0.44] }),
      yaxis: axis("", {}),
      xaxis2: axis("t − t<sub>onset</sub> (ms)", { domain: [0.58, 1], range: near }),
      yaxis2: axis("", { anchor: "x2", range: [low - pad, high + pad] }),
      uirevision: "fixed",
    }), SETTINGS);
  }

  function moment(i, scale, origin) {
    let [low, high] = [0, force.since.length - 1];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (force.since[middle] <= since[i]) low = middle;
      else high = middle;
    }
    const near = since[i] - force.since[low] <= force.since[high] - since[i] ? low : high;
    return { x: [since[i] * scale + origin], y: [force.value[near]] };
  }

  function clock(i) {
    const later = since[i];
    const amount = Math.abs(later) < 0.1 ? `${(1e3 * Math.abs(later)).toPrecision(3)} ms` : `${Math.abs(later).toPrecision(3)} s`;
    const relation = later === 0 ? "at the onset" : `${amount} ${later < 0 ? "before" : "after"} the onset`;
    return `t = ${(run.onset + later).toFixed(4)} s, ${relation}; patch ${edge[i].toFixed(3)} m`;
  }

  function show(i) {
    frame = Math.max(0, Math.min(run.frames - 1, i));
    slider.value = String(frame);
    slider.setAttribute("aria-valuetext", clock(frame));
    element("clock").textContent = clock(frame);
    for (const field of fields) {
      Plotly.update(`plot-${field.name}`, { y: [row(field, frame)] }, { shapes: marks(frame) });
    }
    const [whole, zoom] = [moment(frame, 1, run.onset), moment(frame, 1e3, 0)];
    Plotly.restyle("plot-force", { x: [whole.x, zoom.x], y: [whole.y, zoom.y] }, [2, 3]);
  }

  function stop() {
    clearInterval(timer);
    timer = null;
    play.textContent = "Play";
    element("clock").setAttribute("role", "status"); // read aloud, but not twenty times a second
  }

  function start() {
    if (frame === run.frames - 1) show(0);
    play.textContent = "Pause";
    element("clock").removeAttribute("role");
    timer = setInterval(() => {
      show(frame + 1);
      if (frame === run.frames - 1) stop();
    }, 60);
  }

  function jump(i) {
    stop();
    show(i);
  }

  const onset = since.reduce((best, t, i) => (Math.abs(t) < Math.abs(since[best]) ? i : best), 0);
  play.addEventListener("click", () => (timer === null ? start() : stop()));
  slider.addEventListener("input", () => jump(Number(slider.value)));
  element("back").addEventListener("click", () => jump(frame - 1));
  element("forward").addEventListener("click", () => jump(frame + 1));
  element("to-onset").addEventListener("click", () => jump(onset));
  const draw = () => {
    drawFields();
    drawForce();
  };
  draw();
  show(onset);
  redrawn.push(draw);
}

if (data.player) makePlayer(data.player);
