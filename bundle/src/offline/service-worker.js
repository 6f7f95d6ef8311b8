// Keeps the page in the browser, so that it opens without a connection; docs/offline.md says how.
//
// A name with a hash in it never means anything else: those files come from the cache first, whichever
// version of the page asks for them. Only the document says which files belong together. It comes from the
// network, or else out of the cache of this version. So no page ever has files of two versions.

// Put in by the bundler: the version, and its files with the hash of each. What a server hands out while a
// newer version is put there does not get in.
const VERSION = "VERSION";
const FILES = {};

const DOCUMENT = "./";
/** Caches belong to the origin, on which other copies of Buslens may live. */
const OWN = `buslens ${registration.scope} `;
const CACHE = OWN + VERSION;
/** How long the network may take to answer, in milliseconds. */
const PATIENCE = 2000;
const HASHED = /^[\w-]+-[0-9a-f]{16}\.\w+$/;

// Pages of an older version go on with their own files: nobody has to wait until they are closed.
addEventListener("install", (event) => event.waitUntil(fill().then(() => skipWaiting())));

addEventListener("activate", (event) => event.waitUntil(begin()));

// A page has started, and so the one before it is gone: see register.js.
addEventListener("message", (event) => event.waitUntil(tidy()));

addEventListener("fetch", (event) => {
  const { method, mode, url } = event.request;
  const address = url.split(/[?#]/)[0];
  if (method !== "GET" || !address.startsWith(registration.scope)) return;
  const name = address.slice(registration.scope.length);
  if (mode === "navigate" && ["", "index.html"].includes(name)) {
    event.respondWith(page(event.request));
  } else if (HASHED.test(name)) {
    event.respondWith(file(event.request));
  }
});

/** Takes every file of this version; those that an older version has, too, are not fetched again. */
async function fill() {
  const cache = await caches.open(CACHE);
  const take = async ([name, integrity]) => {
    const kept = HASHED.test(name) ? await caches.match(name, { ignoreVary: true }) : undefined;
    const response = kept ?? (await fetch(name, { integrity, cache: "no-cache" }));
    if (!response.ok) throw new Error(`${name}: ${response.status}`);
    // Made anew: no page opens from a response that was redirected.
    await cache.put(name, new Response(response.body, response));
  };
  await Promise.all(Object.entries(FILES).map(take));
}

async function begin() {
  await clients.claim();
  await tidy();
  for (const client of await clients.matchAll({ type: "window" })) {
    // A copy in a folder below has no worker of its own yet.
    if (new URL("./", client.url).href === registration.scope) client.postMessage(VERSION);
  }
}

/** Removes other versions, but those that an open page is of; and takes again what is missing of this one. */
async function tidy() {
  // One that is on its way fills its cache, and then has the say.
  const coming = [registration.installing, registration.waiting].some((it) => it && it !== self.serviceWorker);
  if (coming || self.serviceWorker?.state === "redundant") return;
  // Open pages hold a lock that is called like their cache.
  const locks = (await navigator.locks?.query())?.held ?? [];
  const used = [CACHE, ...locks.map((lock) => lock.name)];
  const others = (await caches.keys()).filter((name) => name.startsWith(OWN) && !used.includes(name));
  await Promise.all(others.map((name) => caches.delete(name)));
  // A browser that is short of room, or a person, may have cleared the cache alone.
  const kept = await (await caches.open(CACHE)).keys();
  if (kept.length < Object.keys(FILES).length) await fill().catch(() => {});
}

async function page(request) {
  const network = fetch(request, { cache: "no-cache" });
  const late = new Promise((resolve) => setTimeout(resolve, PATIENCE));
  const first = await Promise.race([network, late]).catch(() => undefined);
  // A redirection is the browser's to follow: somebody may have to sign in.
  if (first?.ok || first?.type === "opaqueredirect") return first;
  const kept = await (await caches.open(CACHE)).match(DOCUMENT, { ignoreVary: true });
  return kept ?? network;
}

async function file(request) {
  return (await caches.match(request.url, { ignoreVary: true })) ?? fetch(request);
}
