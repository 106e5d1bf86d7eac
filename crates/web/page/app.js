// What the page does: typed → looked at; computed → judged, drawn, saved.

import { compute, connect, Refused } from "./engine.js";
import { fields, tellFrequencies } from "./fields.js";
import { arrange, build, changed, collect, fieldOf, fill, limits, toggleDifferent } from "./form.js";
import { modes, rest, sketch } from "./sketch.js";
import { clear, lean, shown } from "./results.js";
import * as foreign from "./foreign.js";
import { example, fragment, fromFragment, take } from "./files.js";

const byId = (id) => document.getElementById(id);
let engine;
let running;
let latest = 0;
let everything = false;
let axles;
const touched = new Set();

function tell(text) {
  byId("done").textContent = text;
}

// Problems and warnings at their fields; those without one above the form. Of fields that nobody has touched nothing is said.
function report(problems, warnings = []) {
  for (const of of fields.values()) {
    const told = byId(`${of.id}-told`);
    told.textContent = "";
    told.className = "told";
    of.input.removeAttribute("aria-invalid");
  }
  document.querySelectorAll("#spans [aria-invalid]").forEach((input) => input.removeAttribute("aria-invalid"));
  if (byId("spans-told")) byId("spans-told").textContent = "";
  const note = ({ path, text }, kind) => {
    const of = fieldOf(path, text);
    if (!of) return false;
    if (kind === "problem" && !everything && !touched.has(of.id)) return true;
    const told = of.place ?? byId(`${of.id}-told`);
    const bare = text.replace(/^(speeds|trains|seeds|refine): (train: )?/, "");
    if (told.textContent.includes(bare)) return true;
    told.textContent += `${told.textContent ? " " : ""}${bare}`;
    told.className = `told ${kind}`;
    if (kind === "problem") of.input.setAttribute("aria-invalid", "true");
    return true;
  };
  const rest = problems.filter((one) => !note(one, "problem") && everything).map(({ path, text }) => (path ? `${path}: ${text}` : text));
  const others = warnings.filter((one) => !note(one, "warning")).map((one) => one.text);
  byId("problems").textContent = rest.join("\n");
  return others;
}

function problemsOf(error) {
  if (!(error instanceof Refused)) return [{ path: "", text: String(error?.message ?? error) }];
  return error.problems.length ? error.problems : error.message.split("\n").map((text) => ({ path: "", text }));
}

// Scenario and request, with the FMU that stands for the bridge.
function collected() {
  const { scenario, request } = collect(axles);
  return { scenario, request: { ...request, ...foreign.asked() } };
}

async function look() {
  const mine = (latest += 1);
  const { scenario, request } = collected();
  command(request);
  try {
    const seen = await engine.call("look", { text: JSON.stringify(scenario), asked: request });
    if (mine !== latest) return;
    const others = report(seen.asked, seen.warnings);
    sketch(byId("sketch"), seen.sketch);
    byId("modes-section").hidden = seen.modes.length === 0;
    modes(byId("modes"), seen.sketch, seen.modes);
    const facts = seen.facts.n0_hz ? [`n₀ = ${seen.facts.n0_hz.toPrecision(4)} Hz; ${seen.facts.track} track`] : [];
    const item = (text, kind) => Object.assign(document.createElement("li"), { textContent: text, className: kind });
    byId("remarks").replaceChildren(...facts.map((text) => item(text, "")), ...others.map((text) => item(text, "warning")));
  } catch (error) {
    if (mine !== latest) return;
    report(problemsOf(error));
  }
}

let timer;
let looked = Promise.resolve();
function lookNow() {
  timer = undefined;
  looked = look();
}

function typed() {
  byId("stale").hidden = byId("verdict") === null;
  // What is on its way is an answer to what stood there before.
  latest += 1;
  clearTimeout(timer);
  timer = setTimeout(lookNow, 120);
}

// The limits that judge: those that are ticked, and a file of the user's own.
const judges = () => ({ names: limits(), own: shown.ownLimits });

function command(request) {
  const words = ["ttb sweep scenario.json", ...foreign.words()];
  if (request.trains.length) words.push(`--trains ${request.trains.join(",")}`);
  if (request.speeds !== undefined) words.push(`--speeds ${request.speeds}`);
  if (request.seeds !== undefined) words.push(`--seeds ${request.seeds}`);
  if (request.way === "coupled" && !request.bridge) words.push("--way coupled");
  if (request.heading !== "forward") words.push(`--heading ${request.heading}`);
  if (request.refine) words.push("--refine");
  if (request.variants) words.push(`--variants ${request.variants}`);
  const { names, own } = judges();
  const usual = !own && [...names].sort().join() === [...shown.about.default_limits].sort().join();
  if (!usual) words.push(`--limits ${[...names, ...(own ? ["limits.json"] : [])].join(",")}`);
  byId("command").textContent = `${words.join(" ")} -o out`;
}

async function paste() {
  const told = byId("axles-told");
  told.textContent = "";
  told.className = "told";
  axles = undefined;
  const text = byId("axles").value;
  if (text.trim()) {
    try {
      axles = await engine.call("axles", { text });
      told.textContent = `${axles.length} axles, ${(axles.reduce((sum, axle) => sum + axle[1], 0) / 1000).toFixed(0)} kN; they run in place of the trains above.`;
    } catch (error) {
      told.textContent = problemsOf(error).map((problem) => `${problem.path}${problem.path ? ": " : ""}${problem.text}`).join(" ");
      told.className = "told problem";
    }
  }
  typed();
}

async function start(event) {
  event.preventDefault();
  if (running) return;
  everything = true;
  clear();
  const controller = new AbortController();
  running = controller;
  busy(true);
  if (timer !== undefined) {
    clearTimeout(timer);
    lookNow();
  }
  const { scenario, request } = collected();
  const limits = judges();
  const asked = { scenario: JSON.stringify(scenario, null, 2), ...request, limits };
  const begin = performance.now();
  try {
    tell("The plan is being made …");
    const plan = await engine.long("plan", { asked, workers: engine.workers }, controller.signal);
    const progress = (done, total) => {
      byId("progress").value = done / total;
      tell(`${done} of ${total} runs`);
    };
    progress(0, plan.runs.length);
    const records = await compute(engine, asked, plan, progress, controller.signal);
    const outcome = await engine.long("outcome", { asked, records: lean(records), limits }, controller.signal);
    tell(`${outcome.runs} ${outcome.runs === 1 ? "run" : "runs"} in ${((performance.now() - begin) / 1000).toFixed(1)} s`);
    byId("stale").hidden = true;
    shown.results({ engine, asked, plan, records, outcome, limits, begin });
  } catch (error) {
    if (error.name === "AbortError") tell("Cancelled.");
    else {
      tell("Not computed: see the problems.");
      // Its answer knows nothing of what only the plan finds, and would take the place of this one.
      await looked;
      report(problemsOf(error));
      const first = document.querySelector("[aria-invalid=true]");
      if (first) first.focus();
      else byId("problems").scrollIntoView({ block: "nearest" });
    }
  } finally {
    running = undefined;
    busy(false);
  }
}

function busy(is) {
  rest(is);
  byId("compute").disabled = is;
  byId("cancel").hidden = !is;
  byId("progress").hidden = !is;
  byId("form").setAttribute("aria-busy", String(is));
}

function put({ scenario, request }) {
  fill(scenario, request);
  foreign.fill(request?.bridge);
  if (request?.limits) ownLimits(request.limits.own ?? null, "the file of limits that was opened");
  everything = true;
  paste();
}

function ownLimits(text, name) {
  shown.ownLimits = text;
  byId("own-limits").textContent = text ? `Also ${name}, which overrides entries of the same name.` : "A file of limits of your own may be dropped on the page.";
  typed();
}

async function open(files) {
  try {
    const isFmu = (file) => /\.fmu$/i.test(file.name);
    for (const file of files.filter(isFmu)) await foreign.drop(engine, file);
    const others = files.filter((file) => !isFmu(file));
    if (!others.length) return typed();
    const taken = await take(others, collect(axles));
    put(taken);
    if (taken.limits) ownLimits(taken.limits.text, taken.limits.name);
    tell("");
  } catch (error) {
    tell("");
    byId("problems").textContent = error.message;
  }
}

function save() {
  const { scenario, request } = collected();
  shown.save("scenario.json", `${JSON.stringify({ ...scenario, $comment: { page: { ...request, limits: judges() } } }, null, 2)}\n`, "application/json");
}

async function link() {
  const { scenario, request } = collected();
  const address = await fragment({ scenario, request: { ...request, limits: judges() } });
  if (address === undefined) return tell("The scenario is too large for a link: save it instead.");
  history.replaceState(null, "", address);
  try {
    await navigator.clipboard.writeText(location.href);
    tell("The link is in the clipboard.");
  } catch {
    tell("The link is in the address bar.");
  }
}

function theme(dark) {
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  byId("theme").setAttribute("aria-pressed", String(dark));
}

// The scenario that the program was started with.
async function given() {
  const name = document.querySelector("meta[name=scenario]")?.content;
  if (!name) return undefined;
  try {
    return await take([new File([await (await fetch(name)).text()], name)], collect(axles));
  } catch (error) {
    byId("problems").textContent = error.message;
    return undefined;
  }
}

function listen() {
  const form = byId("form");
  form.addEventListener("input", (event) => {
    if (event.target.id) touched.add(event.target.id);
    if (event.target.id === "length" || event.target.id === "mass") tellFrequencies();
    if (event.target.id === "axles") paste();
    else typed();
  });
  form.addEventListener("change", arrange);
  form.addEventListener("submit", start);
  byId("cancel").addEventListener("click", () => running?.abort(new DOMException("cancelled", "AbortError")));
  byId("different").addEventListener("click", toggleDifferent);
  byId("open").addEventListener("click", () => byId("file").click());
  byId("file").addEventListener("change", () => { open([...byId("file").files]); byId("file").value = ""; });
  byId("save").addEventListener("click", save);
  byId("link").addEventListener("click", link);
  byId("example").addEventListener("change", () => {
    const chosen = example(byId("example").value, shown.about);
    if (chosen) put(chosen);
  });
  byId("theme").addEventListener("click", () => theme(document.documentElement.dataset.theme !== "dark"));
  document.addEventListener("dragover", (event) => { event.preventDefault(); document.body.classList.add("drop"); });
  document.addEventListener("dragleave", () => document.body.classList.remove("drop"));
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    document.body.classList.remove("drop");
    open([...event.dataTransfer.files]);
  });
  addEventListener("pagehide", () => running?.abort(new DOMException("cancelled", "AbortError")));
}

async function begin() {
  theme(matchMedia("(prefers-color-scheme: dark)").matches);
  try {
    engine = await connect();
    shown.about = await engine.call("about");
  } catch (error) {
    byId("engine").textContent = `There is no engine: ${error.message}`;
    byId("compute").disabled = true;
    return;
  }
  build(shown.about);
  foreign.arrange(engine);
  byId("engine").textContent = `Version ${shown.about.version}, computed ${engine.name}.`;
  listen();
  const linked = await fromFragment() ?? await given();
  if (linked) put(linked);
  else changed();
  touched.clear();
  document.documentElement.dataset.ready = "true";
  engine.warm?.();
}

begin();
