//! A static web server for this machine alone: for work on the page, and for its tests.

use std::fs::File;
use std::io::{self, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::steps::Result;

pub const USUAL_PORT: &str = "8080";

/// How many ports after the wanted one are tried.
const PORTS_TRIED: u16 = 100;

/// More than a browser sends for a page without cookies.
const LONGEST_REQUEST: u64 = 32 * 1024;

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

/// Serves the folder in threads of its own until the program ends.
pub fn start(listener: TcpListener, folder: &'static Path) {
    std::thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            // A browser that goes away in the middle of an answer is no error to report.
            std::thread::spawn(move || answer(stream, folder));
        }
    });
}

/// Reads one request and answers it. Each connection serves one request only.
fn answer(mut stream: TcpStream, folder: &Path) -> io::Result<()> {
    // Browsers open connections that they may never use.
    stream.set_read_timeout(Some(Duration::from_secs(10)))?;
    let head = request_head(&mut stream)?;
    let response = respond(&head, folder);

    write!(
        stream,
        "HTTP/1.1 {}\r\nContent-Type: {}\r\nContent-Length: {}\r\n\
         Content-Security-Policy: frame-ancestors 'none'\r\n\
         X-Content-Type-Options: nosniff\r\nCache-Control: no-store\r\n\
         Connection: close\r\n\r\n",
        response.status,
        response.content_type,
        response.body.len(),
    )?;
    if !head.starts_with(b"HEAD ") {
        stream.write_all(&response.body)?;
    }
    stream.flush()
}

/// The request up to its empty line.
fn request_head(stream: &mut TcpStream) -> io::Result<Vec<u8>> {
    let mut head = Vec::new();
    let mut part = [0; 4096];
    while !head.windows(4).any(|bytes| bytes == b"\r\n\r\n") {
        let length = stream.read(&mut part)?;
        if length == 0 || (head.len() + length) as u64 > LONGEST_REQUEST {
            return Err(io::ErrorKind::InvalidData.into());
        }
        head.extend(&part[..length]);
    }
    Ok(head)
}

struct Response {
    status: &'static str,
    content_type: &'static str,
    body: Vec<u8>,
}

fn respond(head: &[u8], folder: &Path) -> Response {
    let line = head.split(|&byte| byte == b'\r').next().unwrap_or_default();
    let line = String::from_utf8_lossy(line);
    let mut words = line.split(' ');
    let (method, target) = (words.next().unwrap_or(""), words.next().unwrap_or(""));
    if !matches!(method, "GET" | "HEAD") {
        return sentence("405 Method Not Allowed", "This server only hands out files.");
    }
    let Some(path) = file_path(target) else {
        return sentence("400 Bad Request", "That is not the address of a file here.");
    };
    let mut body = Vec::new();
    let read = File::open(folder.join(&path)).and_then(|mut file| file.read_to_end(&mut body));
    if read.is_err() {
        let text = format!("There is no file {} here.", path.display());
        return sentence("404 Not Found", &text);
    }
    Response { status: "200 OK", content_type: content_type(&path), body }
}

fn sentence(status: &'static str, text: &str) -> Response {
    Response { status, content_type: "text/plain; charset=utf-8", body: format!("{text}\n").into_bytes() }
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
