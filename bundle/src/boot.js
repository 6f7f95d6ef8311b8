// Starts Buslens, as a page and as the page's worker: the glue first, which then fetches the wasm.
// The note in the page says what is wrong where not even this script may run, see page.rs.
const inPage = "document" in globalThis;
try {
  // Chosen in an earlier visit, see header.rs; a browser may forbid to look.
  if (inPage) document.documentElement.dataset.theme = localStorage.getItem("buslens.theme") ?? "";
} catch {}
(async () => {
  const note = inPage ? document.getElementById("boot") : null;
  try {
    const page = await import("./page.js");
    await page.default({ module_or_path: new URL("./page.wasm", import.meta.url) });
    note?.remove();
  } catch (error) {
    console.error(error);
    if (note === null) {
      // Only what nobody catches reaches the page.
      setTimeout(() => { throw error; });
      return;
    }
    note.textContent =
      "Buslens could not start. Check the connection and reload the page. " +
      "If that does not help, try a current version of Firefox, Chrome, Edge or Safari.";
    note.className = "failed";
    note.setAttribute("role", "alert");
  }
})();
