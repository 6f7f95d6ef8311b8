//! The text files of the page: its document with its links and its policy, and the boot script.

use crate::names::integrity;

/// Starts the page, once it is known how its parts are come by.
pub const START: &str = include_str!("boot/start.js");

/// Where they are files of a server: by the plain names of those files.
const HOSTED: &str = include_str!("boot/hosted.js");

/// Has the page kept in the browser.
const REGISTER: &str = include_str!("offline/register.js");

/// The same for a page that is not kept.
const NOT_KEPT: &str = "\nconst started = () => {};\n";

/// The note in the page while it is not running. A page opened by file:// gets neither its scripts
/// nor its stylesheet, so only the document itself can say why nothing happens. Everywhere else the
/// stylesheet hides the note, and the boot script removes it or gives it the fitting words.
fn note(edition: &Edition) -> String {
    let one_file = edition.one_file.map_or(String::new(), |(name, _)| {
        format!(
            " Beside it, <a href=\"./{name}\">{name}</a> is the whole page as one file, which opens anywhere."
        )
    });
    format!(
        "<p id=\"boot\">Buslens is starting. If it does not: browsers load it from a web server only, not from a \
         file.{one_file} In the project's folder, <code>cargo xtask serve</code> starts a server.</p>"
    )
}

/// Hides the note; belongs to the end of the stylesheet.
pub const NOTE_STYLE: &str = include_str!("boot/note.css");

/// What the page may do: run its own files, compile its wasm, and talk to nobody else.
/// `frame-ancestors` is missing because a browser reads it from a header only.
const POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; \
    img-src 'self' data:; font-src 'self'; connect-src 'self'; worker-src 'self'; \
    manifest-src 'self'; base-uri 'none'; form-action 'none'";

/// A file of the page under its hashed name.
pub struct File {
    pub name: String,
    pub content: Vec<u8>,
}

/// What the document links to.
pub struct Links<'a> {
    pub style: &'a File,
    pub icon: &'a File,
    pub manifest: &'a File,
    pub boot: &'a File,
    pub glue: &'a File,
    pub wasm: &'a File,
    /// For what comes later, see src/browser/stylesheet.rs.
    pub later_style: &'a File,
}

/// What the document says of itself, for src/browser/edition.rs.
#[derive(Clone, Copy)]
pub struct Edition<'a> {
    pub version: &'a str,
    /// `hosted`, `one-file` or `development`.
    pub kind: &'a str,
    /// The page as one file, and its length.
    pub one_file: Option<(&'a str, usize)>,
}

/// The boot script with hashed names in the place of plain ones: `./page.js` becomes
/// `./page-0123456789abcdef.js`.
pub fn boot(glue: &File, wasm: &File, is_kept: bool) -> Result<String, String> {
    let text = replace_once(HOSTED, "./page.js", &format!("./{}", glue.name))?;
    let text = replace_once(&text, "./page.wasm", &format!("./{}", wasm.name))?;
    Ok([text.as_str(), if is_kept { REGISTER } else { NOT_KEPT }, START].concat())
}

/// The addresses that `template` links to as `rel`, in their order.
pub fn linked<'a>(template: &'a str, rel: &str) -> Vec<&'a str> {
    let start = format!("<link rel=\"{rel}\" href=\"");
    let links = template.match_indices(&start).map(|(at, _)| &template[at + start.len()..]);
    links.filter_map(|rest| Some(rest.split_once('"')?.0)).collect()
}

/// The document: the template with the files of the page in place of those it was written with. All
/// addresses are relative, so that the page works in any folder of a site.
pub fn html(template: &str, edition: &Edition, links: &Links) -> Result<String, String> {
    let Links { style, icon, manifest, boot, glue, wasm, later_style } = links;
    let lines = [
        format!(
            r#"<link rel="preload" href="./{}" as="fetch" type="application/wasm" crossorigin>"#,
            wasm.name
        ),
        format!(
            r#"<link rel="modulepreload" href="./{}" integrity="{}">"#,
            glue.name,
            integrity(&glue.content)
        ),
        format!(
            r#"<link rel="stylesheet" href="./{}" integrity="{}">"#,
            style.name,
            integrity(&style.content)
        ),
        format!(r#"<meta name="later-style" content="./{}">"#, later_style.name),
        format!(r#"<link rel="icon" href="./{}" type="image/svg+xml">"#, icon.name),
        format!(r#"<link rel="manifest" href="./{}" crossorigin="use-credentials">"#, manifest.name),
        format!(
            r#"<script type="module" src="./{}" integrity="{}"></script>"#,
            boot.name,
            integrity(&boot.content)
        ),
    ];
    document(template, POLICY, edition, &lines, &note(edition))
}

/// The template with the policy at the start of its head, before anything that the policy governs, `lines` at
/// the end of it in place of the links it was written with, and `body` at the start of its body.
pub fn document(
    template: &str,
    policy: &str,
    edition: &Edition,
    lines: &[String],
    body: &str,
) -> Result<String, String> {
    let own = |line: &&str| !line.trim_start().starts_with("<link rel=");
    let plain = template.lines().filter(own).map(|line| format!("{line}\n")).collect::<String>();
    let policy = format!("<head>\n    <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">");
    let with_policy = replace_once(&plain, "<head>", &policy)?;

    let mut head = vec![
        format!(r#"<meta name="version" content="{}">"#, edition.version),
        format!(r#"<meta name="edition" content="{}">"#, edition.kind),
    ];
    if let Some((name, bytes)) = edition.one_file {
        head.push(format!(r#"<meta name="one-file" content="./{name} {bytes}">"#));
    }
    head.extend_from_slice(lines);
    let head = format!("  {}\n  </head>", head.join("\n    "));
    let with_links = replace_once(&with_policy, "</head>", &head)?;
    replace_once(&with_links, "<body>", &format!("<body>\n    {body}"))
}

/// A stylesheet without its comments and indents, which nobody reads in a browser.
pub fn without_comments(style: &str) -> String {
    let mut kept = String::with_capacity(style.len());
    let mut rest = style;
    while let Some((before, comment)) = rest.split_once("/*") {
        kept.push_str(before);
        rest = comment.split_once("*/").map_or("", |(_, after)| after);
    }
    kept.push_str(rest);
    let lines = kept.lines().map(str::trim).filter(|line| !line.is_empty());
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// Replaces the only place where `text` has `from`. A template in which it is missing, or stands
/// twice, would give a page without its policy or without its script.
pub fn replace_once(text: &str, from: &str, to: &str) -> Result<String, String> {
    match text.matches(from).count() {
        1 => Ok(text.replacen(from, to, 1)),
        count => Err(format!(
            "`{from}` should stand exactly once in the template, but stands there {count} times."
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEMPLATE: &str = "<html>\n  <head>\n    <title>T</title>\n    \
        <link rel=\"stylesheet\" href=\"style/a.css\">\n    <link rel=\"stylesheet\" href=\"style/b.css\">\n  \
        </head>\n  <body></body>\n</html>\n";

    const EDITION: Edition =
        Edition { version: "1.2.3+abcd", kind: "hosted", one_file: Some(("buslens.html", 1234)) };

    fn file(name: &str) -> File {
        File { name: name.to_owned(), content: name.as_bytes().to_vec() }
    }

    fn page(template: &str) -> Result<String, String> {
        html(
            template,
            &EDITION,
            &Links {
                style: &file("page-1.css"),
                icon: &file("icon-2.svg"),
                manifest: &file("manifest-6.json"),
                boot: &file("boot-3.js"),
                glue: &file("page-4.js"),
                wasm: &file("page-5.wasm"),
                later_style: &file("later-7.css"),
            },
        )
    }

    #[test]
    fn the_policy_comes_before_all_it_governs() {
        let html = page(TEMPLATE).unwrap();
        let policy = html.find("Content-Security-Policy").unwrap();
        let first_address = html.find("href=").unwrap();
        assert!(policy < first_address, "{html}");
    }

    #[test]
    fn every_address_is_relative_and_no_script_is_inline() {
        let html = page(TEMPLATE).unwrap();
        for (start, _) in html.match_indices("href=\"").chain(html.match_indices("src=\"")) {
            let address = html[start..].split('"').nth(1).unwrap();
            assert!(address.starts_with("./"), "{address} is not relative");
        }
        assert_eq!(html.matches("<script").count(), 1, "{html}");
        assert!(html.contains("\"></script>"), "{html}");
        assert!(!html.contains("<style"), "{html}");
    }

    #[test]
    fn the_stylesheets_of_the_template_are_found_and_replaced_by_one() {
        assert_eq!(linked(TEMPLATE, "stylesheet"), ["style/a.css", "style/b.css"]);
        let html = page(TEMPLATE).unwrap();
        assert_eq!(linked(&html, "stylesheet"), ["./page-1.css"]);
    }

    #[test]
    fn comments_and_indents_of_a_stylesheet_are_left_out() {
        let style =
            "/* One. */\n@layer a {\n  .b > c { color: red; } /* two\n  lines */\n\n  d { e: f; }\n}\n";
        assert_eq!(without_comments(style), "@layer a {\n.b > c { color: red; }\nd { e: f; }\n}\n");
        assert_eq!(without_comments("a {}\n/* open"), "a {}\n");
    }

    #[test]
    fn a_template_without_a_head_is_refused() {
        let error = page("<html><body></body></html>").unwrap_err();
        assert!(error.contains("`<head>`"), "{error}");
    }

    #[test]
    fn the_boot_script_loads_the_hashed_names() {
        for is_kept in [true, false] {
            let boot = boot(&file("page-4.js"), &file("page-5.wasm"), is_kept).unwrap();
            assert!(boot.contains("\"./page-4.js\""), "{boot}");
            assert!(boot.contains("\"./page-5.wasm\""), "{boot}");
            assert_eq!(boot.contains("serviceWorker"), is_kept, "{boot}");
        }
    }

    #[test]
    fn the_document_says_what_it_is() {
        let html = page(TEMPLATE).unwrap();
        assert!(html.contains(r#"<meta name="version" content="1.2.3+abcd">"#), "{html}");
        assert!(html.contains(r#"<meta name="edition" content="hosted">"#), "{html}");
        assert!(html.contains(r#"<meta name="one-file" content="./buslens.html 1234">"#), "{html}");
    }
}
