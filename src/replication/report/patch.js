"use strict";
// L_run and W_c by the tables of nucleation.report.patch_tables: lengths (m), or why there is none.
const Patch = (() => {
  const range = (ends) => ends.map((end) => Number(end.toPrecision(3))).join(" to ");
  const alike = (p) => Tables.system(p) === "half_spaces" && Tables.same(p, ["mu", "nu"]);

  // Of a fault with L_s (m) at the reference height.
  function runaway(p, height, stability, tables, places) {
    const own = tables.runaway[alike(p) ? "identical_layers" : Tables.system(p)];
    const [low, high] = tables.runaway.rigid_base.ends.zeta_over_a;
    const ratio = p.zeta / p.a;
    if (ratio > high) {
      return `none for ζ/a above ${high}: the force drops before slow slip; <code>nucleation drop</code> gives that length`;
    }
    if (!own) return "not known here: only on a rigid base and between identical bodies; <code>nucleation drop</code> computes it";
    if (ratio < low || !stability) {
      return `not known here: only for ζ/a from ${low} to ${high} and where L<sub>s</sub> is; <code>nucleation drop</code> computes it`;
    }
    return stability * Tables.value(own, { zeta_over_a: ratio, place: Tables.place(p, height, places) });
  }

  // Of a patch with L_c (m) whose surroundings have another zeta and a.
  function smallest(p, critical, { patch }) {
    const at = {
      zeta_over_a: p.zeta / p.a,
      strengthening: -p.outside.zeta / p.zeta,
      outside_a_over_a: p.outside.a / p.a,
    };
    if (p.outside.zeta >= 0) return "none: the surroundings have to strengthen, ζ below 0";
    if (!alike(p)) return "not known here: only between identical half-spaces; <code>nucleation length</code> computes it";
    if (Tables.inside(patch, at)) return critical * Tables.value(patch, at);
    const { zeta_over_a: weakening, strengthening, outside_a_over_a: direct } = patch.ends;
    return `not known here: only for ζ/a from ${range(weakening)}, a strengthening of ${range(strengthening)} ζ and`
      + ` a direct effect of ${range(direct)} a around it; <code>nucleation length</code> computes it`;
  }

  return { runaway, smallest };
})();
