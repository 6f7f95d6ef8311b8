// Starts Buslens: the glue first, which then fetches the wasm. The note in the page says what is
// wrong where not even this script may run, see page.rs.
try {
  // Chosen in an earlier visit, see header.rs; a browser may forbid to look.
  document.documentElement.dataset.theme = localStorage.getItem("buslens.theme") ?? "";
} catch {}
(async (here) => {
  const note = document.getElementById("boot");
  try {
    const page = await import(new URL("./page.js", here));
    await page.default({ module_or_path: new URL("./page.wasm", here) });
    note.remove();
  } catch (error) {
    console.error(error);
    if (location.protocol !== "file:") {
      note.textContent =
        "Buslens could not start. Check the connection and reload the page. " +
        "If that does not help, try a current version of Firefox, Chrome, Edge or Safari.";
    }
    note.className = "failed";
    note.setAttribute("role", "alert");
  }
})(document.currentScript.src);
