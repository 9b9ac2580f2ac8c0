"use strict";
// The player of one run: its fields along the interface, moment by moment, and its driving force.
const FIELDS = [
  { name: "slip_rate", title: "Slip rate v (m/s)", shade: "theory", type: "log" },
  { name: "stress_ratio", title: "Shear stress τ/σ₀", shade: "field-2", type: "linear" },
  { name: "state", title: "State φ (s)", shade: "field-3", type: "log" },
];

function makePlayer(run) {
  const x = floats(run.x);
  const since = floats(run.since);
  const times = [since.map((t) => t + run.onset), since.map((t) => 1e3 * t)]; // s; ms from the onset
  const edge = floats(run.edge);
  const force = floats(run.force);
  const fields = FIELDS.map((field) => ({ ...field, values: floats(run[field.name]) }));
  const slider = element("moment");
  const play = element("play");
  let frame = 0;
  let timer = null;

  const row = (field, i) => field.values.subarray(i * x.length, (i + 1) * x.length);

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
        x, y: row(field, frame), mode: "lines", line: { color: colour(field.shade), width: 2 },
        hovertemplate: "x = %{x:.3g} m<br>%{y:.3g}<extra></extra>",
      };
      Plotly.react(`plot-${field.name}`, [trace], layout({
        title: heading(field.title),
        xaxis: axis("x (m)", { range: [0, x[x.length - 1]] }),
        yaxis: axis("", { type: field.type, range: run.ranges[field.name] }),
        shapes: marks(frame),
        uirevision: "fixed",
      }), SETTINGS);
    }
  }

  // The force twice: over the whole run, and near the onset, in milliseconds.
  function drawForce() {
    const near = run.event.map((t) => 1e3 * t);
    const inside = force.filter((_, i) => times[1][i] >= near[0] && times[1][i] <= near[1]);
    const [low, high] = [Math.min(...inside), Math.max(...inside)];
    const pad = 0.08 * (high - low) || 1;
    const style = { mode: "lines", line: { color: colour("theory"), width: 1.6 } };
    const hovertemplate = "%{x:.5g}, %{y:.4g} kN/m<extra></extra>";
    const dot = { mode: "markers", marker: { color: colour("mark"), size: 10 }, hoverinfo: "skip" };
    const second = { xaxis: "x2", yaxis: "y2" };
    const curves = times.map((x, i) => ({ x, y: force, ...(i ? second : {}), ...style, hovertemplate }));
    const dots = times.map((x, i) => ({ x: [x[frame]], y: [force[frame]], ...(i ? second : {}), ...dot }));
    Plotly.react("plot-force", [...curves, ...dots], layout({
      title: heading("Driving force −f<sub>d</sub> (kN/m)"),
      showlegend: false,
      xaxis: axis("t (s)", { domain: [0, 0.44] }),
      yaxis: axis("", {}),
      xaxis2: axis("t − t<sub>onset</sub> (ms)", { domain: [0.58, 1], range: near }),
      yaxis2: axis("", { anchor: "x2", range: [low - pad, high + pad] }),
      uirevision: "fixed",
    }), SETTINGS);
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
    const y = [force[frame]];
    Plotly.restyle("plot-force", { x: times.map((x) => [x[frame]]), y: [y, y] }, [2, 3]);
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

  const onset = since.reduce((best, t, i) => (Math.abs(t) < Math.abs(since[best]) ? i : best), 0);
  play.addEventListener("click", () => (timer === null ? start() : stop()));
  slider.addEventListener("input", () => {
    stop();
    show(Number(slider.value));
  });
  const draw = () => {
    drawFields();
    drawForce();
  };
  draw();
  show(onset);
  redrawn.push(draw);
}

if (data.player) makePlayer(data.player);
