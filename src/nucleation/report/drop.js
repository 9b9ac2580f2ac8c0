"use strict";
// The law of the drop in the page: the length at which the force drops, for any declared strength.
//
// As nucleation.patch.delay.Growth.drop: in a part exp(-1/sigma^2) of the realisations the mode's amplitude
// has reached one; the force falls once in a period of it, at a phase that is even over realisations, so
// the part that has dropped by a length is the mean over a period's growth of the patch about it.
const DropLaw = (() => {
  // The value at x of a curve given at rising places, as numpy.interp has it.
  function interpolated(x, places, values) {
    const last = places.length - 1;
    if (x >= places[last]) return values[last];
    if (x < places[0]) return values[0];
    const low = placeBelow(x, places);
    const slope = (values[low + 1] - values[low]) / (places[low + 1] - places[low]);
    return values[low] + slope * (x - places[low]);
  }

  // The part of the realisations that have dropped by each length of a curve; it never falls.
  function dropped({ length, logAmplitude, perPeriod }, strength) {
    const last = length.length - 1;
    const area = new Float64Array(last + 1);
    let [highest, before] = [-Infinity, 0];
    for (let i = 0; i <= last; i += 1) {
      highest = Math.max(highest, logAmplitude[i]);
      const reached = Math.exp(-Math.exp(Math.min(-2 * (highest + Math.log(strength)), 700)));
      if (i > 0) area[i] = area[i - 1] + 0.5 * (reached + before) * (length[i] - length[i - 1]);
      before = reached;
    }
    const until = (end) => interpolated(end, length, area) + Math.max(end - length[last], 0);
    const parts = new Float64Array(last + 1);
    let part = 0;
    for (let i = 0; i <= last; i += 1) {
      const half = 0.5 * perPeriod[i];
      part = Math.max(part, (until(length[i] + half) - until(length[i] - half)) / perPeriod[i]);
      parts[i] = part;
    }
    return parts;
  }

  // The lengths (m) by which some parts of the realisations have dropped; NaN beyond the law's reach.
  function drop(curve, strength, parts) {
    const wanted = -Math.log(strength * Math.sqrt(Math.log(2)));
    const { length, logAmplitude } = curve;
    const above = (value) => value >= wanted;
    if (!above(logAmplitude[length.length - 1]) || logAmplitude.every(above)) return parts.map(() => NaN);
    const all = dropped(curve, strength);
    return parts.map((part) => interpolated(part, all, length));
  }

  return { drop };
})();

function makeDrop({ faults, parts, strongest, control }) {
  const read = (curve) => ({
    ...curve,
    length: floats(curve.length),
    logAmplitude: floats(curve.log_amplitude),
    perPeriod: floats(curve.per_period),
  });
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
    const drops = trusted.map((eps) => DropLaw.drop(curve(), eps, parts));
    const over = parts.map((_, part) => drops.map((lengths) => lengths[part] / critical));
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
      { name: "values", ...cross(eps, DropLaw.drop(curve(), eps, parts)[0] / critical, shade) },
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
    const [median, early, late] = DropLaw.drop(curve(), strength.si(), parts);
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
