// Verdicts, curves, runs and files of a computation.

import { chart, element, number } from "./chart.js";
import { show } from "./film.js";
import * as foreign from "./foreign.js";
import { zip } from "./zip.js";

const byId = (id) => document.getElementById(id);
const FACTORS = { "m/s2": [1, "m/s²"], m: [1000, "mm"], N: [0.001, "kN"], "N.m": [0.001, "kN m"], 1: [1, ""] };
const WORDS = { exceeded: "exceeded", fulfilled: "fulfilled", informative: "for information", "not-judged": "not judged" };

function save(name, content, type) {
  const address = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
  const link = element("a", { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 60000);
}

// Of more runs the report is made when somebody asks for it.
const AHEAD = 2000;

// Records without extremes along the deck, which are most of them, but for the runs that are named.
export const lean = (records, named = new Set()) => records.map((record) => (named.has(record.run_id) ? record : { ...record, envelopes: [] }));

export const shown = { results, save, about: undefined, ownLimits: null };

export function clear() {
  for (const id of ["charts", "film"]) byId(id).replaceChildren();
  byId("outcome").replaceChildren(element("p", { class: "hint" }, "Computing …"));
}

const amount = (value, unit) => {
  const [factor, name] = FACTORS[unit] ?? [1, unit];
  return `${number(value === null ? NaN : value * factor)} ${name}`.trim();
};

function results(of) {
  const { outcome } = of;
  const judged = outcome.verdicts.verdicts.filter((verdict) => verdict.status !== "not-judged");
  byId("outcome").replaceChildren(banner(judged), actions(of), verdicts(outcome.verdicts.verdicts), ...failures(outcome.failed), ...foreign.told(of));
  const across = { title: "speed", unit: "km/h" };
  const charts = outcome.charts.filter((one) => one.lines.some((line) => line.points.length > 1));
  byId("charts").replaceChildren(...charts.map((one) => chart({ ...one, across, title: `${one.title}${one.filter === "raw" ? "" : ` (${one.filter})`}` })));
  runs(of);
  document.documentElement.dataset.computed = String(Math.round(performance.now() - of.begin));
}

function banner(judged) {
  const bad = judged.filter((verdict) => verdict.status === "exceeded");
  const worst = judged.filter((verdict) => verdict.utilisation !== null).sort((a, b) => b.utilisation - a.utilisation)[0];
  const of = worst ? ` Governing: ${worst.title}, ${amount(worst.value, worst.unit)} of ${amount(worst.limit, worst.unit)} (${number(100 * worst.utilisation, 3)} %)${worst.train ? `, ${worst.train}` : ""}${worst.speed_km_h ? ` at ${number(worst.speed_km_h)} km/h` : ""}.` : "";
  const said = bad.length ? `${bad.length} of ${judged.length} criteria exceeded.` : `No limit is exceeded (${judged.length} criteria).`;
  return element("p", { class: `banner ${bad.length ? "bad" : "good"}`, id: "verdict", role: "status" }, element("strong", {}, said), of);
}

function verdicts(all) {
  const head = ["Outcome", "Criterion", "Value", "Limit", "Train, speed"].map((text, i) => element("th", { scope: "col", class: i === 2 || i === 3 ? "number" : undefined }, text));
  const rows = all.filter((verdict) => verdict.status !== "not-judged").map((verdict) => element("tr", {},
    element("td", { class: `status ${verdict.status}` }, WORDS[verdict.status]),
    element("td", { title: `${verdict.clause} ${verdict.edition} (${verdict.verified})` }, verdict.title),
    element("td", { class: "number" }, amount(verdict.value, verdict.unit)),
    element("td", { class: "number" }, amount(verdict.limit, verdict.unit)),
    element("td", {}, [verdict.train, verdict.speed_km_h ? `${number(verdict.speed_km_h)} km/h` : "", verdict.in_basis ? "" : "not the code's basis"].filter(Boolean).join(", "))));
  const left = all.filter((verdict) => verdict.status === "not-judged");
  const table = element("table", {}, element("thead", {}, element("tr", {}, ...head)), element("tbody", {}, ...rows));
  const not = element("details", {}, element("summary", {}, `Not judged: ${left.length}`), element("ul", {}, ...left.map((verdict) => element("li", {}, `${verdict.title}: ${verdict.reason ?? ""}`))));
  return element("div", {}, element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Verdicts" }, table), left.length ? not : undefined);
}

function failures(failed) {
  if (!failed.length) return [];
  const items = failed.slice(0, 20).map(([id, why]) => element("li", {}, `${id}: ${why.split("\n")[0]}`));
  return [element("div", { class: "told problem" }, `${failed.length} runs failed:`, element("ul", {}, ...items))];
}

function actions(of) {
  const told = element("span", { role: "status" });
  let compared = [];
  // The report names the folder in which the files are meant to lie.
  const made = (records) => of.engine.aside("dossier", { asked: of.asked, records, limits: of.limits, compared, name: "ttb-page", date: new Date().toISOString().slice(0, 10) });
  // A report shows the extremes along the deck of judged runs alone.
  const judged = lean(of.records, new Set(of.outcome.verdicts.verdicts.map((verdict) => verdict.run_id)));
  const button = (text, id, act) => {
    const one = element("button", { type: "button", id }, text);
    one.addEventListener("click", async () => {
      one.disabled = true;
      try {
        told.textContent = "";
        await act();
      } catch (error) {
        told.textContent = error.message;
      }
      one.disabled = false;
    });
    return one;
  };
  // Most people open it: unless it is large it is made while they read the verdict.
  let ahead = of.records.length > AHEAD ? undefined : made(judged);
  ahead?.catch(() => { ahead = undefined; });
  const page = async () => (await (ahead ??= made(judged)))["report.html"];
  const report = button("Open the report", "report", async () => {
    const text = await page();
    document.documentElement.dataset.report = String(text.length);
    window.open(URL.createObjectURL(new Blob([text], { type: "text/html" })), "_blank", "noopener");
  });
  const keep = button("Save the report", "save-report", async () => save("report.html", await page(), "text/html"));
  const all = button("Save all (.zip)", "save-all", async () => save("ttb-page.zip", zip("ttb-page", await made(of.records))));
  const again = of.plan.way === "coupled" ? undefined : button("Repeat the governing runs step by step", "again", async () => {
    told.textContent = "computing …";
    compared = await of.engine.long("again", { asked: of.asked, records: of.records }, new AbortController().signal);
    ahead = undefined;
    told.textContent = compared.map((one) => `${one.quantity}: ${100 * Math.abs(one.difference) < 0.001 ? "no difference" : `${(100 * one.difference).toFixed(3)} %`} (allowed ${100 * one.allowed} %)`).join("; ");
  });
  return element("div", { class: "row", role: "group", "aria-label": "Report and files" }, report, keep, all, again, told);
}

// The governing run in motion, and any other.
function runs(of) {
  const place = byId("film");
  if (of.plan.bridges.length) return place.replaceChildren(...foreign.still());
  const picture = element("div");
  const choices = of.outcome.governing.map((one) => [one.run, `${one.title}: largest ${one.quantity} (${one.filter})`]);
  for (const run of of.plan.runs.slice(0, 3000)) {
    const name = [of.plan.trains[run.train], run.speed_km_h === null ? "" : `${number(run.speed_km_h, 6)} km/h`, run.rail === "scenario" ? "" : `rail ${run.rail.seed ?? run.rail}`, run.variant ? `variant ${run.variant}` : ""];
    choices.push([run, name.filter(Boolean).join(", ")]);
  }
  const select = element("select", { id: "run" }, ...choices.map(([, text], i) => element("option", { value: i }, text)));
  const told = element("span", { role: "status" });
  const button = element("button", { type: "button", id: "show" }, "Show");
  const draw = async () => {
    button.disabled = true;
    told.textContent = "computing …";
    try {
      const film = await of.engine.long("film", { asked: of.asked, runs: [choices[Number(select.value)][0]] }, new AbortController().signal);
      show(picture, film, film.bearings);
      told.textContent = "";
    } catch (error) {
      told.textContent = error.message;
    }
    button.disabled = false;
  };
  button.addEventListener("click", draw);
  place.replaceChildren(element("h2", {}, "A run in motion"), element("div", { class: "row" }, element("label", {}, "Run ", select), button, told), picture);
  // Axle loads take milliseconds; vehicles are computed when somebody asks for them.
  if (of.plan.way !== "coupled") draw();
}
