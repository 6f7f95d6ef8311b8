
// Starts Buslens, as a page and as the page's worker. What stands before this says how its parts are come
// by: `inPage`, `load`, `started`, `advice` and `startWorker`.
// The note in the page says what is wrong where not even this script may run, see page.rs.
try {
  // Chosen in an earlier visit, see header.rs; a browser may forbid to look.
  if (inPage) document.documentElement.dataset.theme = localStorage.getItem("buslens.theme") ?? "";
} catch {}
(async () => {
  const note = inPage ? document.getElementById("boot") : null;
  try {
    await load();
    note?.remove();
  } catch (error) {
    console.error(error);
    if (note === null) {
      // Only what nobody catches reaches the page.
      setTimeout(() => { throw error; });
      return;
    }
    note.textContent =
      `Buslens could not start. ${advice} ` +
      "If that does not help, try a current version of Firefox, Chrome, Edge or Safari.";
    note.className = "failed";
    note.setAttribute("role", "alert");
    return;
  }
  if (inPage) started();
})();
