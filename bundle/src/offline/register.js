
// The page's end of service-worker.js: has the page kept for times without a connection, and hears of new
// versions. Where a browser allows no such thing, nothing happens and nothing is said.
//
// What it finds out stands in the document: `data-kept` once the page is kept, `data-newer` once there is
// another version; src/components/foot.rs shows it.
/** Loading the page comes first, with the parts that it loads when it has time. */
const PAUSE = 3000;
/** How often somebody who leaves the page open is told of new versions, in milliseconds. */
const HOUR = 3_600_000;

const started = () => {
  setTimeout(() => keep().catch(() => {}), PAUSE);
  // Where the page is installed, files of a plant are opened with it: src/app.rs takes them.
  globalThis.launchQueue?.setConsumer(async ({ files }) => {
    const detail = await files?.[0]?.getFile().catch(() => undefined);
    if (detail) dispatchEvent(new CustomEvent("openfile", { detail }));
  });
};

if (inPage) {
  const folder = new URL("./", location.href);
  const version = document.querySelector("meta[name=version]").content;
  const hold = () => new Promise(() => {});
  // As long as this page is open, the files of its version stay.
  navigator.locks?.request(`buslens ${folder} ${version}`, { mode: "shared" }, hold).catch(() => {});
  navigator.serviceWorker?.addEventListener("message", ({ data }) => {
    if (data === version) return;
    document.documentElement.dataset.newer = data;
    dispatchEvent(new Event("newversion"));
  });
}

/** Tells the worker that this page is there, and so the one before it is gone. */
function tell() {
  navigator.serviceWorker.controller?.postMessage("started");
}

async function keep() {
  const registration = await navigator.serviceWorker.register("./service-worker.js", { updateViaCache: "none" });
  await navigator.serviceWorker.ready;
  tell();
  navigator.serviceWorker.addEventListener("controllerchange", tell);
  document.documentElement.dataset.kept = "";
  let looked = Date.now();
  document.addEventListener("visibilitychange", () => {
    if (document.hidden || Date.now() - looked < HOUR) return;
    looked = Date.now();
    registration.update().catch(() => {});
  });
}
