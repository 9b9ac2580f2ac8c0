// The lengths of a fault between two bodies whose far sides are free, as the library has them.
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

// Stiffness of the bodies at a wavenumber over that of friction, mu D k G1 / sigma0.
const stiffness = (k, p) => (p.mu * p.D * k * transfer(k, p).g1) / p.sigma0;

// The same over its largest unstable value, the upper root h of (h - zeta)^2 = rho^2 h (b - h) with
// rho = f G2 / G1; modes with less than one grow.
function load(k, p) {
  const { g1, g2 } = transfer(k, p);
  const rho = Math.abs((p.f * g2) / g1);
  const root = Math.sqrt((rho * p.b) ** 2 + 4 * p.a * p.zeta);
  const marginal = (2 * p.zeta + rho * rho * p.b + rho * root) / (2 * (1 + rho * rho));
  return stiffness(k, p) / marginal;
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

// L_pz (m): one over the wavenumber at which the bodies are as stiff as b.
function processZone(p, critical) {
  let [low, high] = [1e-3 / critical, 1e9 / critical];
  for (let n = 0; n < 100; n += 1) {
    const middle = Math.sqrt(low * high);
    if (stiffness(middle, p) > p.b) high = middle;
    else low = middle;
  }
  return 1 / low;
}

// The bodies that tables know, null for others.
function bodies(p) {
  if (!p.second) return "rigid_base";
  return ["mu", "nu", "H"].every((name) => p[name] === p.second[name]) ? "identical_layers" : null;
}

// Where a fault lies on the axes of the tables.
function placeOf(p) {
  const unit = (p.mu * p.D) / ((1 - p.nu) * p.b * p.sigma0);
  const [shortest, tallest] = data.heights;
  const place = (Math.min(Math.max(p.H / unit, shortest), tallest) / data.centre) ** data.power;
  return {
    place: (place - 1) / (place + 1), zeta_over_a: Math.log(p.zeta / p.a), nu: p.nu, f: p.f,
    coupling: p.f * contrast(p).beta, f_over_a: Math.log(p.f / p.a), noise: Math.log((p.strength * p.f) / p.a),
  };
}

// The quantities of a table between its nodes, null outside of its ends.
function interpolated(table, at) {
  const inside = ([name, [low, high]]) => name === "place" || (at[name] >= low && at[name] <= high);
  if (!table || !Object.entries(table.ends).every(inside)) return null;
  const shares = (x, nodes) => nodes.map((own) => nodes.reduce(
    (product, other) => (own === other ? product : (product * (x - other)) / (own - other)), 1));
  const axes = Object.entries(table.nodes).reverse(); // the last axis first
  return table.logs.map((logs) => {
    let values = logs;
    for (const [name, nodes] of axes) {
      const weights = shares(at[name], nodes);
      const sums = new Array(values.length / nodes.length).fill(0);
      values.forEach((value, i) => { sums[Math.floor(i / nodes.length)] += value * weights[i % nodes.length]; });
      values = sums;
    }
    return Math.exp(values[0]);
  });
}

// L_s (m), null where there is none.
function stabilityLength(p, critical) {
  const alike = bodies(p) === "identical_layers";
  const thick = !alike && Math.min(p.H, p.second ? p.second.H : Infinity) > data.thick * critical;
  const found = interpolated(data.tables.stability[thick ? "half_spaces" : bodies(p)], placeOf(p));
  if (!found) return null;
  const [ratio] = found;
  return ratio * (thick ? (Math.PI * contrast(p).modulus * p.D) / (p.zeta * p.sigma0) : critical);
}

// L_run (m) with its range, null where friction weakens too much or no table has it.
function runawayLength(p, critical, stable, zone) {
  const found = interpolated(data.tables.runaway[bodies(p)], placeOf(p));
  if (!found || stable === null || p.zeta >= data.weak * p.a) return null;
  const [value] = found.map((ratio) => ratio * stable);
  const error = Math.max((data.error * critical) / (2 * Math.PI * zone), data.least_error);
  return { value, low: value * (1 - error), high: value * (1 + error) };
}

// L (m) with its range, as nucleation.drop has it; null where it has none without a doubt.
function dropLength(p, stable, runaway) {
  const found = interpolated(data.tables.law[bodies(p)], placeOf(p));
  const weak = p.zeta < data.weak * p.a;
  if (!found || stable === null || (weak && !runaway)) return null;
  const [early, median, late, effective, grown] = found;
  const slow = runaway ?? { value: 0, low: 0, high: 0 };
  const slipsSlowly = slow.value > median * stable;
  if (effective * data.caution > data.strongest || (!slipsSlowly && grown < data.slowest_growth * data.caution)) return null;
  const margin = weak ? data.margins.weak : data.margins.strong;
  return {
    value: Math.max(median * stable, slow.value),
    low: Math.max(early * stable, slow.low) * (1 - margin.earlier),
    high: Math.max(late * stable, slow.high) * (1 + margin.later),
    slipsSlowly,
  };
}

const form = document.getElementById("fault");
const show = (id, text) => { document.getElementById(id).textContent = text; };

// The value of an input in SI units, and as the command takes it; what is wrong with it goes to a list.
function read(input, wrong) {
  const { name } = input;
  const { low, high, closed, unit, description, bounds, units } = data.quantities[name];
  const text = input.value.trim().replace(/[µμ]/, "u");
  const [, number, given] = /^([+-]?(?:(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?|inf))\s*([a-z]*)$/i.exec(text) ?? [];
  const size = number === undefined ? NaN : Number(number.replace(/inf/i, "Infinity"));
  const value = given ? size * (units[given] ?? NaN) : size;
  const inside = (closed[0] === "[" ? value >= low : value > low) && (closed[1] === "]" ? value <= high : value < high);
  input.setAttribute("aria-invalid", String(!inside));
  if (!inside) {
    const reason = text === "" ? "; it is missing"
      : /^[\d.]*,[\d.]+/.test(text) ? "; write a decimal point in place of the comma"
      : number === undefined ? "; it is no number with a unit"
      : given && !Object.hasOwn(units, given) ? `; ${given} is no unit that is known here${unit === "1" ? ", it has none" : `: ${Object.keys(units).join(", ")}`}`
      : "";
    wrong.push(`${name} = '${input.value.trim()}' is not allowed: ${description} must lie in ${bounds}${reason}.`);
  }
  return { value, text: `${number}${given}` };
}

// Everything about the fault in the form.
function answer() {
  const wrong = [];
  const rigid = form.elements.second_body.value === "rigid";
  const v = {};
  const words = rigid ? ["--second-body rigid"] : [];
  for (const input of form.querySelectorAll("input")) {
    const ofSecond = input.name.startsWith("second_");
    if (ofSecond && (rigid || input.value.trim() === "")) {
      input.setAttribute("aria-invalid", "false");
      v[input.name] = v[input.name.replace("second_", "")];
      continue;
    }
    const { value, text } = read(input, wrong);
    v[input.name] = value;
    if (input.name !== "height" || value !== Infinity) words.push(`--${input.name.replaceAll("_", "-")} ${text}`);
  }
  const body = (prefix) => ({ mu: v[`${prefix}shear_modulus`], nu: v[`${prefix}poisson_ratio`], H: v[`${prefix}height`] });
  const second = rigid || v.second_shear_modulus === Infinity ? undefined : body("second_");
  const p = { ...body(""), second, a: v.a, b: v.b, zeta: v.b - v.a, f: v.friction, D: v.slip_distance, sigma0: v.normal_stress, strength: v.strength };
  if (p.zeta <= 0) wrong.push("b must exceed a: else friction does not weaken with slip rate, and sliding is stable between bodies that are alike.");
  if (wrong.length) return { wrong };
  const critical = criticalLength(p);
  const zone = processZone(p, critical);
  const stability = stabilityLength(p, critical);
  const runaway = runawayLength(p, critical, stability, zone);
  const drop = dropLength(p, stability, runaway);
  const secondBody = data.second_body[!second ? "rigid" : bodies(p) ? "alike" : "other"];
  const weak = p.zeta < data.weak * p.a;
  return { wrong, drop, stability, critical, runaway, weak, zone, strength: p.strength, secondBody, command: `nucleation length ${words.join(" ")}` };
}

// A length with its range (m), in the digits that the range leaves.
function withRange({ value, low, high }) {
  const digits = Math.min(Math.max(-Math.floor(Math.log10(0.5 * (high - low))), 0), 20);
  return `${value.toFixed(digits)} m (${low.toFixed(digits)} to ${high.toFixed(digits)} m)`;
}

// A relative strength as people write it: 1e-4.
const short = (strength) => strength.toExponential();

function update() {
  const rigid = form.elements.second_body.value === "rigid";
  for (const input of form.querySelectorAll("input[name^=second_]")) input.labels[0].classList.toggle("hidden", rigid);
  const { wrong, drop, stability, critical, runaway, weak, zone, strength, secondBody, command } = answer();
  const metres = (length) => `${Number(length.toPrecision(4))} m`;
  const ranged = ({ value, low, high }) => `${metres(value)} (${metres(low).slice(0, -2)} to ${metres(high)})`;
  const noise = strength && `${data.noise} ${short(strength)}`;
  show("wrong", wrong.join("\n"));
  show("sentence", wrong.length ? "" : drop ? `The patch runs away at ${withRange(drop)} ${noise}.`
    : "L, at which the patch runs away: use the command below. This page has no number for this fault.");
  show("remark", drop?.slipsSlowly ? `${data.slow_slip}.` : "");
  show("setting", wrong.length ? "" : `${secondBody} ${data.friction_law}`);
  show("command", wrong.length ? "" : command);
  const rows = wrong.length ? [] : [
    ["L", "drop_length", drop], ["L_s", "stability_length", stability], ["L_c", "critical_length", critical],
    ["L_run", "runaway_length", runaway], ["L_pz", "process_zone", zone],
  ];
  document.querySelector("#answers tbody").replaceChildren(...rows.map(([symbol, key, found]) => {
    const row = document.createElement("tr");
    row.id = key;
    const [value, text] = typeof found === "number" ? [found, metres(found)] : found ? [found.value, ranged(found)]
      : [null, key === "runaway_length" && !weak ? `only for zeta/a < ${data.weak}` : "use the command"];
    const cells = [symbol, text, value === null ? "" : `${Number((value / critical).toPrecision(3))}`, data.meanings[key]];
    for (const cell of cells) row.insertCell().textContent = cell;
    return row;
  }));
  history.replaceState(null, "", `#${new URLSearchParams(new FormData(form))}`);
}

for (const [name, value] of new URLSearchParams(location.hash.slice(1))) {
  const field = form.elements.namedItem(name);
  if (field) field.value = value;
}
form.addEventListener("input", update);
form.addEventListener("submit", (event) => event.preventDefault());
update();
