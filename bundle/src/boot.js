// Starts Buslens: the glue first, which then fetches the wasm. A plain script and not a module,
// since a page opened by file:// may run it: there it can say why nothing else will start.
(async (here) => {
  try {
    const page = await import(new URL("./page.js", here));
    await page.default({ module_or_path: new URL("./page.wasm", here) });
  } catch (error) {
    console.error(error);
    const message = document.createElement("p");
    message.setAttribute("role", "alert");
    message.textContent =
      location.protocol === "file:"
        ? "Buslens cannot start from a file: browsers load its program from a web server only. " +
          "In the project's folder, `cargo xtask serve` starts one."
        : "Buslens could not start. Check the connection and reload the page. " +
          "If that does not help, try a current version of Firefox, Chrome, Edge or Safari.";
    document.body.append(message);
  }
})(document.currentScript.src);
