// A bridge FMU of another program in place of the scenario's bridge: a run a speed, by the program that serves this page.

import { chart, element, number } from "./chart.js";
import { Refused } from "./engine.js";
import { amount, banner, FACTORS, verdicts } from "./results.js";

const byId = (id) => document.getElementById(id);
const path = () => byId("bridge-fmu").value.trim();

export const given = () => path() !== "";
export const command = () => `ttb run scenario.json --bridge ${path()}${byId("bridge-map").value.trim() ? " --map map.json" : ""} --isolate -o out`;

// The field says where FMUs can be had.
export function arrange(engine) {
  if (engine.keep) return;
  byId("bridge-fmu").disabled = true;
  byId("bridge-map").disabled = true;
  byId("bridge-fmu-told").textContent = "A browser cannot run the machine code that an FMU holds. The program can: start it by ttb ui, which opens this page with FMUs.";
}

// A dropped FMU goes to the program, which keeps it until it ends.
export async function drop(engine, file) {
  if (!engine.keep) throw new Refused(`${file.name}: ${byId("bridge-fmu-told").textContent}`);
  byId("bridge-fmu").value = (await engine.keep(file)).path;
  byId("foreign").open = true;
}

// The scenarios of all speeds.
function scenarios(scenario, request, plan) {
  if (request.way !== "coupled") throw new Refused("An FMU as the bridge carries vehicles: choose vehicles on their track.");
  if (request.heading === "both" || plan.trains.length > 1 || plan.runs.some((run) => run.variant || run.rail !== "scenario")) {
    throw new Refused("With an FMU as the bridge only speeds are varied: choose one direction and one seed, without bounds.");
  }
  const heading = request.heading === "backward" ? { heading: "backward" } : {};
  return plan.runs.map(({ speed_km_h: speed }) => [speed, { ...scenario, train: { ...scenario.train, ...heading, ...(speed ? { speed: { km_h: speed } } : {}) } }]);
}

// All runs, as many at a time as there are processors, by rising speed.
export async function compute(engine, scenario, request, plan, limits, tell, signal) {
  const asked = scenarios(scenario, request, plan);
  const done = [];
  let next = 0;
  const work = async () => {
    while (next < asked.length) {
      const [speed, of] = asked[next++];
      const answer = await engine.call("foreign", { scenario: JSON.stringify(of), bridge: path(), map: byId("bridge-map").value, limits }, signal);
      done.push({ speed, ...answer });
      tell(done.length, asked.length);
    }
  };
  await Promise.all(Array.from({ length: Math.min(engine.workers, asked.length) }, work));
  return done.sort((a, b) => a.speed - b.speed);
}

// Verdict, curves over speed, a report a speed.
export function results(done, begin) {
  const named = done.flatMap(({ speed, verdicts: of }) => of.verdicts.map((one) => ({ ...one, speed_km_h: one.speed_km_h ?? speed })));
  const judged = named.filter((one) => one.status !== "not-judged");
  const bridge = done[0]?.inputs?.find((one) => one.role === "bridge");
  const said = [...new Set(done.flatMap((one) => one.said.split("\n").map((line) => line.replace(/^ttb: (warning: )?/, "").trim())).filter(Boolean))];
  byId("outcome").replaceChildren(
    banner(worst(judged)),
    element("p", { class: "hint", id: "bridge-file" }, bridge ? `Bridge: ${bridge.path}, SHA-256 ${bridge.sha256}` : ""),
    element("div", { class: "row", role: "group", "aria-label": "Reports" }, ...done.map(open)),
    verdicts(worst(named)),
    said.length ? element("details", {}, element("summary", {}, `Warnings: ${said.length}`), element("ul", {}, ...said.map((text) => element("li", {}, text)))) : "");
  byId("charts").replaceChildren(...curves(judged).map(chart));
  document.documentElement.dataset.computed = String(Math.round(performance.now() - begin));
}

function open({ speed, report }) {
  const button = element("button", { type: "button", class: "report" }, `Report${speed ? `, ${number(speed)} km/h` : ""}`);
  button.addEventListener("click", () => {
    document.documentElement.dataset.report = String(report.length);
    window.open(URL.createObjectURL(new Blob([report], { type: "text/html" })), "_blank", "noopener");
  });
  return button;
}

const key = (one) => JSON.stringify([one.title, one.quantity, one.filter]);

// Of every criterion the speed at which it is worst.
function worst(all) {
  const found = new Map();
  for (const one of all) {
    const kept = found.get(key(one));
    const greater = (a, b) => (a.utilisation ?? a.value ?? -Infinity) > (b.utilisation ?? b.value ?? -Infinity);
    if (!kept || greater(one, kept)) found.set(key(one), one);
  }
  return [...found.values()];
}

function curves(judged) {
  const found = new Map();
  for (const one of judged.filter((verdict) => verdict.value !== null)) found.set(key(one), [...(found.get(key(one)) ?? []), one]);
  return [...found.values()].filter((all) => all.length > 1).map((all) => {
    const [{ title, quantity, filter, unit, limit }] = all;
    const [factor, name] = FACTORS[unit] ?? [1, unit];
    const points = all.map((one) => [one.speed_km_h, one.value * factor]);
    return { quantity, title: `${title}${filter === "raw" ? "" : ` (${filter})`}`, unit: name, across: { title: "speed", unit: "km/h" }, limit: limit === null ? null : [limit * factor, `limit ${amount(limit, unit)}`], lines: [{ name: "with the FMU", points }] };
  });
}
