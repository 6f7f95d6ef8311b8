// Starts a worker of Buslens: the glue, which then fetches the wasm.
import start from "./page.js";
start({ module_or_path: new URL("./page.wasm", import.meta.url) });
