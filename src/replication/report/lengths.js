"use strict";
// The lengths in use, by the keys and within the limits of nucleation.answers.in_use; NaN
// outside their validity.
const Lengths = (() => {
  // The factor of a loaded patch, a polynomial by Clenshaw's rule.
  function loaded(ratio, { chebyshev, nearest }) {
    const x = (2 * Math.log(1 - ratio)) / Math.log(1 - nearest) - 1;
    let [one, two] = [0, 0];
    for (const c of chebyshev.slice(1).reverse()) [one, two] = [c + 2 * x * one - two, one];
    return Math.exp(chebyshev[0] + x * one - two);
  }

  // p: mu (Pa), nu, sigma0 (Pa), a, zeta, ell (m), H (m).
  function ofOneMaterial(p, limits) {
    const b = p.a + p.zeta;
    const ratio = p.a / b;
    const unit = (p.mu * p.ell) / ((1 - p.nu) * p.sigma0);
    const where = (condition, value) => (condition ? value : NaN);
    const sliding = where(p.zeta > 0, unit / p.zeta);
    const state = where(b > 0, unit / b);
    const layer = (length) => 2 * Math.PI * Math.sqrt(2 * p.H * length);
    const thin = (length) => where(2 * Math.PI * p.H < limits.thin * length, length);
    return {
      homogeneous_sliding: Math.PI * sliding,
      rice_ruina: (Math.PI / 4) * sliding,
      dieterich_shortest: (2 / Math.PI) * (1 - p.nu) * sliding,
      dieterich_longest: (4 / 3) * (1 - p.nu) * sliding,
      state_evolution: state,
      rubin_ampuero_localised: where(ratio < limits.localised, 2 * 1.3774 * state),
      rubin_ampuero_crack: where(ratio > limits.crack && ratio < 1, ((2 / Math.PI) * state) / (1 - ratio) ** 2),
      uenishi_rice: where(ratio < limits.negligible, limits.patch * state),
      creeping_asperity: limits.patch * sliding,
      loaded_patch: where(ratio < limits.nearest, (loaded(ratio, limits) * state) / (1 - ratio)),
      thin_limit: thin(layer(sliding)),
      thin_layer: thin(where(ratio < 0.5, layer(state))),
    };
  }

  // The same with those of two materials, of which mu* is M, where slip hardly changes the normal stress.
  function all(p, limits) {
    const { modulus, beta } = Tables.pair(p);
    const ofTwo = ofOneMaterial({ ...p, mu: modulus, nu: 0 }, limits);
    const valid = p.f * Math.abs(beta) < limits.negligible;
    const named = Object.entries(ofTwo).map(([key, length]) => [`${key}_two_materials`, valid ? length : NaN]);
    return { ...ofOneMaterial(p, limits), ...Object.fromEntries(named) };
  }

  return { all };
})();
