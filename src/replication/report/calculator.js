"use strict";
// The calculator: lengths of the fault in the fields. Their values stand in the page's address as the
// command line has them, shear-modulus=30GPa, and are read from it; a report has them in its data.
const NONE = { height: Infinity, second_height: Infinity, friction: 0, outside_zeta: null }; // of fields that are empty
const fields = Object.fromEntries(data.fields.map((field) => [field.key, field]));
const choice = (key) => element(key)?.value ?? "";
const plain = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
let unknown = []; // keys of the address that are no field's
const metres = (length) => `${Number(length.toPrecision(4))} m`;

// A field's value in SI units; what is wrong with it goes to a list.
function read({ key, label, optional, units, low, high, closed, range }, wrong) {
  const input = element(key);
  const text = input.value.trim();
  const empty = optional && text === "";
  const value = (text === "" ? NaN : Number(text)) * (units[choice(`unit-${key}`)] ?? 1);
  const above = value > low || (closed !== "" && closed !== "high" && value === low);
  const good = empty || (above && value < high);
  input.setAttribute("aria-invalid", String(!good));
  if (!good && text.includes(",")) {
    wrong.push(`${label}: write a decimal point in place of the comma in ${plain(text)}`);
  } else if (!good) {
    wrong.push(`${label} must lie in ${range}`);
  }
  return empty ? NONE[key] : value;
}

// Whether a body, of the prefix "" or "second_", is a layer, and its far side, which no half-space has.
function bounded(prefix) {
  const kind = prefix && choice("second_body");
  return kind !== "rigid" && choice(kind === "other" ? "second_height" : "height") !== "";
}
const farSide = (prefix) => (bounded(prefix) ? choice(`${prefix}far_side`) : "traction");

// Parameters as theory.js has them, and what is wrong.
function parameters() {
  const [wrong, kind] = [[], choice("second_body")];
  const used = data.fields.filter(({ key }) => kind === "other" || !key.startsWith("second_"));
  const v = Object.fromEntries(used.map((field) => [field.key, read(field, wrong)]));
  const inPlane = (nu) => (choice("plane") === "stress" ? nu / (1 + nu) : nu);
  const upper = { mu: v.shear_modulus, nu: inPlane(v.poisson_ratio), H: v.height, farSide: farSide("") };
  const other = { mu: v.second_shear_modulus, nu: inPlane(v.second_poisson_ratio), H: v.second_height };
  const second = { ...(kind === "other" ? other : upper), farSide: farSide("second_") || upper.farSide };
  const alike = Object.keys(upper).every((name) => upper[name] === second[name]);
  if (element("friction").value === "" && (kind === "rigid" || !alike)) {
    wrong.push("the friction coefficient is needed: where the bodies differ, slip changes the normal stress");
  }
  return [{
    ...upper, sigma0: v.normal_stress, a: v.a, zeta: v.b - v.a, ell: v.slip_distance, f: v.friction,
    V: v.velocity, outside: v.outside_zeta === null ? null : { zeta: v.outside_zeta, a: v.outside_a ?? v.a }, second: kind === "rigid" ? undefined : second,
  }, wrong];
}

// Names and texts of all that is given, for the address and the command line.
function words() {
  const text = (key) => (element(key).value === "" ? "" : element(key).value + choice(`unit-${key}`));
  const kind = choice("second_body");
  const other = ["second_shear_modulus", "second_poisson_ratio", "second_height"].map((key) => text(key) || "inf");
  const all = [
    ...Object.keys(fields).filter((key) => !key.startsWith("second_")).map((key) => [key, text(key)]),
    ["plane", choice("plane")],
    ["far_side", bounded("") ? choice("far_side") : ""],
    ["second_body", kind === "other" ? other.join(",") : kind],
    ["second_far_side", bounded("second_") ? choice("second_far_side") : ""],
  ];
  return all.filter(([, given]) => given !== "").map(([key, given]) => [key.replaceAll("_", "-"), given]);
}

function answer(p) {
  const own = Theory.scaled(p);
  const at = Theory.solve(own, own.reference);
  if (!(at.length > 0)) {
    return [at, [["No critical length", p.zeta > 0
      ? "sliding is stable: the bodies are stiffer than friction's critical stiffness at every wavelength"
      : "sliding is stable: friction does not weaken with slip rate, and slip changes the normal stress too little"]]];
  }
  // layers that are thick are half-spaces
  const thick = Math.min(p.H, p.second ? p.second.H : Infinity) > data.thick * at.length;
  const half = { heightRatio: Infinity };
  const bodies = thick ? { ...own, ...half, second: own.second && { ...own.second, ...half } } : own;
  if (p.zeta > 0) {
    at.stability = Stability.length(bodies, own.reference, at.length, data.stability);
    at.runaway = Patch.runaway(bodies, own.reference, at.stability, data.patch_tables, data.stability);
    at.patch = p.outside && Patch.smallest(bodies, at.length, data.patch_tables);
  }
  const frequency = p.V ? `${at.frequency.toPrecision(4)} rad/s`
    : `${Theory.solve({ ...own, V: p.ell }, own.reference).frequency.toPrecision(4)} V/D`;
  const over = (length) => (typeof length === "string" ? length
    : `${length.toPrecision(3)} m = ${(length / at.length).toFixed(2)} L<sub>c</sub>`);
  const rows = [
    ["Critical length L<sub>c</sub>", `${Number(at.length.toPrecision(5))} m`],
    ["Stability length of the patch L<sub>s</sub>", over(at.stability || Stability.why(bodies, data.stability))],
  ];
  if (at.runaway) rows.push(["Runaway length of the patch L<sub>run</sub>", over(at.runaway)]);
  if (at.patch) rows.push(["Smallest weakening patch W<sub>c</sub>", over(at.patch)]);
  const mode = [
    ["Critical wavenumber k<sub>c</sub> = 2π/L<sub>c</sub>", `${at.wavenumber.toPrecision(5)} rad/m`],
    ["Angular frequency ω of its mode", frequency],
  ];
  return [at, rows, mode];
}

// The lengths in use, by the systems that they are for; with two materials the pair's own come first.
function table(p, critical) {
  const found = Lengths.all(p, data.limits);
  const two = p.second && (p.second.mu !== p.mu || p.second.nu !== p.nu);
  const layered = Math.min(p.H, p.second ? p.second.H : Infinity) < Infinity;
  const spaces = [data.two_materials, data.half_spaces];
  const systems = new Set([...(two ? spaces : []), ...data.lengths.map(({ system }) => system)]);
  if (!two) systems.delete(data.two_materials);
  const { localised, crack } = data.limits;
  const ratio = p.a / (p.a + p.zeta);
  const beyond = (length) => (length.beyond && ratio >= localised && ratio <= crack ? `; ${length.beyond}` : "");
  const cells = (length) => {
    const [value, known] = [found[length.key], Number.isFinite(found[length.key])];
    return {
      Length: length.title, Value: known ? metres(value) : "–",
      "Over L_c": known && critical > 0 ? (value / critical).toPrecision(3) : "–",
      Formula: length.formula, Source: length.source,
      "Valid for": known ? length.validity : `not valid here: needs ${length.needs}${beyond(length)}`,
    };
  };
  return [...systems].map((system) => {
    const rows = data.lengths.filter((length) => length.system === system).map((length) => Object.entries(cells(length)));
    const line = (row) => row.map(([label, text]) => `<td data-label="${label}">${text.replaceAll("<", "&lt;")}</td>`).join("");
    const doubt = layered && spaces.includes(system) ? "; yours are not half-spaces" : "";
    return `<tbody><tr><th colspan="6" scope="colgroup">For ${system}${doubt}</th></tr>
      <tr class="heads">${rows[0].map(([label]) => `<th scope="col">${label}</th>`).join("")}</tr>
      ${rows.map((row) => `<tr>${line(row)}</tr>`).join("")}</tbody>`;
  }).join("");
}

function show() {
  element("second-fields").hidden = choice("second_body") !== "other";
  for (const prefix of ["", "second_"]) element(`of-${prefix}far_side`).hidden = !bounded(prefix);
  const [p, wrong] = parameters();
  const [at, values, mode = []] = wrong.length ? [{}, [[`No values: ${wrong.join("; ")}`, ""]]] : answer(p);
  const left = unknown.length ? [[`Not known in the address: ${plain(unknown.join(", "))}`, ""]] : [];
  showValues("values", [...values, ...left]);
  showValues("mode", mode);
  element("others").innerHTML = wrong.length ? "" : table(p, at.length);
  const given = words();
  element("command").textContent = `nucleation length ${given.map(([name, text]) => `--${name} ${text}`).join(" ")}`;
  if (!data.given) history.replaceState(null, "", `#${given.map(([name, text]) => `${name}=${encodeURIComponent(text)}`).join("&")}`);
}

// A text such as 30GPa into its field and unit; without a unit it is in SI units.
function put(key, text) {
  const parts = /^\s*([-+\d.e]*\d\.?)\s*([^\d]*)$/i.exec(text);
  element(key).value = parts ? parts[1] : "";
  const named = Object.entries(fields[key].units);
  const [unit] = named.find(([name, factor]) => (parts?.[2] ? name === parts[2].replace(/[µμ]/, "u") : factor === 1)) ?? [];
  if (parts && unit) element(`unit-${key}`).value = unit;
}

// Choose what the address has, if it is among the options.
function choose(key, value) {
  const options = [...element(key).options].map((option) => option.value);
  if (options.includes(value)) element(key).value = value;
  else unknown.push(`${key.replaceAll("_", "-")}=${value}`);
}

function readAddress() {
  const given = new URLSearchParams((data.given ?? location.hash.slice(1)).replaceAll("+", "%2B"));
  if (!given.size) return;
  const known = [...Object.keys(fields), "plane", "second_body", "far_side", "second_far_side"]
    .map((key) => key.replaceAll("_", "-"));
  unknown = [...given.keys()].filter((key) => !known.includes(key));
  for (const [key, { optional }] of Object.entries(fields)) {
    const text = given.get(key.replaceAll("_", "-"));
    if (text !== null || optional) put(key, text ?? ""); // what is needed keeps its value
  }
  const second = given.get("second-body") ?? "same";
  const other = second.split(",");
  choose("second_body", other.length > 1 ? "other" : second);
  if (other.length > 1) {
    ["second_shear_modulus", "second_poisson_ratio", "second_height"].forEach((key, i) => put(key, other[i] ?? ""));
  }
  choose("plane", given.get("plane") ?? "strain");
  choose("far_side", given.get("far-side") ?? "traction");
  choose("second_far_side", given.get("second-far-side") ?? "");
}

element("fault").addEventListener("submit", (event) => event.preventDefault());
element("fault").addEventListener("input", show);
if (!data.given) window.addEventListener("hashchange", () => { readAddress(); show(); });
readAddress();
show();
