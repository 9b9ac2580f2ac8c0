"use strict";
// Values of the tables of nucleation.report.tabulated, and which of them holds for a fault.
const Tables = (() => {
  const LOGARITHMIC = ["zeta_over_a", "strengthening", "outside_a_over_a"];

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

  // The table's value at arguments by name.
  function value({ nodes, logs }, at) {
    const coordinate = (name) => (LOGARITHMIC.includes(name) ? Math.log(at[name]) : at[name]);
    const weights = Object.keys(nodes).map((name) => shares(coordinate(name), nodes[name]));
    return Math.exp(weights.reduceRight(contracted, [...floats(logs)])[0]);
  }

  // Whether arguments are in the table's range; heights beyond its ends are taken at them.
  const inside = ({ ends }, at) => Object.entries(ends)
    .every(([name, [low, high]]) => name === "place" || (at[name] >= low && at[name] <= high));

  // M (Pa) and beta of the bodies as half-spaces, Eq. (8); nucleation.answers.formulas.bimaterial.
  function pair(p) {
    const [softness, nu2] = p.second ? [p.mu / p.second.mu, p.second.nu] : [0, 0];
    const total = 1 - p.nu + (1 - nu2) * softness;
    const beta = (0.5 * (1 - 2 * p.nu - (1 - 2 * nu2) * softness)) / total;
    return { modulus: (2 * p.mu) / ((1 - beta ** 2) * total), beta };
  }

  const same = (p, names) => names.every((name) => p[name] === p.second[name]);

  // The table that holds for two bodies, undefined without one. Far sides matter to layers alone.
  function system(p) {
    const free = (body) => body.heightRatio === Infinity || ["free", "traction"].includes(body.farSide ?? "free");
    const upper = { ...p, heightRatio: p.heightRatio ?? 1 };
    if (!p.second) return free(upper) ? "rigid_base" : undefined;
    if (upper.heightRatio === Infinity && p.second.heightRatio === Infinity) return "half_spaces";
    const alike = same(upper, ["mu", "nu", "heightRatio"]);
    return alike && free(upper) && free(p.second) ? "identical_layers" : undefined;
  }

  // The place of a height (m) on the tables' axis.
  function place(p, height, { heights, centre, power }) {
    const unit = (p.mu * p.ell) / ((1 - p.nu) * (p.a + p.zeta) * p.sigma0);
    const h = Math.min(Math.max((height * (p.heightRatio ?? 1)) / unit, heights[0]), heights[1]);
    const r = (h / centre) ** power;
    return (r - 1) / (r + 1);
  }

  return { inside, pair, place, same, system, value };
})();
