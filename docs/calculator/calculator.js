"use strict";
// L_c and L_s of a fault between two bodies whose far sides are free, as nucleation.theory has them.
const LARGEST = 25; // of q = k H: above it a layer is a half-space, to round-off

// sinh(x) - x times exp(-x), without cancellation.
function sinhExcess(x) {
  if (x >= 1) return -0.5 * Math.expm1(-2 * x) - x * Math.exp(-x);
  let series = 1;
  for (let n = 17; n > 3; n -= 2) series = 1 + (series * x * x) / ((n - 1) * n);
  return ((x * x * x) / 6) * series * Math.exp(-x);
}

// Stiffness of a layer at q = k H over mu k, and its determinant (Eq. 10).
function layer(number, nu) {
  const q = Math.min(number, LARGEST);
  const decay = Math.exp(-2 * q); // all terms are times this
  const c = 4 * (1 - nu);
  const sinhSquared = 0.25 * Math.expm1(-2 * q) ** 2;
  const square = q * q * decay;
  const squareExcess = sinhExcess(q) * (-0.5 * Math.expm1(-2 * q) + q * Math.exp(-q));
  const below = (c * c * decay) / 2 + 2 * square + 2 * (3 - 4 * nu) * sinhSquared;
  return {
    xx: (c * (-0.5 * Math.expm1(-4 * q) + 2 * q * decay)) / below,
    xy: (4 * (square + (1 - 2 * nu) * sinhSquared)) / below,
    yy: (c * sinhExcess(2 * q)) / below,
    det: (8 * squareExcess) / below,
  };
}

// G1 and G2 of both bodies over the upper one's modulus at the wavenumber k (1/m); H may be Infinity.
function transfer(k, p) {
  const a = layer(k * p.H, p.nu);
  if (!p.second) return { g1: a.xx, g2: a.xy };
  const r = p.second.mu / p.mu;
  const b = layer(k * p.second.H, p.second.nu);
  const joint = a.det + r * (a.xx * b.yy + a.yy * b.xx + 2 * a.xy * b.xy) + r * r * b.det;
  const [shareA, shareB] = [(r * r * b.det) / joint, (r * a.det) / joint];
  return { g1: shareA * a.xx + shareB * b.xx, g2: shareA * a.xy - shareB * b.xy };
}

// Load mu D k G1 / sigma0 of a wavenumber over its largest unstable value, the upper root h of
// (h - zeta)^2 = rho^2 h (b - h) with rho = f G2 / G1; modes with less than one grow.
function load(k, p) {
  const { g1, g2 } = transfer(k, p);
  const rho = Math.abs((p.f * g2) / g1);
  const root = Math.sqrt((rho * p.b) ** 2 + 4 * p.a * p.zeta);
  const marginal = (2 * p.zeta + rho * rho * p.b + rho * root) / (2 * (1 + rho * rho));
  return (p.mu * p.D * k * g1) / (p.sigma0 * marginal);
}

// L_c (m): the shortest unstable wavelength. Layers matter below the k at which both saturate.
function criticalLength(p) {
  let high = LARGEST / Math.min(p.H, p.second ? p.second.H : Infinity);
  if (!(load(high, p) > 1)) return (2 * Math.PI * load(1e15, p)) / 1e15; // half-spaces: linear in k
  let low = high;
  while (load(low, p) > 1) [high, low] = [low, low / 1.003];
  for (let n = 0; n < 60; n += 1) {
    const middle = Math.sqrt(low * high);
    if (load(middle, p) > 1) high = middle;
    else low = middle;
  }
  return (2 * Math.PI) / low;
}

// M (Pa) and beta of the bodies as half-spaces, Eq. (8).
function contrast(p) {
  const [softness, nu2] = p.second ? [p.mu / p.second.mu, p.second.nu] : [0, 0];
  const total = 1 - p.nu + (1 - nu2) * softness;
  const beta = (0.5 * (1 - 2 * p.nu - (1 - 2 * nu2) * softness)) / total;
  return { modulus: (2 * p.mu) / ((1 - beta ** 2) * total), beta };
}

// L_s (m) between the nodes of a table, null where there is none.
function stabilityLength(p, critical) {
  const thick = Math.min(p.H, p.second ? p.second.H : Infinity) > data.thick * critical;
  const alike = p.second && ["mu", "nu", "H"].every((name) => p[name] === p.second[name]);
  const { modulus, beta } = contrast(p);
  const unit = (p.mu * p.D) / ((1 - p.nu) * p.b * p.sigma0);
  const [shortest, tallest] = data.heights;
  const place = (Math.min(Math.max(p.H / unit, shortest), tallest) / data.centre) ** data.power;
  const at = { place: (place - 1) / (place + 1), zeta_over_a: Math.log(p.zeta / p.a), nu: p.nu, f: p.f, coupling: p.f * beta };
  const table = data.tables[thick ? "half_spaces" : p.second ? alike && "identical_layers" : "rigid_base"];
  const inside = ([name, [low, high]]) => name === "place" || (at[name] >= low && at[name] <= high);
  if (!table || !Object.entries(table.ends).every(inside)) return null;
  const shares = (x, nodes) => nodes.map((own) => nodes.reduce(
    (product, other) => (own === other ? product : (product * (x - other)) / (own - other)), 1));
  let values = table.logs;
  for (const [name, nodes] of Object.entries(table.nodes).reverse()) { // the last axis first
    const weights = shares(at[name], nodes);
    const sums = new Array(values.length / nodes.length).fill(0);
    values.forEach((value, i) => { sums[Math.floor(i / nodes.length)] += value * weights[i % nodes.length]; });
    values = sums;
  }
  return Math.exp(values[0]) * (thick ? (Math.PI * modulus * p.D) / (p.zeta * p.sigma0) : critical);
}

const data = JSON.parse(document.getElementById("data").textContent);
const form = document.getElementById("fault");
const UNITS = { "": 1, Pa: 1, kPa: 1e3, MPa: 1e6, GPa: 1e9, m: 1, km: 1e3, cm: 1e-2, mm: 1e-3, um: 1e-6 };

// The value of an input in SI units; what is wrong with it goes to a list.
function read(input, wrong) {
  const text = input.value.trim().replace(/[µμ]/, "u");
  const [, number, unit] = /^([-+\d.e]+?)\s*([a-z]*)$/i.exec(text) ?? [];
  const value = text === "" && "empty" in input.dataset ? Number(input.dataset.empty) : Number(number) * UNITS[unit];
  const fits = unit === "" || unit === undefined || (input.dataset.unit && unit.endsWith(input.dataset.unit));
  const good = fits && value >= Number(input.min) && (value <= Number(input.max) || value === Number(input.dataset.empty));
  input.setAttribute("aria-invalid", String(!good));
  if (!good) wrong.push(`${input.labels[0].textContent.trim()} must lie in [${input.min}, ${input.max}] ${input.dataset.unit ?? ""}`
    + (text.includes(",") ? ": write a decimal point in place of the comma" : ""));
  return value;
}

function answer() {
  const wrong = [];
  const [kind, v] = [form.elements.second_body.value, {}];
  const inputs = [...form.querySelectorAll("input")].filter(({ name }) => kind === "other" || !name.startsWith("second_"));
  for (const input of inputs) v[input.name] = read(input, wrong);
  const body = (prefix) => ({ mu: v[`${prefix}shear_modulus`], nu: v[`${prefix}poisson_ratio`], H: v[`${prefix}height`] });
  const second = { same: body(""), rigid: undefined, other: body("second_") }[kind];
  const p = { ...body(""), second, a: v.a, b: v.b, zeta: v.b - v.a, f: v.friction, D: v.slip_distance, sigma0: v.normal_stress };
  if (p.zeta <= 0) wrong.push("b must exceed a: else sliding is stable between bodies that are alike");
  if (wrong.length) return { wrong };
  const critical = criticalLength(p);
  return { wrong, critical, stability: stabilityLength(p, critical) };
}

function show() {
  document.getElementById("second").hidden = form.elements.second_body.value !== "other";
  const { wrong, critical, stability } = answer();
  const metres = (length) => `${Number(length.toPrecision(4))} m`;
  document.getElementById("critical").textContent = wrong.length ? "" : metres(critical);
  document.getElementById("stability").textContent = wrong.length ? ""
    : stability === null ? "not in these tables: the command nucleation length computes it" : metres(stability);
  document.getElementById("wrong").textContent = wrong.join("; ");
  history.replaceState(null, "", `#${new URLSearchParams(new FormData(form))}`);
}

for (const [name, value] of new URLSearchParams(location.hash.slice(1))) {
  if (name in form.elements) form.elements[name].value = value;
}
form.addEventListener("input", show);
show();
