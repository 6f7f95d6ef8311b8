// Takes Buslens out of the browser again: its caches, and this worker itself. `cargo xtask serve` puts it in
// the place of service-worker.js, and so does whoever hosts the page and no longer wants it kept.
addEventListener("install", () => skipWaiting());

addEventListener("activate", (event) => event.waitUntil(leave()));

async function leave() {
  const own = (await caches.keys()).filter((name) => name.startsWith(`buslens ${registration.scope} `));
  await Promise.all(own.map((name) => caches.delete(name)));
  await registration.unregister();
}
