"use strict";
// The critical nucleation length of a body on a rigid base or on a second body, computed in the page.
//
// The same theory as nucleation.theory: the neutral points of Eq. (5) with the transfer functions of
// both bodies, each with the condition on its own far side (Eq. 10 for free ones). With q = k H, b =
// a + zeta, rho = f G2 / G1 and the stiffness s = mu ell / (sigma0 H), sliding is marginal where s q
// G1(q) = h(rho), and h is the upper root of (h - zeta)^2 = rho^2 h (b - h). H is a reference height
// that both bodies' have given ratios to. SI units.
const Theory = (() => {
  const SATURATION = 25; // above this q the block is a half-space, to round-off
  const SMALLEST = 1e-6; // q down to which the search has POINTS places
  const LEAST = 1e-15; // of the search: no layer under traction is as thin
  const POINTS = 4000;

  // sinh(x) - x times exp(-x), without cancellation.
  function sinhExcess(x) {
    if (x >= 1) return -0.5 * Math.expm1(-2 * x) - x * Math.exp(-x);
    let series = 1;
    for (let n = 17; n > 3; n -= 2) series = 1 + (series * x * x) / ((n - 1) * n);
    return ((x * x * x) / 6) * series * Math.exp(-x);
  }

  // Stiffness of a layer by the condition on its far side, dimensionless; nucleation.theory.stiffness.
  // Numerators and denominators are times exp(-2 q).
  const FAR_SIDES = {
    free(w, nu) {
      const c = 4 * (1 - nu);
      const below = (c * c * w.decay) / 2 + 2 * w.square + 2 * (3 - 4 * nu) * w.sinhSquared;
      return {
        xx: (c * (w.sinh2q + w.linear)) / below,
        xy: (4 * (w.square + (1 - 2 * nu) * w.sinhSquared)) / below,
        yy: (c * w.excess) / below,
        det: (8 * w.squareExcess) / below,
      };
    },
    velocity(w, nu) {
      const below = (3 - 4 * nu) * w.sinh2q + w.linear;
      return {
        xx: (8 * (1 - nu) * w.coshSquared) / below,
        xy: (2 * (w.linear + (1 - 2 * nu) * w.sinh2q)) / below,
        yy: (8 * (1 - nu) * w.sinhSquared) / below,
        det: (4 * w.excess) / below,
      };
    },
    clamped(w, nu) {
      const less = 2 * (1 - 2 * nu);
      const below = 4 * (1 - nu) * less * w.sinhSquared + w.squareExcess;
      return {
        xx: (2 * (1 - nu) * (less * w.sinh2q + w.excess)) / below,
        xy: (2 * (2 * (1 - nu) * (1 - 4 * nu) * w.sinhSquared + w.squareExcess)) / below,
        yy: (2 * (1 - nu) * ((3 - 4 * nu) * w.sinh2q + w.linear)) / below,
        det: (4 * ((3 - 4 * nu) * w.sinhSquared + w.square + 4 * (1 - nu) ** 2 * w.decay)) / below,
      };
    },
    roller(w, nu) {
      const below = 2 * (1 - 2 * nu) * w.sinh2q + w.excess;
      return {
        xx: (8 * (1 - nu) * w.sinhSquared) / below,
        xy: (2 * (w.excess - 2 * nu * w.sinh2q)) / below,
        yy: (8 * (1 - nu) * w.coshSquared) / below,
        det: (4 * (w.sinh2q + w.linear)) / below,
      };
    },
  };
  FAR_SIDES.traction = FAR_SIDES.free;

  function layer(number, nu, farSide) {
    const q = Math.min(number, SATURATION);
    const decay = Math.exp(-2 * q);
    return FAR_SIDES[farSide](
      {
        decay,
        linear: 2 * q * decay,
        square: q * q * decay,
        sinh2q: -0.5 * Math.expm1(-4 * q),
        sinhSquared: 0.25 * Math.expm1(-2 * q) ** 2,
        coshSquared: 0.25 * (1 + decay) ** 2,
        excess: sinhExcess(2 * q),
        squareExcess: sinhExcess(q) * (-0.5 * Math.expm1(-2 * q) + q * Math.exp(-q)),
      },
      nu,
    );
  }

  // G1 and G2, normalised by the upper body's modulus, at q = k H. The upper body's height is
  // p.heightRatio H, by default H. Without p.second the base is rigid; it has mu (Pa), nu,
  // heightRatio and farSide.
  function transfer(q, p) {
    const a = layer(q * (p.heightRatio ?? 1), p.nu, p.farSide || "free");
    if (!p.second) return { g1: a.xx, g2: a.xy };
    const r = p.second.mu / p.mu;
    const b = layer(q * p.second.heightRatio, p.second.nu, p.second.farSide || "free");
    const joint = a.det + r * (a.xx * b.yy + a.yy * b.xx + 2 * a.xy * b.xy) + r * r * b.det;
    const [shareA, shareB] = [(r * r * b.det) / joint, (r * a.det) / joint];
    return { g1: shareA * a.xx + shareB * b.xx, g2: shareA * a.xy - shareB * b.xy };
  }

  // The upper root h of the quadratic above, NaN without one.
  function marginalStiffness(signed, a, zeta) {
    const [rho, b] = [Math.abs(signed), a + zeta];
    const root = Math.sqrt((rho * b) ** 2 + 4 * a * zeta);
    return (2 * zeta + rho * rho * b + rho * root) / (2 * (1 + rho * rho));
  }

  // The stiffness s at which q is marginal, zero where none is.
  function marginal(q, p) {
    const { g1, g2 } = transfer(q, p);
    return Math.max(marginalStiffness((p.f * g2) / g1, p.a, p.zeta) / (q * g1), 0) || 0;
  }

  // Whether a mode grows: with zeta < 0 the load also has to exceed the lower root of the quadratic.
  function grows(q, s, p) {
    const { g1, g2 } = transfer(q, p);
    const [load, rho] = [s * q * g1, (p.f * g2) / g1];
    if (p.zeta < 0) return (load - p.zeta) ** 2 < rho ** 2 * load * (p.a + p.zeta - load);
    return load < marginalStiffness(rho, p.a, p.zeta);
  }

  // p with the heights H and second.H (m, Infinity of half-spaces) as ratios to a reference height.
  function scaled(p) {
    const least = Math.min(p.H, p.second ? p.second.H : Infinity);
    const reference = Number.isFinite(least) ? least : 1;
    const second = p.second && { ...p.second, heightRatio: p.second.H / reference };
    return { ...p, heightRatio: p.H / reference, second, reference };
  }

  // The critical point of p at a height H (m), by the largest marginal q; NaN without one. Sliding is
  // stable above it, so that the search begins at the top. p: mu (Pa), nu, sigma0 (Pa), f, a, zeta,
  // ell (m), V (m/s).
  function solve(p, height) {
    const s = (p.mu * p.ell) / (p.sigma0 * height);
    const highest = SATURATION / Math.min(1, p.heightRatio ?? 1, p.second ? p.second.heightRatio : 1);
    const top = (marginal(highest, p) * highest) / s; // G1, G2 are constant up there
    if (top >= highest) return point(top, height, p);
    const ratio = (highest / SMALLEST) ** (1 / POINTS);
    let [low, high] = [highest, highest];
    while (!grows(low, s, p)) {
      high = low;
      low /= low > SMALLEST ? ratio : 2;
      if (low < LEAST) return point(NaN, height, p);
    }
    for (let n = 0; n < 60; n += 1) {
      const middle = Math.sqrt(low * high);
      if (grows(middle, s, p)) low = middle;
      else high = middle;
    }
    return point(Math.sqrt(low * high), height, p);
  }

  // Length, wavenumber and angular frequency at a marginal q; the frequency is the root of
  // a w^2 - rho b w - zeta = 0 that also fits s q G1 = b w^2 / (1 + w^2), w = omega ell / V.
  function point(q, height, p) {
    const { g1, g2 } = transfer(q, p);
    const signed = (p.f * g2) / g1;
    const rho = Math.abs(signed); // the sign turns the wave round
    const b = p.a + p.zeta;
    const load = ((p.mu * p.ell) / (p.sigma0 * height)) * q * g1;
    const large = (rho * b + Math.sqrt((rho * b) ** 2 + 4 * p.a * p.zeta)) / (2 * p.a);
    const small = -p.zeta / (p.a * large);
    const misfit = (w) => Math.abs((b * w * w) / (1 + w * w) - load);
    const w = (misfit(small) + 1e-9 * load < misfit(large) ? small : large) * (signed < 0 ? -1 : 1);
    const wavenumber = q / height;
    return { length: (2 * Math.PI) / wavenumber, wavenumber, frequency: (w * p.V) / p.ell };
  }

  return { scaled, solve };
})();
