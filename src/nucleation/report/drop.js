"use strict";
// The length at which the force drops, for any declared strength, by nucleation.report.drop_law.

// Median, 16 and 84 %, each between two of a table by strength; NaN beyond the law's reach.
function dropAt(eps, strengths, drops) {
  const low = placeBelow(eps, strengths);
  const part = Math.log(eps / strengths[low]) / Math.log(strengths[low + 1] / strengths[low]);
  return drops.map((lengths) => lengths[low] + part * (lengths[low + 1] - lengths[low]));
}

function makeDrop({ faults, strengths, strongest, control }) {
  const strength = makeControl(control, show);

  const fault = () => faults[Number(element("drop-fault").value)];
  const curve = () => fault().kinds[element("drop-kind").value];
  const drops = () => curve().drops.map(floats);
  const at = (eps) => dropAt(eps, strengths, drops());
  const metres = (length, critical) => (Number.isFinite(length)
    ? `${length.toPrecision(4)} m, ${(length / critical).toPrecision(3)} L<sub>c</sub>`
    : "beyond the law's reach");

  function doubt(eps, length) {
    if (eps * curve().effective >= strongest) {
      return "Do not rely on it: under a perturbation this strong, bursts come to rest and make the drop later.";
    }
    return Number.isFinite(length) ? "" : "The quiet run's trends are not carried on so far.";
  }

  function draw() {
    const critical = fault().theory_length;
    const trusted = strengths.filter((eps) => eps * curve().effective < strongest);
    const over = drops().map((lengths) => [...lengths].slice(0, trusted.length).map((length) => length / critical));
    const shade = colour("theory");
    const level = (name, value, dash) => ({
      name, x: [control.low, control.high], y: [value, value], mode: "lines",
      line: { color: colour("soft"), width: 1.3, dash }, hoverinfo: "skip",
    });
    const style = { mode: "lines", hovertemplate: "ε = %{x:.2g}<br>%{y:.3f} L<sub>c</sub><extra></extra>" };
    const traces = [
      { x: trusted, y: over[1], ...style, line: { color: shade, width: 0 }, showlegend: false },
      { name: "16 to 84 %", x: trusted, y: over[2], ...style, fill: "tonexty", line: { color: shade, width: 0 } },
      { name: "half have dropped", x: trusted, y: over[0], ...style, line: { color: shade, width: 2.5 } },
      level("L<sub>c</sub>, theory", 1, "dash"),
      level("L<sub>s</sub>", fault().stability_length / critical, "dot"),
      { name: "values", ...cross(strength.si(), at(strength.si())[0] / critical, shade) },
    ];
    Plotly.react("drop-plot", traces, layout({
      title: heading("Length at the drop over L<sub>c</sub>"),
      xaxis: axis("Relative strength of the perturbation ε", {
        type: "log", dtick: 2, range: [control.low, control.high].map(Math.log10),
      }),
      yaxis: axis("", { range: [0.5, 1.05] }),
      legend: legend(),
      uirevision: "fixed",
    }), SETTINGS);
  }

  function show() {
    const critical = fault().theory_length;
    const [median, early, late] = at(strength.si());
    showValues("drop-values", [
      ["L<sub>c</sub>, theory of homogeneous sliding", `${critical.toPrecision(4)} m`],
      ["L<sub>s</sub>, the patch turns unstable", metres(fault().stability_length, critical)],
      ["half of the realisations have dropped", metres(median, critical)],
      ["16 % of them", metres(early, critical)],
      ["84 % of them", metres(late, critical)],
    ]);
    element("drop-doubt").textContent = doubt(strength.si(), late);
    draw();
  }

  element("drop-form").addEventListener("submit", (event) => event.preventDefault());
  element("drop-fault").addEventListener("change", show);
  element("drop-kind").addEventListener("change", show);
  show();
  redrawn.push(draw);
}

if (data.drop) makeDrop(data.drop);
