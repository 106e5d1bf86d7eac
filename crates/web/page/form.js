// The form: fields ↔ the scenario and the request. The scenario that was opened stays as it is where the form has no field.

import { element } from "./chart.js";
import { FIELDS, field, fields, known, numeric, put, reach, tellFrequencies, text, value } from "./fields.js";

const byId = (id) => document.getElementById(id);

let opened = {};
let different = null;

export function build(about) {
  known.about = about;
  fields.clear();
  for (const [place, list] of Object.entries(FIELDS)) byId(place).replaceChildren(...list.map(field));
  const fill = (id, options) => fields.get(id).input.replaceChildren(...options.map(([key, name]) => element("option", { value: key }, name)));
  const named = (list) => list.map((one) => [one.name, one.name]);
  fill("consist", [...named(about.consists), ...named(about.cars), ["own", "cars as data, below"], ["other", "as in the file that was opened"]]);
  fill("track-type", [...named(about.tracks), ["other", "as in the file that was opened"]]);
  fill("spectrum", [["none", "none: smooth"], ...named(about.spectra), ["other", "as in the file that was opened"]]);
  const trains = element("datalist", { id: "known-trains" }, ...["hslm-a", "annex-d", "en15528"].map((name) => element("option", { value: name })), ...about.trains.map((train) => element("option", { value: train.name }, train.title)));
  byId("train").append(trains);
  const limits = about.limits.map((one) => element("label", { title: one.title }, element("input", { type: "checkbox", name: "limits", value: one.name, checked: about.default_limits.includes(one.name) }), one.name));
  byId("limits").replaceChildren(element("p", { class: "hint", id: "limits-title" }, "Limits that judge"), element("div", { class: "checks", role: "group", "aria-labelledby": "limits-title" }, ...limits));
  empty();
}

// As a page that nobody has touched.
export function empty() {
  opened = {};
  different = null;
  for (const of of fields.values()) if (!of.choices && !of.check) of.input.value = "";
  byId("kind").value = "simple";
  fields.get("count").input.value = "1";
  fields.get("cars-count").input.value = "1";
  fields.get("trains").input.value = "hslm-a";
  fields.get("seeds").input.value = "1";
  fields.get("shortest").input.value = "3";
  fields.get("longest").input.value = "80";
  fields.get("heading").input.value = "forward";
  for (const id of ["axles", "cars"]) byId(id).value = "";
  arrange();
}

const acts = () => document.querySelector("input[name=acts]:checked").value;

// Shows what belongs to the choices.
export function arrange() {
  const beams = ["simple", "continuous"].includes(byId("kind").value);
  byId("equal").hidden = !beams || different !== null;
  byId("spans").hidden = !beams || different === null;
  byId("different").hidden = !beams;
  byId("different").textContent = different === null ? "Different spans …" : "Equal spans";
  for (const of of fields.values()) of.box.hidden = Boolean(of.acts) && of.acts !== acts();
  const rough = acts() === "vehicles" && text("spectrum") !== "none";
  for (const id of ["seeds", "shortest", "longest"]) fields.get(id).box.hidden = !rough || (text("spectrum") === "other" && id !== "seeds");
  for (const id of ["first_frequency", "bending_stiffness"]) fields.get(id).box.hidden = text("stiffness") !== id;
  if (different !== null) rows();
  tellFrequencies();
}

function rows() {
  const by = text("stiffness");
  const columns = [["length", "Length, m"], [by, by === "first_frequency" ? "n₀, Hz" : "EI, N m²"], ["mass", "Mass, kg/m"]];
  const place = byId("spans");
  if (place.dataset.shown === `${different.length} ${by}` && place.contains(document.activeElement)) return;
  place.dataset.shown = `${different.length} ${by}`;
  place.replaceChildren(...different.map((span, i) => {
    const cells = columns.map(([key, label]) => {
      const input = element("input", { type: "text", inputmode: "decimal", "aria-label": `Span ${i + 1}: ${label}`, "data-path": `$.bridge.structure.spans[${i}].${key}`, placeholder: label });
      input.value = span[key] ?? "";
      input.addEventListener("input", () => { span[key] = input.value.trim(); });
      return element("label", {}, i ? "" : label, input);
    });
    const remove = element("button", { type: "button", "aria-label": `Remove span ${i + 1}` }, "✕");
    remove.addEventListener("click", () => { different.splice(i, 1); changed(); });
    return element("div", { class: "spans-row" }, ...cells, remove);
  }), element("p", { class: "told", id: "spans-told" }));
  const add = element("button", { type: "button" }, "Add a span");
  add.addEventListener("click", () => { different.push({ ...(different.at(-1) ?? {}) }); changed(); });
  place.append(element("p", { class: "row" }, add));
}

export function changed() {
  arrange();
  byId("form").dispatchEvent(new Event("input", { bubbles: true }));
}

export function toggleDifferent() {
  if (different === null) {
    const one = { length: text("length"), mass: text("mass"), first_frequency: text("first_frequency"), bending_stiffness: text("bending_stiffness") };
    different = Array.from({ length: Math.max(1, Math.min(200, numeric("count") || 1)) }, () => ({ ...one }));
  } else {
    const first = different[0] ?? {};
    fields.get("count").input.value = different.length || 1;
    for (const key of ["length", "mass", "first_frequency", "bending_stiffness"]) fields.get(key).input.value = first[key] ?? "";
    different = null;
  }
  changed();
}

function spans(kind) {
  const by = text("stiffness");
  const shear = value(text("shear"));
  const typed = different ?? Array.from({ length: Math.max(0, Math.min(1000, Math.floor(numeric("count")) || 0)) }, () => Object.fromEntries(["length", "mass", by].map((key) => [key, text(key)])));
  return typed.map((one) => {
    const span = { length: value(one.length ?? ""), mass: value(one.mass ?? "") };
    // The first frequency of a continuous beam belongs to the whole beam.
    if (!(kind === "continuous" && by === "first_frequency")) span[by] = value(one[by] ?? "");
    if (shear !== undefined) span.shear_stiffness = shear;
    return JSON.parse(JSON.stringify(span));
  });
}

// Scenario and request as the form says.
export function collect(axles) {
  const scenario = structuredClone(opened);
  const kind = byId("kind").value;
  if (kind === "simple" || kind === "continuous") {
    const structure = { type: "beams", spans: spans(kind) };
    if (kind === "continuous") {
      structure.continuous = true;
      if (text("stiffness") === "first_frequency") {
        structure.first_frequency = value(different ? (different[0]?.first_frequency ?? "") : text("first_frequency"));
        if (structure.first_frequency === undefined) delete structure.first_frequency;
      }
    }
    scenario.bridge = { ...(scenario.bridge ?? {}), structure };
  } else if (kind !== "other") {
    scenario.bridge = { ...(scenario.bridge ?? {}), structure: { type: "frame", frame: kind } };
  }
  if (kind !== "other" || text("ratio") !== "") {
    put(scenario, "bridge.damping", { type: "rayleigh", ...(scenario.bridge?.damping?.type === "rayleigh" ? scenario.bridge.damping : {}) });
  }
  for (const of of fields.values()) if (of.at && !of.at.startsWith("spans.") && !of.at.startsWith("irregularity")) put(scenario, of.at, value(text(of.id), of.factor));
  if (scenario.bridge?.damping?.at && Object.keys(scenario.bridge.damping.at).length === 0) delete scenario.bridge.damping.at;
  if (scenario.time && Object.keys(scenario.time).length === 0) delete scenario.time;
  const request = demand(scenario, axles);
  // The order of the documentation.
  const order = ["title", "train", "contact", "track", "irregularity", "bridge", "time", "coupling", "output", "fmus"];
  const sorted = Object.fromEntries([...Object.keys(scenario).filter((key) => !order.includes(key)), ...order.filter((key) => key in scenario)].map((key) => [key, scenario[key]]));
  return { scenario: sorted, request };
}

function demand(scenario, axles) {
  const [speeds, vehicles] = [text("speeds"), acts() === "vehicles"];
  const request = { trains: [], heading: text("heading"), way: vehicles ? "coupled" : "auto", refine: fields.get("refine").input.checked, variants: fields.get("variants").input.checked ? "bounds" : "" };
  if (speeds !== "") request.speeds = speeds;
  const first = Number(/^[\d.]+/.exec(speeds)?.[0]);
  const rest = { ...(scenario.train ?? {}) };
  if (first > 0) rest.speed = { km_h: first };
  else if (!vehicles) rest.speed ??= { km_h: 100 };
  if (!vehicles) {
    delete rest.forces;
    if (axles) delete rest.cars;
    scenario.train = axles ? { ...rest, forces: axles } : { ...rest, cars: rest.cars ?? ["ice3"] };
    if (!axles) request.trains = text("trains").split(",").map((name) => name.trim()).filter(Boolean).reduce(joined, []);
  } else {
    const consist = text("consist");
    if (consist === "own") scenario.train = { ...rest, cars: own() };
    else if (consist !== "other") scenario.train = { ...rest, cars: Array(Math.max(1, Math.min(100, Math.floor(numeric("cars-count")) || 1))).fill(consist) };
    else scenario.train = rest;
    if (scenario.train.cars) delete scenario.train.forces;
  }
  if (text("track-type") !== "other") put(scenario, "track.type", text("track-type"));
  const spectrum = text("spectrum");
  const seeds = text("seeds");
  if (!vehicles || spectrum === "none") delete scenario.irregularity;
  else if (spectrum !== "other") {
    const kept = scenario.irregularity?.type === "spectrum" ? scenario.irregularity : {};
    scenario.irregularity = { ...kept, type: "spectrum", spectrum, seed: Number(/^\d+/.exec(seeds)?.[0] ?? 1), wavelengths: [value(text("shortest")), value(text("longest"))] };
  }
  if (vehicles && scenario.irregularity?.type === "spectrum" && !/^\d+$/.test(seeds) && seeds !== "") request.seeds = seeds;
  return request;
}

// `hslm-b:10,3.5` has a comma of its own.
function joined(names, name) {
  if (/^[\d.]+$/.test(name) && /^hslm-b[:-]\d+$/i.test(names.at(-1) ?? "")) names.push(`${names.pop()},${name}`);
  else names.push(name);
  return names;
}

function own() {
  try {
    const cars = JSON.parse(byId("cars").value);
    byId("cars-told").textContent = "";
    return Array.isArray(cars) ? cars : [cars];
  } catch (error) {
    byId("cars-told").textContent = `must be JSON: ${error.message}`;
    byId("cars-told").className = "told problem";
    return [];
  }
}

export const limits = () => [...document.querySelectorAll("input[name=limits]:checked")].map((box) => box.value);

// Puts a scenario into the form.
export function fill(scenario, request = {}) {
  empty();
  opened = structuredClone(scenario);
  const show = (id, shown) => { if (shown !== undefined && shown !== null) fields.get(id).input.value = shown; };
  const structure = scenario.bridge?.structure;
  const list = Array.isArray(structure?.spans) ? structure.spans : [];
  if (structure?.type === "beams" && plain(list)) {
    byId("kind").value = structure.continuous ? "continuous" : "simple";
    const by = list.some((span) => "bending_stiffness" in span) ? "bending_stiffness" : "first_frequency";
    show("stiffness", by);
    show("shear", list[0]?.shear_stiffness);
    const typed = list.map((span) => ({ length: span.length, mass: span.mass, [by]: span[by] ?? structure.first_frequency }));
    if (typed.every((span) => JSON.stringify(span) === JSON.stringify(typed[0]))) {
      show("count", typed.length);
      for (const key of ["length", "mass", by]) show(key, typed[0]?.[key]);
    } else {
      different = typed;
    }
  } else {
    const frame = structure?.type === "frame" && [...byId("kind").options].some((option) => option.value === structure.frame);
    byId("kind").value = frame ? structure.frame : "other";
  }
  for (const of of fields.values()) {
    if (!of.at || of.at.startsWith("spans.")) continue;
    const given = reach(scenario, of.at);
    if (typeof given === "number") show(of.id, of.factor ? Number((given / of.factor).toPrecision(12)) : given);
  }
  const offered = (id, name) => [...fields.get(id).input.options].some((option) => option.value === name);
  const cars = scenario.train?.cars ?? [];
  const same = cars.length > 0 && cars.every((car) => car === cars[0]) && offered("consist", cars[0]);
  show("consist", same ? cars[0] : "other");
  if (same) show("cars-count", cars.length);
  show("track-type", scenario.track?.type === undefined ? "slab" : offered("track-type", scenario.track.type) ? scenario.track.type : "other");
  const irregularity = scenario.irregularity ?? { type: "none" };
  show("spectrum", irregularity.type === "none" ? "none" : irregularity.type === "spectrum" && offered("spectrum", irregularity.spectrum) ? irregularity.spectrum : "other");
  show("seeds", request.seeds ?? irregularity.seed);
  const loads = request.way ? request.way !== "coupled" : Boolean(scenario.train?.forces);
  document.querySelector(`input[name=acts][value=${loads ? "loads" : "vehicles"}]`).checked = true;
  if (Array.isArray(scenario.train?.forces)) byId("axles").value = `x,load\n${scenario.train.forces.map(([x, load]) => `${x},${load / 1000}`).join("\n")}`;
  if (request.trains?.length) show("trains", request.trains.join(", "));
  show("heading", request.heading ?? scenario.train?.heading ?? "forward");
  show("speeds", request.speeds ?? scenario.train?.speed?.km_h);
  const judging = request.limits?.names ?? [];
  if (judging.length) document.querySelectorAll("input[name=limits]").forEach((box) => { box.checked = judging.includes(box.value); });
  fields.get("refine").input.checked = Boolean(request.refine);
  fields.get("variants").input.checked = Boolean(request.variants);
  arrange();
}

// Spans of which the form shows everything.
function plain(list) {
  return list.length > 0 && list.every((span) => Object.keys(span).every((key) => ["length", "mass", "bending_stiffness", "first_frequency", "shear_stiffness"].includes(key)))
    && new Set(list.map((span) => span.shear_stiffness)).size === 1;
}

// The field that a problem belongs to.
export function fieldOf(path, message) {
  const asked = /^(speeds|trains|seeds|refine):/.exec(message)?.[1];
  if (asked) return fields.get(asked);
  const own = different && document.querySelector(`#spans [data-path="${CSS.escape(path)}"]`);
  if (own) return { id: "spans", input: own, place: byId("spans-told") };
  const bare = path.replace(/^\$\.?/, "").replace(/^bridge\.structure\.spans\[\d+\]/, "spans");
  const shown = [...fields.values()].filter((of) => of.at && !of.box.hidden);
  const exact = shown.find((of) => of.at === bare);
  if (exact) return exact;
  const key = /`([a-z_]+)`/.exec(message)?.[1];
  const missing = shown.find((of) => key && of.at === (bare ? `${bare}.${key}` : key));
  if (missing) return missing;
  if (bare.startsWith("train.speed") || (bare === "train" && key === "speed")) return fields.get("speeds");
  if (bare === "bridge.structure.spans" && !different) return fields.get("count");
  if (bare.startsWith("bridge.structure.first_frequency")) return fields.get("first_frequency");
  if (bare.startsWith("irregularity.seed")) return fields.get("seeds");
  return undefined;
}
