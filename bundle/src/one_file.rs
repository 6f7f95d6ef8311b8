//! The whole page as one HTML file, which opens from a disk without a server: the same stylesheet, the same
//! glue and the same parts of the module, in the document itself.

use data_encoding::BASE64;

use crate::names;
use crate::page::{self, Edition, File, replace_once};

/// How the parts are come by.
const ONE_FILE: &str = include_str!("boot/one-file.js");

/// The note while the page is not running, see page.rs.
const NOTE: &str = "<p id=\"boot\">Buslens is starting. If it does not, this browser is too old, or forbids \
    scripts in files that are opened from a disk.</p>";

/// The document. `modules` are the parts of the module, the first one first, with what they are with gzip.
pub fn html(
    template: &str,
    version: &str,
    styles: &[&File],
    icon: &File,
    glue: &File,
    modules: &[(&File, Vec<u8>)],
) -> Result<String, String> {
    let [(first, _), ..] = modules else { return Err("The page has no module.".to_owned()) };
    let style = styles.iter().map(|style| text(style)).collect::<Result<String, String>>()?;
    if style.contains("</") {
        return Err("The stylesheet would end before its end, in the page as one file.".to_owned());
    }
    let script = script(text(glue)?, &first.name)?;
    let lines = [
        format!(
            r#"<link rel="icon" href="data:image/svg+xml;base64,{}" type="image/svg+xml">"#,
            BASE64.encode(&icon.content)
        ),
        format!("<style>{style}</style>"),
    ];
    let mut body = NOTE.to_owned();
    for (file, packed) in modules {
        let (name, data) = (&file.name, BASE64.encode(packed));
        body.push_str(&format!("\n<script type=\"text/plain\" data-part=\"./{name}\">{data}</script>"));
    }
    body.push_str(&format!("\n<script>{script}</script>"));
    let edition = Edition { version, kind: "one-file", one_file: None };
    page::document(template, &policy(&style, &script), &edition, &lines, &body)
}

/// What the file may do: run its one script, use its one stylesheet, and talk to nobody at all.
fn policy(style: &str, script: &str) -> String {
    let [style, script] = [style, script].map(|text| names::sha256(text.as_bytes()));
    format!(
        "default-src 'none'; script-src '{script}' 'wasm-unsafe-eval'; style-src '{style}'; img-src data:; \
         worker-src blob:; base-uri 'none'; form-action 'none'"
    )
}

/// The script of the page and of its worker.
fn script(glue: &str, first: &str) -> Result<String, String> {
    let text = replace_once(ONE_FILE, "./page.wasm", &format!("./{first}"))?;
    let text = replace_once(&text, "GLUE", &plain(glue)?)?;
    let script = format!("(() => {{\n\"use strict\";\n{text}{}}})();\n", page::START);
    if script.contains("</") || script.contains("<!--") || script.contains('\r') {
        return Err("The script would end before its end, in the page as one file.".to_owned());
    }
    Ok(script)
}

/// The glue, which is a module, as an expression of a plain script: what it exports by default. Its parts
/// are not fetched but unpacked, by the function `part`.
fn plain(glue: &str) -> Result<String, String> {
    const LAST: &str = "export{initSync,__wbg_init as default};";
    let mut text = replace_once(glue, LAST, "")?.replace("export class ", "class ");
    while let Some((before, after)) = text.split_once("fetch(new URL(\"") {
        let (name, after) = after
            .split_once("\",import.meta.url))")
            .ok_or("The glue fetches something else than the parts of its own module.")?;
        text = format!("{before}part(\"{name}\"){after}");
    }
    for word in ["import.meta", "import(", "import{", "import ", "export "] {
        if text.contains(word) {
            return Err(format!("The glue still has `{word}`, which a plain script may not have."));
        }
    }
    Ok(format!("(() => {{{text}\nreturn __wbg_init;\n}})()"))
}

fn text(file: &File) -> Result<&str, String> {
    std::str::from_utf8(&file.content).map_err(|_| format!("{} is not UTF-8.", file.name))
}

#[cfg(test)]
mod tests {
    use super::*;

    const GLUE: &str = "export class A{}let wasm;async function __wbg_init(){}export{initSync,__wbg_init as default};\
        const load=()=>{const src=fetch(new URL(\"./later-2.wasm\",import.meta.url));const more=\
        fetch(new URL(\"./log-3.wasm\",import.meta.url));};";

    fn file(name: &str, content: &str) -> File {
        File { name: name.to_owned(), content: content.as_bytes().to_vec() }
    }

    fn page(style: &str, glue: &str) -> Result<String, String> {
        html(
            "<html>\n  <head>\n    <link rel=\"icon\" href=\"a.svg\">\n  </head>\n  <body></body>\n</html>\n",
            "1.2.3+abcd",
            &[&file("page-1.css", style)],
            &file("icon-1.svg", "<svg/>"),
            &file("page-1.js", glue),
            &[(&file("page-1.wasm", ""), vec![1, 2, 3]), (&file("later-2.wasm", ""), vec![4])],
        )
    }

    #[test]
    fn the_policy_allows_exactly_what_stands_in_the_file() {
        let html = page("a{color:red}", GLUE).unwrap();
        let between = |from: &str, to: &str| html.split_once(from).unwrap().1.split_once(to).unwrap().0;
        let policy = between("Content-Security-Policy\" content=\"", "\"");
        let sha256 = |text: &str| format!("'{}'", names::sha256(text.as_bytes()));
        assert!(policy.starts_with("default-src 'none'; "), "{policy}");
        assert!(policy.contains(&sha256(between("<script>", "</script>"))), "{policy}");
        assert!(policy.contains(&sha256(between("<style>", "</style>"))), "{policy}");
        assert!(
            !policy.contains("'self'") && !policy.contains("http") && !policy.contains("connect"),
            "{policy}"
        );
    }

    #[test]
    fn the_parts_stand_in_the_file_and_nothing_is_fetched() {
        let html = page("a{}", GLUE).unwrap();
        assert!(html.contains("data-part=\"./page-1.wasm\">AQID</script>"), "{html}");
        assert!(html.contains("data-part=\"./later-2.wasm\">BA==</script>"), "{html}");
        assert!(html.contains("const src=part(\"./later-2.wasm\")"), "{html}");
        assert!(html.contains("const more=part(\"./log-3.wasm\")"), "{html}");
        assert!(html.contains("part(\"./page-1.wasm\")"), "{html}");
        for word in ["import.meta", "export", "href=\"./", "src=\"", "GLUE"] {
            assert!(!html.contains(word), "{word} in {html}");
        }
    }

    #[test]
    fn what_would_break_the_file_is_refused() {
        assert!(page("a{content:'</style>'}", GLUE).is_err());
        assert!(page("a{}", &format!("{GLUE}const a='</script>';")).is_err());
        assert!(page("a{}", &format!("{GLUE}await import('./x.js');")).is_err());
        assert!(page("a{}", "function __wbg_init(){}").is_err());
    }
}
