"use strict";
// L_s, the length at which a creeping patch turns unstable, by the tables of nucleation.report.stability.
const Stability = (() => {
  // Shares of the nodes in the value at x of the polynomial through them.
  function shares(x, nodes) {
    const factor = (own, other) => (own === other ? 1 : (x - other) / (own - other));
    return nodes.map((own) => nodes.reduce((product, other) => product * factor(own, other), 1));
  }

  // Sums over the last axis of an array that lies row by row.
  function contracted(values, weights) {
    const sums = new Array(values.length / weights.length).fill(0);
    values.forEach((value, i) => { sums[Math.floor(i / weights.length)] += value * weights[i % weights.length]; });
    return sums;
  }

  // M (Pa) and beta of the bodies as half-spaces, Eq. (8); nucleation.answers.formulas.bimaterial.
  function pair(p) {
    const [softness, nu2] = p.second ? [p.mu / p.second.mu, p.second.nu] : [0, 0];
    const total = 1 - p.nu + (1 - nu2) * softness;
    const beta = (0.5 * (1 - 2 * p.nu - (1 - 2 * nu2) * softness)) / total;
    return { modulus: (2 * p.mu) / ((1 - beta ** 2) * total), beta };
  }

  // The table that holds for two bodies, undefined without one. Far sides matter to layers alone.
  function system(p) {
    const free = (body) => body.heightRatio === Infinity || ["free", "traction"].includes(body.farSide ?? "free");
    const upper = { ...p, heightRatio: p.heightRatio ?? 1 };
    if (!p.second) return free(upper) ? "rigid_base" : undefined;
    if (upper.heightRatio === Infinity && p.second.heightRatio === Infinity) return "half_spaces";
    const same = ["mu", "nu", "heightRatio"].every((name) => upper[name] === p.second[name]);
    return same && free(upper) && free(p.second) ? "identical_layers" : undefined;
  }

  // A reader of the tables: of parameters a function of H and L_c (m) that gives L_s, or null.
  function reader({ tables, heights, centre, power }) {
    const known = Object.entries(tables).map(([name, table]) => [name, { ...table, logs: [...floats(table.logs)] }]);
    const table = Object.fromEntries(known);
    return (p) => {
      const [own, { modulus, beta }] = [table[system(p)], pair(p)];
      const at = { zeta_over_a: p.zeta / p.a, nu: p.nu, f: p.f, coupling: p.f * beta };
      const names = own ? Object.keys(own.nodes) : [];
      const inside = (name) => name === "place" || (at[name] >= own.ends[name][0] && at[name] <= own.ends[name][1]);
      if (!own || !names.every(inside)) return () => null;
      const axes = names.filter((name) => name !== "place").reverse();
      const values = axes.reduce((rest, name) => contracted(
        rest, shares(name === "zeta_over_a" ? Math.log(at[name]) : at[name], own.nodes[name]),
      ), own.logs);
      const scale = (Math.PI * modulus * p.ell) / (p.zeta * p.sigma0);
      if (!own.nodes.place) return () => scale * Math.exp(values[0]);
      const unit = (p.mu * p.ell) / ((1 - p.nu) * (p.a + p.zeta) * p.sigma0);
      return (height, length) => {
        const h = Math.min(Math.max((height * (p.heightRatio ?? 1)) / unit, heights[0]), heights[1]);
        const r = (h / centre) ** power;
        return length * Math.exp(contracted(values, shares((r - 1) / (r + 1), own.nodes.place))[0]);
      };
    };
  }

  // L_s in words, at.stability and at.length in m; or why the page does not know it.
  function words(p, at, { tables }) {
    if (at.stability) return `${at.stability.toPrecision(3)} m = ${(at.stability / at.length).toFixed(2)} L<sub>c</sub>`;
    const { ends } = tables.rigid_base;
    return system(p)
      ? `not known here: only for ζ/a from ${ends.zeta_over_a.join(" to ")}, ν from ${ends.nu.join(" to ")}`
        + ` and f from ${ends.f.join(" to ")}`
      : "not known here: only on a rigid base, for two identical layers and for two half-spaces,"
        + " all far sides free; <code>nucleation length</code> computes it";
  }

  // What is said of a critical point, and of L_s there.
  function values(p, at, tables, frequency) {
    return [
      ["Critical nucleation length L<sub>c</sub>", `${Number(at.length.toPrecision(5))} m`],
      ["Stability length of the patch L<sub>s</sub>", words(p, at, tables)],
      ["Critical wavenumber k<sub>c</sub> = 2π/L<sub>c</sub>", `${at.wavenumber.toPrecision(5)} rad/m`],
      ["Angular frequency ω of its mode", frequency],
    ];
  }

  return { pair, reader, values };
})();
