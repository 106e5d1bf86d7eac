// A bridge FMU of another program in place of the scenario's bridge, run by the program that serves this page.

import { element } from "./chart.js";
import { Refused } from "./engine.js";

const byId = (id) => document.getElementById(id);
const path = () => byId("bridge-fmu").value.trim();
const map = () => byId("bridge-map").value;

// What a request has of it.
export const asked = () => (path() ? { bridge: { fmu: path(), map: map() } } : {});

// The words of a command.
export const words = () => (path() ? [`--bridge ${path()}`, ...(map().trim() ? ["--map map.json"] : [])] : []);

export function fill(bridge) {
  if (byId("bridge-fmu").disabled) return;
  byId("bridge-fmu").value = bridge?.fmu ?? "";
  byId("bridge-map").value = bridge?.map ?? "";
  if (bridge) byId("foreign").open = true;
}

// The field says where FMUs can be had.
export function arrange(engine) {
  if (engine.keep) return;
  byId("bridge-fmu").disabled = true;
  byId("bridge-map").disabled = true;
  byId("bridge-fmu-told").textContent = "A browser cannot run the machine code that an FMU holds. The program can: start it by ttb ui, which opens this page with FMUs.";
}

// A dropped FMU goes to the program, which keeps it until another one takes its place here, or until it ends.
export async function drop(engine, file) {
  if (!engine.keep) throw new Refused(`${file.name}: ${byId("bridge-fmu-told").textContent}`);
  byId("bridge-fmu").value = (await engine.keep(file, path())).path;
  byId("foreign").open = true;
}

// Beside the verdicts: which file stood for the bridge, and what was noticed.
export function told({ plan, outcome }) {
  const files = plan.bridges.map(({ fmu, sha256 }) => element("p", { class: "hint", id: "bridge-file" }, `Bridge: ${fmu}, SHA-256 ${sha256}`));
  const items = outcome.warnings.map((text) => element("li", {}, text));
  return items.length ? [...files, element("details", {}, element("summary", {}, `Warnings: ${items.length}`), element("ul", {}, ...items))] : files;
}

// In place of the run in motion.
export const still = () => [element("h2", {}, "A run in motion"), element("p", { class: "hint" }, "Not to be seen: of an FMU the motion of the whole deck is not known.")];
