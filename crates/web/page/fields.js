// The fields: what they are called, their units and usual ranges, and what was typed into them.

import { element, number } from "./chart.js";

const byId = (id) => document.getElementById(id);

// label, unit, path of the value in the scenario or key of the request, quantity whose range is told, factor to the unit of the path.
export const FIELDS = {
  equal: [
    { id: "count", label: "Number of equal spans", unit: "", told: "one behind the other; 1 is a single span" },
    { id: "length", label: "Length of a span", unit: "m", at: "spans.length", what: "span.length", help: "from bearing to bearing" },
    { id: "stiffness", label: "Stiffness by", choices: [["first_frequency", "first frequency n₀"], ["bending_stiffness", "bending stiffness EI"]] },
    { id: "first_frequency", label: "First natural frequency n₀", unit: "Hz", at: "spans.first_frequency" },
    { id: "bending_stiffness", label: "Bending stiffness EI", unit: "N m²", at: "spans.bending_stiffness" },
    { id: "mass", label: "Mass with dead loads", unit: "kg/m", at: "spans.mass", what: "span.mass", help: "structure, ballast, rails" },
  ],
  damping: [{ id: "ratio", label: "Damping ratio", unit: "%", at: "bridge.damping.ratio", factor: 0.01, what: "damping.ratio", help: "of critical damping" }],
  "bridge-more": [
    { id: "shear", label: "Shear stiffness κGA", unit: "N", at: "spans.shear_stiffness", told: "optional: a beam after Timoshenko" },
    { id: "times", label: "Damping is met at n₀ and its multiple", unit: "times", at: "bridge.damping.at.first_times", told: "usual 3 to 6; 4 if left out" },
    { id: "modes-count", label: "Solve in so many modes", unit: "", at: "bridge.modes", whole: true, told: "optional: else in all degrees of freedom" },
  ],
  train: [
    { id: "trains", label: "Trains", unit: "", request: "trains", told: "names, commas between them: hslm-a, ice2, en15528-d2x6", list: "known-trains", acts: "loads" },
    { id: "consist", label: "Vehicles", choices: [], help: "ice3 is a train of eight cars", acts: "vehicles" },
    { id: "cars-count", label: "How often", unit: "times", told: "1 for a whole train", acts: "vehicles" },
    { id: "heading", label: "Direction", choices: [["forward", "from the begin"], ["backward", "from the end"], ["both", "both, in turn"]], help: "of the bridge" },
    { id: "speeds", label: "Speeds", unit: "km/h", request: "speeds", told: "speeds" },
  ],
  track: [
    { id: "track-type", label: "Track", choices: [], help: "decides the limit of acceleration, carries vehicles" },
    { id: "spectrum", label: "Irregularity of the rail", choices: [], help: "random, by a measured spectrum", acts: "vehicles" },
    { id: "seeds", label: "Seeds", unit: "", told: "1, or 1:20 for twenty rails and a smooth one", acts: "vehicles" },
    { id: "shortest", label: "Shortest wave", unit: "m", told: "usual 1 to 3", at: "irregularity.wavelengths[0]", acts: "vehicles" },
    { id: "longest", label: "Longest wave", unit: "m", told: "usual 25 to 150", at: "irregularity.wavelengths[1]", acts: "vehicles" },
  ],
  computation: [
    { id: "step", label: "Time step", unit: "s", at: "time.step", told: "0.001 if left out; vehicles and their track" },
    { id: "refine", label: "Seek the largest values between the speeds", check: true },
    { id: "variants", label: "Also bounds of mass and stiffness (−5 %, +5 % with −10 % EI)", check: true },
  ],
};

export const fields = new Map();
export const known = { about: undefined };

export function field(of) {
  const box = element("div", { class: of.check ? "field checks wide" : "field" });
  const describe = [`${of.id}-unit`, `${of.id}-usual`, `${of.id}-told`].join(" ");
  let input;
  if (of.check) {
    input = element("input", { type: "checkbox", id: of.id, "aria-describedby": describe });
    box.append(element("label", {}, input, of.label));
  } else if (of.choices) {
    input = element("select", { id: of.id, "aria-describedby": describe });
    for (const [value, text] of of.choices) input.append(element("option", { value }, text));
    box.append(element("label", { for: of.id }, of.label), element("div", { class: "entry" }, input), element("span", { class: "usual", id: `${of.id}-usual` }, of.help ?? ""));
  } else {
    input = element("input", { id: of.id, type: "text", inputmode: of.request ? "text" : "decimal", "aria-describedby": describe, list: of.list, spellcheck: "false" });
    box.append(element("label", { for: of.id }, of.label), element("div", { class: "entry" }, input, element("span", { class: "unit", id: `${of.id}-unit` }, of.unit)));
    box.append(element("span", { class: "usual", id: `${of.id}-usual` }, usual(of)));
  }
  box.append(element("p", { class: "told", id: `${of.id}-told` }));
  fields.set(of.id, { ...of, input, box });
  return box;
}

function ranged([low, high], unit, factor = 1) {
  const told = [low, high].map((end) => (end === null ? null : number(end / factor)));
  if (told[0] === null) return `usual up to ${told[1]} ${unit}`.trim();
  return told[1] === null ? `usual from ${told[0]} ${unit} on` : `usual ${told[0]} to ${told[1]} ${unit}`.trim();
}

function usual(of) {
  return [of.help, telling(of)].filter(Boolean).join("; ");
}

function telling(of) {
  const data = of.what && known.about.ranges.ranges.find((one) => one.what === of.what);
  if (data) return ranged(data.usual, of.unit, of.factor);
  if (of.told === "speeds") {
    const speed = known.about.ranges.ranges.find((one) => one.what === "train.speed").usual[1];
    return `140:420 or 140:420:5 or 200,250; usual up to ${number(3.6 * speed, 3)}`;
  }
  return of.told ?? "";
}

// Usual frequencies of a span follow from its length, its stiffness from both.
export function tellFrequencies() {
  const [length, mass] = [numeric("length"), numeric("mass")];
  const of = known.about.frequencies;
  const at = (pieces) => {
    const piece = pieces.find((one) => one.to === null || length <= one.to);
    return piece.factor * length ** piece.exponent;
  };
  const inside = length >= of.lengths[0] && length <= of.lengths[1];
  const n0 = inside ? [at(of.lower), at(of.upper)] : null;
  byId("first_frequency-usual").textContent = `in bending; ${n0 ? `${ranged(n0.map((f) => Number(f.toPrecision(3))), "Hz")} for ${number(length)} m` : "usual: by the length (EN 1991-2, figure 6.10)"}`;
  const stiffness = (f) => Number((mass * ((2 * length * length * f) / Math.PI) ** 2).toPrecision(2));
  byId("bending_stiffness-usual").textContent = `of the whole deck; ${n0 && mass > 0 ? ranged(n0.map(stiffness), "N m²") : "usual: by length and mass"}`;
}

export const text = (id) => fields.get(id).input.value.trim();

// What was typed as a number; a text that is none stays a text, so that the check says so.
export function value(typed, factor = 1) {
  if (typed === "") return undefined;
  const amount = Number(typed.replace(/^([+-]?\d+),(\d+)$/, "$1.$2"));
  return Number.isFinite(amount) ? (factor === 1 ? amount : Number((amount * factor).toPrecision(15))) : typed;
}

export const numeric = (id) => Number(value(text(id)));

export function put(object, path, amount) {
  const keys = path.replace(/\[(\d+)\]/g, ".$1").split(".");
  const last = keys.pop();
  for (const [i, key] of keys.entries()) {
    if (typeof object[key] !== "object" || object[key] === null) {
      if (amount === undefined) return;
      object[key] = /^\d+$/.test(keys[i + 1] ?? last) ? [] : {};
    }
    object = object[key];
  }
  if (amount === undefined) delete object[last];
  else object[last] = amount;
}

export function reach(object, path) {
  return path.replace(/\[(\d+)\]/g, ".$1").split(".").reduce((of, key) => of?.[key], object);
}
