// A Web Worker around the engine: verb and JSON in, JSON out. A call that traps leaves the memory as it was at that moment; the
// page then takes another worker.
let engine;

function call(verb, body) {
  const request = new TextEncoder().encode(`${verb}\n${body}`);
  const at = engine.reserve(request.length);
  new Uint8Array(engine.memory.buffer, at, request.length).set(request);
  const length = engine.call();
  return new TextDecoder().decode(new Uint8Array(engine.memory.buffer, engine.answer(), length));
}

onmessage = async ({ data }) => {
  if (data.module) {
    engine = (await WebAssembly.instantiate(data.module, {})).exports;
    return;
  }
  try {
    postMessage({ id: data.id, text: call(data.verb, data.body) });
  } catch (error) {
    postMessage({ id: data.id, trap: String(error) });
  }
};
