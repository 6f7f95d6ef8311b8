// Buslens as one file. Opened by file://, a page may fetch nothing, not even itself: so the parts of the
// module stand in the document, packed, and the worker gets them with its own text.
const inPage = "document" in globalThis;
const advice = "Open the file again.";
const script = inPage ? document.currentScript.textContent : "";
const stored = inPage ? [...document.querySelectorAll("script[data-part]")] : [];
const packed = globalThis.packed ?? Object.fromEntries(stored.map((it) => [it.dataset.part, it.textContent]));

/** A part of the module, as if it had been fetched. */
const part = async (name) => {
  const bytes = Uint8Array.from(atob(packed[name]), (character) => character.charCodeAt(0));
  const unpacked = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(unpacked, { headers: { "Content-Type": "application/wasm" } });
};

const glue = GLUE;
const load = () => glue({ module_or_path: part("./page.wasm") });
const started = () => {};

// How the page starts itself once more as a worker, see src/worker/client.rs. From file://, a module does
// not start as one, and a worker may not fetch what the page made: so it is a plain script with all in it.
let worker;
globalThis.startWorker = () => {
  if (!inPage) return new Worker(location.href);
  const text = [`globalThis.packed = ${JSON.stringify(packed)};\n`, script];
  worker ??= URL.createObjectURL(new Blob(text, { type: "text/javascript" }));
  return new Worker(worker);
};
