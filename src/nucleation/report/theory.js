"use strict";
// The critical nucleation length of a block on a rigid base, computed in the page.
//
// The same theory as nucleation.theory: the neutral points of Eq. (5) with the transfer
// functions of Eq. (10). With q = k H, b = a + zeta, rho = f G2 / G1 and the stiffness
// s = mu ell / (sigma0 H), sliding is marginal where s q G1(q) = h(rho), and h is the upper root of
// (h - zeta)^2 = rho^2 h (b - h). Only s knows of the height, so that h / (q G1) is tabulated once
// for all heights. SI units; zeta > 0.
const Theory = (() => {
  const SATURATION = 25; // above this q the block is a half-space, to round-off
  const SMALLEST = 1e-6; // q at the lower end of the table
  const POINTS = 4000;

  // G1 and G2 of Eq. (10), numerators and denominator times exp(-2 q).
  function transfer(q, nu) {
    const decay = Math.exp(-2 * q);
    const sinh2q = -0.5 * Math.expm1(-4 * q);
    const sinhSquared = 0.25 * Math.expm1(-2 * q) ** 2;
    const square = q * q * decay;
    const below = 4 * (1 - nu) ** 2 * decay + square + (3 - 4 * nu) * sinhSquared;
    return {
      g1: (2 * (1 - nu) * (sinh2q + 2 * q * decay)) / below,
      g2: (2 * (square + (1 - 2 * nu) * sinhSquared)) / below,
    };
  }

  // The upper root h of the quadratic above.
  function marginalStiffness(rho, a, zeta) {
    const b = a + zeta;
    const root = Math.sqrt((rho * b) ** 2 + 4 * a * zeta);
    return (2 * zeta + rho * rho * b + rho * root) / (2 * (1 + rho * rho));
  }

  // The stiffness s at which q is marginal.
  function marginal(q, p) {
    const { g1, g2 } = transfer(Math.min(q, SATURATION), p.nu);
    return marginalStiffness((p.f * g2) / g1, p.a, p.zeta) / (q * g1);
  }

  // p: mu (Pa), nu, sigma0 (Pa), f, a, zeta, ell (m), V (m/s). Returns a function of the height (m).
  function solver(p) {
    const q = new Float64Array(POINTS);
    const stiffness = new Float64Array(POINTS);
    const ratio = Math.log(SATURATION / SMALLEST) / (POINTS - 1);
    for (let i = 0; i < POINTS; i += 1) {
      q[i] = SMALLEST * Math.exp(ratio * i);
      stiffness[i] = marginal(q[i], p);
    }
    return (height) => {
      const s = (p.mu * p.ell) / (p.sigma0 * height);
      return point(largestCrossing(s, p, q, stiffness), height, p);
    };
  }

  // The largest marginal q: sliding is stable above it, so that the search begins at the top.
  function largestCrossing(s, p, q, stiffness) {
    const top = (stiffness[POINTS - 1] * q[POINTS - 1]) / s; // G1, G2 are constant up there
    if (top >= SATURATION) return top;
    let i = POINTS - 1;
    while (i > 0 && stiffness[i] < s) i -= 1;
    let low = q[i];
    let high = q[Math.min(i + 1, POINTS - 1)];
    while (marginal(low, p) < s) {
      high = low;
      low /= 2;
    }
    for (let n = 0; n < 60; n += 1) {
      const middle = Math.sqrt(low * high);
      if (marginal(middle, p) > s) low = middle;
      else high = middle;
    }
    return Math.sqrt(low * high);
  }

  // Length, wavenumber and angular frequency at a marginal q; the frequency is the root of
  // a w^2 - rho b w - zeta = 0 that also fits s q G1 = b w^2 / (1 + w^2), w = omega ell / V.
  function point(q, height, p) {
    const { g1, g2 } = transfer(Math.min(q, SATURATION), p.nu);
    const rho = (p.f * g2) / g1;
    const b = p.a + p.zeta;
    const load = ((p.mu * p.ell) / (p.sigma0 * height)) * q * g1;
    const large = (rho * b + Math.sqrt((rho * b) ** 2 + 4 * p.a * p.zeta)) / (2 * p.a);
    const small = -p.zeta / (p.a * large);
    const misfit = (w) => Math.abs((b * w * w) / (1 + w * w) - load);
    const w = misfit(large) <= misfit(small) ? large : small;
    const wavenumber = q / height;
    return { length: (2 * Math.PI) / wavenumber, wavenumber, frequency: (w * p.V) / p.ell };
  }

  // Eq. (11), H k -> 0.
  function thinLength(height, p) {
    const modulus = p.mu / (1 - p.nu);
    return 2 * Math.PI * Math.sqrt((2 * height * modulus * p.ell) / (p.zeta * p.sigma0));
  }

  return { solver, thinLength, transfer };
})();
