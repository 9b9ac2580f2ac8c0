"use strict";
// The law of the drop in the page: the length at which the force drops, for any declared strength.
//
// As nucleation.patch.delay.Growth: a part P of the realisations has dropped by the length where the
// mode's amplitude per strength last passes 1 / (strength sqrt(-log P)).
const DropLaw = (() => {
  // Lengths (m) by increasing order and the logarithm of the amplitude there; NaN beyond the law.
  function crossing({ length, logAmplitude }, wanted) {
    const last = logAmplitude.length - 1;
    if (!(logAmplitude[last] >= wanted)) return NaN;
    let i = last;
    while (i >= 0 && logAmplitude[i] >= wanted) i -= 1;
    if (i < 0) return NaN;
    const part = (wanted - logAmplitude[i]) / (logAmplitude[i + 1] - logAmplitude[i]);
    return length[i] + part * (length[i + 1] - length[i]);
  }

  // The length (m) by which a part of the realisations has dropped.
  function drop(curve, strength, part) {
    return crossing(curve, -Math.log(strength * Math.sqrt(-Math.log(part))));
  }

  return { drop };
})();

function makeDrop({ faults, parts, strongest, control }) {
  const read = (curve) => ({ ...curve, length: floats(curve.length), logAmplitude: floats(curve.log_amplitude) });
  const known = faults.map((fault) => ({
    ...fault,
    kinds: Object.fromEntries(Object.entries(fault.kinds).map(([kind, curve]) => [kind, read(curve)])),
  }));
  const strength = makeControl(control, show);
  const steps = 200;
  const strengths = Array.from({ length: steps + 1 },
    (_, i) => control.low * (control.high / control.low) ** (i / steps));

  const fault = () => known[Number(element("drop-fault").value)];
  const curve = () => fault().kinds[element("drop-kind").value];
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
    const over = parts.map((part) => trusted.map((eps) => DropLaw.drop(curve(), eps, part) / critical));
    const eps = strength.si();
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
      { name: "values", x: [eps], y: [DropLaw.drop(curve(), eps, parts[0]) / critical], mode: "markers",
        showlegend: false, hoverinfo: "skip",
        marker: { symbol: "cross-thin-open", size: 16, color: shade, line: { width: 2 } } },
    ];
    Plotly.react("drop-plot", traces, layout({
      title: heading("Length at the drop over L<sub>c</sub>"),
      xaxis: axis("Relative strength of the perturbation ε", {
        type: "log", dtick: 2, range: [control.low, control.high].map(Math.log10),
      }),
      yaxis: axis("", { range: [0.5, 1.05] }),
      legend: {
        orientation: "h", x: 0, xref: "container", y: 0, yref: "container", yanchor: "bottom",
        font: { size: 12 },
      },
      uirevision: "fixed",
    }), SETTINGS);
  }

  function show() {
    const critical = fault().theory_length;
    const [median, early, late] = parts.map((part) => DropLaw.drop(curve(), strength.si(), part));
    const rows = [
      ["L<sub>c</sub>, theory of homogeneous sliding", `${critical.toPrecision(4)} m`],
      ["L<sub>s</sub>, the patch turns unstable", metres(fault().stability_length, critical)],
      ["half of the realisations have dropped", metres(median, critical)],
      ["16 % of them", metres(early, critical)],
      ["84 % of them", metres(late, critical)],
    ];
    element("drop-values").innerHTML = rows.map(([term, value]) => `<dt>${term}</dt><dd>${value}</dd>`).join("");
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
