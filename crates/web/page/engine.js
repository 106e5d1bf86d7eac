// The engine behind one interface, in Web Workers or in the program that serves this page.
//
//   call(verb, request)             one answer; an Error with `problems` if there is none
//   compute(asked, plan, tell, signal)   all runs of a plan; `tell` hears of every part; `signal` ends it

export class Refused extends Error {
  constructor(error, problems = []) {
    super(error);
    this.problems = problems;
  }
}

function read(text) {
  const value = JSON.parse(text);
  if (value && value.error !== undefined) throw new Refused(value.error, value.problems);
  return value;
}

const TRAPPED = "The computation ended before its time: most probably there was not enough memory. Take a smaller model, longer "
  + "steps or fewer runs, or use the program ttb.";

// One worker, made again after a trap or a cancellation.
class Desk {
  constructor(make) {
    this.make = make;
    this.waiting = new Map();
    this.last = 0;
  }

  start() {
    if (this.worker) return;
    this.worker = this.make();
    this.worker.onmessage = ({ data }) => {
      const waits = this.waiting.get(data.id);
      this.waiting.delete(data.id);
      if (data.trap !== undefined) {
        this.end(new Refused(`${TRAPPED} (${data.trap})`));
        waits?.reject(new Refused(`${TRAPPED} (${data.trap})`));
      } else {
        waits?.resolve(data.text);
      }
    };
    this.worker.onerror = (event) => { event.preventDefault(); this.end(new Refused(TRAPPED)); };
  }

  end(why) {
    this.worker?.terminate();
    this.worker = undefined;
    for (const waits of this.waiting.values()) waits.reject(why);
    this.waiting.clear();
  }

  text(verb, body) {
    this.start();
    const id = ++this.last;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.worker.postMessage({ id, verb, body });
    });
  }
}

// A function that gives the vector of an integer back: valid where there are vectors of 128 bits.
const VECTORS = [0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11];

const SMALL = {
  train: { cars: ["ice3"], speed: { km_h: 150 } },
  bridge: { structure: { type: "beams", spans: [{ length: 24, first_frequency: 4.5, mass: 15000 }] }, damping: { type: "rayleigh", ratio: 0.01 } },
};

class Workers {
  static async connect() {
    if (!WebAssembly.validate(new Uint8Array(VECTORS))) {
      throw new Error("this browser has no vectors of 128 bits in WebAssembly, by which the engine computes. Chrome and Edge have them from version 91 on, Firefox from 89, Safari from 16.4; the program `ttb ui` computes for any browser.");
    }
    const [script, wasm] = await Promise.all([fetch("worker.js"), fetch("engine.wasm")]);
    if (!script.ok || !wasm.ok) throw new Error("engine.wasm is not beside this page: build it with tools/web, or open the page by `ttb ui`");
    const engine = new Workers();
    // Kept, so that nothing is asked of the network after loading.
    engine.module = await WebAssembly.compile(await wasm.arrayBuffer()).catch((error) => {
      throw new Error(`this browser cannot run engine.wasm: ${error.message}`);
    });
    engine.script = URL.createObjectURL(new Blob([await script.text()], { type: "text/javascript" }));
    engine.workers = Math.max(1, Math.min(navigator.hardwareConcurrency || 2, 16));
    engine.desk = new Desk(() => engine.make());
    engine.pool = Array.from({ length: engine.workers }, () => new Desk(() => engine.make()));
    // Ready before anybody computes.
    for (const desk of engine.pool) desk.start();
    engine.name = `in this browser, ${engine.workers} ${engine.workers > 1 ? "workers" : "worker"}`;
    return engine;
  }

  // A browser translates WebAssembly twice: at first quickly, later well what is used much. A small sweep in every worker, while
  // the user types, has that behind it when the first real one begins.
  warm() {
    const asked = { scenario: JSON.stringify(SMALL), trains: ["hslm-a1", "hslm-a10"], speeds: "150:190:5", way: "auto", heading: "forward" };
    for (const desk of this.pool) {
      const ask = async (verb, request) => read(await desk.text(verb, JSON.stringify({ asked, ...request })));
      const sweep = async () => {
        const plan = await ask("plan", { workers: 1 });
        const records = await ask("runs", { runs: plan.runs });
        await ask("dossier", { records, limits: {}, name: "", date: "" });
      };
      // Nothing depends on it.
      sweep().catch(() => {});
    }
  }

  make() {
    const worker = new Worker(this.script);
    worker.postMessage({ module: this.module });
    return worker;
  }

  async call(verb, request = {}) {
    return read(await this.desk.text(verb, JSON.stringify(request)));
  }

  // As `call`, in a worker that a cancellation ends.
  async callAt(place, verb, request, signal) {
    const desk = this.pool[place];
    const leave = () => desk.end(new DOMException("cancelled", "AbortError"));
    signal.throwIfAborted();
    signal.addEventListener("abort", leave, { once: true });
    try {
      return read(await desk.text(verb, JSON.stringify(request)));
    } finally {
      signal.removeEventListener("abort", leave);
    }
  }

  long(verb, request, signal) {
    return this.callAt(0, verb, request, signal);
  }

  // As `call`, in a worker that has computed, so that it has what it prepared.
  async aside(verb, request) {
    return read(await this.pool.at(-1).text(verb, JSON.stringify(request)));
  }

  places() {
    return this.workers;
  }

  perCall() {
    return 1;
  }
}

class Program {
  static async connect() {
    const engine = new Program();
    engine.workers = navigator.hardwareConcurrency || 2;
    engine.name = "in the program ttb, all processors";
    return engine;
  }

  async call(verb, request = {}, signal = undefined) {
    const job = signal ? crypto.randomUUID() : "";
    const leave = () => navigator.sendBeacon(`api/cancel?job=${job}`);
    signal?.throwIfAborted();
    signal?.addEventListener("abort", leave, { once: true });
    const beat = signal && setInterval(() => fetch(`api/alive?job=${job}`, { method: "POST" }).catch(() => {}), 5000);
    try {
      const answer = await fetch(`api/${verb}?job=${job}`, { method: "POST", body: JSON.stringify(request), signal });
      return read(await answer.text());
    } catch (error) {
      if (error instanceof TypeError) throw new Refused("The program ttb does not answer any more: it has ended, or was ended by Ctrl-C.");
      throw error;
    } finally {
      clearInterval(beat);
      signal?.removeEventListener("abort", leave);
    }
  }

  // A file that the program keeps until it ends, or until another one replaces it: its path.
  async keep(file, replaced) {
    const answer = await fetch("api/fmu", { method: "POST", body: new Blob([`${file.name}\n${replaced}\n`, file]) });
    return read(await answer.text());
  }

  callAt(place, verb, request, signal) {
    return this.call(verb, request, signal);
  }

  long(verb, request, signal) {
    return this.call(verb, request, signal);
  }

  aside(verb, request) {
    return this.call(verb, request);
  }

  // The program shares the runs of a call out to its processors itself.
  places() {
    return 1;
  }

  perCall() {
    return 2 * this.workers;
  }
}

// Whoever serves the page says which engine there is.
export async function connect() {
  const native = document.querySelector("meta[name=engine]").content === "native";
  return native ? Program.connect() : Workers.connect();
}

// Computes parts of runs, whoever is free the next one, and puts their records by id. Their order does not matter: tables follow the
// plan.
async function share(engine, asked, parts, records, tell, signal) {
  let next = 0;
  const work = async (place) => {
    while (next < parts.length) {
      const runs = parts.slice(next, next + engine.perCall()).flat();
      next += engine.perCall();
      for (const record of await engine.callAt(place, "runs", { asked, runs }, signal)) records.set(record.run_id, record);
      tell(records.size);
    }
  };
  await Promise.all(Array.from({ length: engine.places() }, (_, place) => work(place)));
}

export async function compute(engine, asked, plan, tell, signal) {
  const records = new Map();
  let total = plan.runs.length;
  await share(engine, asked, plan.parts, records, (done) => tell(done, total), signal);
  while (plan.refine) {
    const parts = await engine.long("more", { asked, records: [...records.values()], workers: engine.workers }, signal);
    if (parts.length === 0) break;
    total += parts.flat().length;
    await share(engine, asked, parts, records, (done) => tell(done, total), signal);
  }
  return [...records.values()];
}
