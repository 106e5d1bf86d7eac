// Scenarios in and out: files, examples, the fragment of a link.

// Longest fragment: what mail programs and chats keep whole.
const LONGEST = 8000;

async function piped(bytes, through) {
  const answer = new Response(new Blob([bytes]).stream().pipeThrough(through));
  return new Uint8Array(await answer.arrayBuffer());
}

// The fragment for a scenario and its request; nothing if it would be too long.
export async function fragment(state) {
  const packed = await piped(new TextEncoder().encode(JSON.stringify(state)), new CompressionStream("deflate-raw"));
  const text = btoa(packed.reduce((all, byte) => all + String.fromCharCode(byte), ""));
  const fragment = `#s=${text.replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "")}`;
  return fragment.length > LONGEST ? undefined : fragment;
}

// What the fragment of the address holds; nothing if it is none of ours.
export async function fromFragment() {
  const text = /^#s=([\w-]+)$/.exec(location.hash)?.[1];
  if (!text) return undefined;
  try {
    const bytes = Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
    const state = JSON.parse(new TextDecoder().decode(await piped(bytes, new DecompressionStream("deflate-raw"))));
    return typeof state.scenario === "object" && state.scenario !== null ? { scenario: state.scenario, request: state.request ?? {} } : undefined;
  } catch {
    return undefined;
  }
}

// Takes dropped files: a scenario; a finite-element model, which goes into the scenario that is there; a list of axles; limits.
export async function take(files, now) {
  let { scenario, request } = now;
  let limits;
  for (const file of files) {
    const text = (await file.text()).replace(/^\ufeff/, "");
    if (/\.(csv|txt)$/i.test(file.name)) {
      scenario = { ...scenario, train: { ...scenario.train, cars: undefined, forces: axles(text, file.name) } };
      request = { ...request, way: "auto", trains: [] };
      continue;
    }
    let value;
    try {
      value = JSON.parse(text);
    } catch (error) {
      throw new Error(`${file.name}: must be JSON: ${error.message}`);
    }
    if (Array.isArray(value?.criteria)) {
      limits = { name: file.name, text };
    } else if (value?.nodes && value?.deck) {
      scenario = { ...scenario, bridge: { ...scenario.bridge, structure: { type: "finite-elements", model: value } } };
    } else if (value?.train && value?.bridge) {
      ({ page: request = {} } = value.$comment ?? {});
      scenario = value;
      if (request.trains || request.speeds) delete scenario.$comment;
    } else {
      throw new Error(`${file.name}: it must be a scenario (train and bridge), a finite-element model (nodes and deck) or a file of limits (criteria)`);
    }
  }
  return { scenario, request, limits };
}

function axles(text, name) {
  const rows = text.split(/\r?\n/).map((line) => line.trim()).filter((line) => line && !line.startsWith("#")).slice(1);
  const read = rows.map((line) => line.split(/[,;\t]/).map(Number));
  if (!/^x[,;\t]load/i.test(text.trim()) || read.some((row) => row.length < 2 || row.some(Number.isNaN))) {
    throw new Error(`${name}: a list of axles begins with the line x,load; then m behind the first axle and kN`);
  }
  return read.map(([x, load]) => [x, 1000 * load]);
}

const SPANS = { length: 24, first_frequency: 4.5, mass: 15000 };

export function example(name, about) {
  if (name === "default") return { scenario: JSON.parse(about.default_scenario), request: { way: "coupled" } };
  const bridge = { structure: { type: "beams", spans: [SPANS, SPANS] }, damping: { type: "rayleigh", ratio: 0.01 } };
  if (name === "spans") {
    const scenario = { train: { cars: ["ice3"], speed: { km_h: 140 } }, track: { type: "slab" }, bridge };
    return { scenario, request: { trains: ["hslm-a"], speeds: "140:420:5", way: "auto" } };
  }
  if (name === "ice3") {
    const irregularity = { type: "spectrum", spectrum: "german-low", seed: 1, wavelengths: [3, 80] };
    const scenario = { train: { cars: ["ice3"], speed: { km_h: 200 } }, track: { type: "ballast-two-layer" }, irregularity, bridge };
    return { scenario, request: { trains: [], speeds: "200:300:5", way: "coupled" } };
  }
  return undefined;
}
