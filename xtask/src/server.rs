//! A static web server for this machine alone: for work on the page, and for its tests.

use std::io::{self, Cursor};
use std::net::{Ipv4Addr, TcpListener};
use std::path::{Path, PathBuf};

use tiny_http::{Header, Method, Response, Server};

use crate::steps::Result;

pub const USUAL_PORT: &str = "8080";

/// How many ports after the wanted one are tried.
const PORTS_TRIED: u16 = 100;

/// Takes the wanted port, or the next free one; 0 takes any.
pub fn listen(wanted: u16) -> Result<TcpListener> {
    for port in wanted..=wanted.saturating_add(PORTS_TRIED) {
        match TcpListener::bind((Ipv4Addr::LOCALHOST, port)) {
            Ok(listener) => return Ok(listener),
            Err(error) if error.kind() == io::ErrorKind::AddrInUse => {}
            Err(error) => return Err(format!("Port {port} cannot be used: {error}.")),
        }
    }
    Err(format!(
        "Port {wanted} and the {PORTS_TRIED} after it are taken. \
         Name another one: `cargo xtask serve --port 9000`."
    ))
}

/// The port that the listener took.
pub fn port(listener: &TcpListener) -> Result<u16> {
    let address = listener.local_addr();
    address
        .map(|address| address.port())
        .map_err(|error| format!("The server's own port is not known: {error}."))
}

/// Where the server on this port is reached.
pub fn address(port: u16) -> String {
    format!("http://{}:{port}/", Ipv4Addr::LOCALHOST)
}

/// Serves the folder in a thread of its own until the program ends.
pub fn start(listener: TcpListener, folder: &'static Path) -> Result {
    let server = Server::from_listener(listener, None)
        .map_err(|error| format!("The server did not start: {error}."))?;
    std::thread::spawn(move || {
        for request in server.incoming_requests() {
            let response = respond(request.method(), request.url(), folder);
            // A browser that goes away in the middle of an answer is no error to report.
            let _ = request.respond(response);
        }
    });
    Ok(())
}

fn respond(method: &Method, target: &str, folder: &Path) -> Response<Cursor<Vec<u8>>> {
    let sentence = |status: u16, text: &str| {
        response(status, "text/plain; charset=utf-8", format!("{text}\n").into_bytes())
    };
    if !matches!(method, Method::Get | Method::Head) {
        return sentence(405, "This server only hands out files.");
    }
    let Some(path) = file_path(target) else {
        return sentence(400, "That is not the address of a file here.");
    };
    match std::fs::read(folder.join(&path)) {
        Ok(content) => response(200, content_type(&path), content),
        Err(_) => sentence(404, &format!("There is no file {} here.", path.display())),
    }
}

fn response(status: u16, content_type: &str, body: Vec<u8>) -> Response<Cursor<Vec<u8>>> {
    let headers = [
        ("Content-Type", content_type),
        ("Content-Security-Policy", "frame-ancestors 'none'"),
        ("X-Content-Type-Options", "nosniff"),
        ("Cache-Control", "no-store"),
    ];
    // With its length, not in chunks: the browser then knows how much is to come.
    let mut response = Response::from_data(body).with_status_code(status).with_chunked_threshold(usize::MAX);
    for header in headers.iter().flat_map(|(name, value)| Header::from_bytes(*name, *value)) {
        response.add_header(header);
    }
    response
}

/// The file that a request's target means, relative to the served folder; `None` for a target that
/// could lead out of it. A folder means its `index.html`.
fn file_path(target: &str) -> Option<PathBuf> {
    let path = target.split(['?', '#']).next()?;
    let path = percent_decoded(path.strip_prefix('/')?)?;
    let mut file = PathBuf::new();
    for name in path.split('/') {
        // A backslash or a colon would lead elsewhere on Windows.
        if matches!(name, "." | "..") || name.contains(['\\', ':', '\0']) {
            return None;
        }
        file.push(name);
    }
    if path.is_empty() || path.ends_with('/') {
        file.push("index.html");
    }
    file.is_relative().then_some(file)
}

/// `a%20b` is `a b`; `None` for a broken escape, or bytes that are no UTF-8.
fn percent_decoded(text: &str) -> Option<String> {
    let mut parts = text.split('%');
    let mut bytes = parts.next()?.as_bytes().to_vec();
    for part in parts {
        let (digits, rest) = part.split_at_checked(2)?;
        if !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
            return None;
        }
        bytes.push(u8::from_str_radix(digits, 16).ok()?);
        bytes.extend(rest.bytes());
    }
    String::from_utf8(bytes).ok()
}

fn content_type(path: &Path) -> &'static str {
    let extension = path.extension().and_then(|extension| extension.to_str());
    match extension {
        Some("html") => "text/html; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("json") => "application/json",
        Some("webmanifest") => "application/manifest+json",
        // Anything else, and a browser compiles it only after the last byte has come.
        Some("wasm") => "application/wasm",
        Some("svg") => "image/svg+xml",
        Some("png") => "image/png",
        Some("txt") => "text/plain; charset=utf-8",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(target: &str) -> Option<String> {
        file_path(target).map(|path| path.to_str().unwrap().replace('\\', "/"))
    }

    #[test]
    fn targets_become_files() {
        assert_eq!(path("/").as_deref(), Some("index.html"));
        assert_eq!(path("/?a=/../b").as_deref(), Some("index.html"));
        assert_eq!(path("/page-1.wasm").as_deref(), Some("page-1.wasm"));
        assert_eq!(path("/sub/").as_deref(), Some("sub/index.html"));
        assert_eq!(path("/a%20b.css").as_deref(), Some("a b.css"));
    }

    #[test]
    fn nothing_outside_the_folder_is_reached() {
        for target in [
            "/../Cargo.toml",
            "/%2e%2e/Cargo.toml",
            "/%2E%2E%2FCargo.toml",
            "/sub/../../Cargo.toml",
            "/..%5cCargo.toml",
            "/c:/Windows/win.ini",
            "//etc/passwd",
            "/%2fetc/passwd",
            "/a%00b",
            "http://example.org/",
            "",
        ] {
            let reached = path(target);
            let inside = reached.as_deref().is_none_or(|file| !file.starts_with('/') && !file.contains(".."));
            assert!(inside, "{target} reaches {reached:?}");
        }
    }

    #[test]
    fn broken_escapes_are_refused() {
        for target in ["/%", "/%4", "/%zz", "/%+1", "/%ff", "/%é"] {
            assert_eq!(path(target), None, "{target}");
        }
    }

    #[test]
    fn the_types_that_browsers_insist_on() {
        assert_eq!(content_type(Path::new("page-1.wasm")), "application/wasm");
        assert_eq!(content_type(Path::new("page-1.js")), "text/javascript; charset=utf-8");
        assert_eq!(content_type(Path::new("page-1.wasm.br")), "application/octet-stream");
    }
}
