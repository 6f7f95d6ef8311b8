// Buslens as it comes from a server, in files: the glue, which then fetches the wasm.
const inPage = "document" in globalThis;
const advice = "Check the connection and reload the page.";
const load = async () => {
  const page = await import("./page.js");
  await page.default({ module_or_path: new URL("./page.wasm", import.meta.url) });
};

// How the page starts itself once more as a worker, see src/worker/client.rs.
globalThis.startWorker = () => new Worker(import.meta.url, { type: "module" });
