"use strict";
// L_s, the length at which a creeping patch turns unstable, by the tables of nucleation.report.stability.
const Stability = (() => {
  // L_s (m) at the reference height and L_c (m), or null.
  function length(p, height, critical, tables) {
    const own = tables.tables[Tables.system(p)];
    const { modulus, beta } = Tables.pair(p);
    const at = {
      zeta_over_a: p.zeta / p.a, nu: p.nu, f: p.f, coupling: p.f * beta, place: Tables.place(p, height, tables),
    };
    if (!own || !Tables.inside(own, at)) return null;
    const scale = own.nodes.place ? critical : (Math.PI * modulus * p.ell) / (p.zeta * p.sigma0);
    return scale * Tables.value(own, at);
  }

  // Why the page does not know L_s.
  function why(p, { tables }) {
    const { ends } = tables.rigid_base;
    return Tables.system(p)
      ? `not known here: only for ζ/a from ${ends.zeta_over_a.join(" to ")}, ν from ${ends.nu.join(" to ")}`
        + ` and f from ${ends.f.join(" to ")}; <code>nucleation length</code> computes it`
      : "not known here: only on a rigid base, for two identical layers and for two half-spaces,"
        + " all far sides free; <code>nucleation length</code> computes it";
  }

  return { length, why };
})();
