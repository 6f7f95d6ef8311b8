//! A server of one's own for a test, which can be stopped and can get another version of the page.

use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;

use data_encoding::BASE64;
use sha2::{Digest, Sha384};

use crate::setting;

/// The page as it was built.
pub fn dist() -> Files {
    read(&PathBuf::from(setting("BUSLENS_DIST")))
}

/// The files of a page, by their names.
pub type Files = BTreeMap<String, Vec<u8>>;

/// A server of this machine. Every folder on it has the page: `/`, `/a/b/`, and so on.
pub struct Site {
    port: u16,
    shared: Arc<Shared>,
    running: Option<JoinHandle<()>>,
}

#[derive(Default)]
struct Shared {
    files: Mutex<Files>,
    how: Mutex<How>,
    asked: Mutex<Vec<String>>,
}

/// How it answers.
#[derive(Clone, Copy, Default, PartialEq)]
enum How {
    #[default]
    Answers,
    /// Takes every request, and says nothing: a bad radio link.
    Hangs,
    Stops,
}

impl Site {
    /// Serves these files.
    pub fn serve(files: Files) -> Self {
        let mut site = Self { port: 0, shared: Arc::default(), running: None };
        site.put(files);
        site.start();
        site
    }

    /// The address of a folder: `""`, `"a/b/"`.
    pub fn address(&self, folder: &str) -> String {
        format!("http://{}:{}/{folder}", Ipv4Addr::LOCALHOST, self.port)
    }

    /// Puts other files in the place of those it has.
    pub fn put(&self, files: Files) {
        *self.shared.files.lock().unwrap() = files;
    }

    /// Takes requests and never answers them.
    pub fn hang(&self) {
        *self.shared.how.lock().unwrap() = How::Hangs;
    }

    /// What it was asked for since the last look.
    pub fn asked(&self) -> Vec<String> {
        std::mem::take(&mut self.shared.asked.lock().unwrap())
    }

    /// Nothing is there any more: no connection is accepted.
    pub fn stop(&mut self) {
        *self.shared.how.lock().unwrap() = How::Stops;
        // Wakes it, so that it looks.
        let _ = TcpStream::connect((Ipv4Addr::LOCALHOST, self.port));
        if let Some(running) = self.running.take() {
            running.join().expect("the server ends");
        }
    }

    /// Is there (again), at the same address.
    pub fn start(&mut self) {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, self.port)).expect("a port is free");
        self.port = listener.local_addr().expect("the port is known").port();
        *self.shared.how.lock().unwrap() = How::Answers;
        let shared = self.shared.clone();
        self.running = Some(std::thread::spawn(move || {
            let mut held = Vec::new();
            for stream in listener.incoming().flatten() {
                let how = *shared.how.lock().unwrap();
                match how {
                    How::Answers => {
                        let shared = shared.clone();
                        std::thread::spawn(move || shared.answer(stream));
                    }
                    How::Hangs => held.push(stream),
                    How::Stops => return,
                }
            }
        }));
    }
}

impl Drop for Site {
    fn drop(&mut self) {
        self.stop();
    }
}

impl Shared {
    /// One request, one answer. A browser that goes away meanwhile is no error.
    fn answer(&self, mut stream: TcpStream) -> Option<()> {
        let mut lines = BufReader::new(stream.try_clone().ok()?).lines();
        let first = lines.next()?.ok()?;
        lines.map_while(Result::ok).take_while(|line| !line.is_empty()).for_each(drop);
        let path = first.split(' ').nth(1)?.split('?').next()?.to_owned();
        self.asked.lock().unwrap().push(path.clone());
        let name = match path.rsplit('/').next()? {
            "" => "index.html",
            name => name,
        };
        let kind = match name.rsplit('.').next()? {
            "html" => "text/html; charset=utf-8",
            "css" => "text/css",
            "js" => "text/javascript",
            "json" => "application/manifest+json",
            "wasm" => "application/wasm",
            "svg" => "image/svg+xml",
            "png" => "image/png",
            _ => "text/plain",
        };
        let found = self.files.lock().unwrap().get(name).cloned();
        let status = if found.is_some() { "200 OK" } else { "404 Not Found" };
        let content = found.unwrap_or_default();
        write!(
            stream,
            "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nCache-Control: no-cache\r\n\
             Connection: close\r\n\r\n",
            content.len()
        )
        .ok()?;
        stream.write_all(&content).ok()
    }
}

/// The page as it would be after a change of every part: each file under another name, with other bytes.
pub fn next_version(files: &Files) -> Files {
    // Names that carry a hash get another one.
    let renamed: BTreeMap<&str, String> =
        files.keys().filter_map(|name| Some((name.as_str(), other_hash(name)?))).collect();
    let mut next: Files = files
        .iter()
        .map(|(name, content)| {
            let content = match name.rsplit('.').next() {
                // A section that nobody reads.
                Some("wasm") => [content, &[0, 2, 1, b'v'][..]].concat(),
                Some("png") => content.clone(),
                _ => renamed.iter().fold(content.clone(), |content, (from, to)| replaced(&content, from, to)),
            };
            let mark: &[u8] = match name.rsplit('.').next() {
                Some("js") => b"\n// next",
                Some("css") => b"\n/* next */",
                _ => b"",
            };
            let name = renamed.get(name.as_str()).cloned().unwrap_or_else(|| name.clone());
            (name, [&content, mark].concat())
        })
        .collect();
    // The document says what its files are to be, the service worker what all of them are to be.
    for outer in ["index.html", "service-worker.js"] {
        let mut content = next[outer].clone();
        for (name, old) in files.iter().filter(|(name, _)| *name != "service-worker.js") {
            let new = &next[renamed.get(name.as_str()).unwrap_or(name)];
            content = replaced(&content, &integrity(old), &integrity(new));
        }
        let version = version(files);
        content = replaced(&content, &version, &format!("{version}next"));
        next.insert(outer.to_owned(), content);
    }
    next
}

/// The page with something else in one of its files, whose name begins so.
pub fn changed(mut files: Files, name: &str, from: &str, to: &str) -> Files {
    let (name, before) = files
        .iter()
        .find(|(file, content)| file.starts_with(name) && String::from_utf8_lossy(content).contains(from))
        .map(|(name, content)| (name.clone(), content.clone()))
        .expect("the page has such a file");
    let after = replaced(&before, from, to);
    let document = replaced(&files["index.html"], &integrity(&before), &integrity(&after));
    files.extend([(name, after), ("index.html".to_owned(), document)]);
    files
}

/// The version that a page says it is.
pub fn version(files: &Files) -> String {
    let document = String::from_utf8_lossy(&files["index.html"]).into_owned();
    let (_, rest) = document.split_once("name=\"version\" content=\"").expect("the page has a version");
    rest.split('"').next().unwrap_or_default().to_owned()
}

/// `page-0123456789abcdef.js` with another hash.
fn other_hash(name: &str) -> Option<String> {
    let (stem, extension) = name.rsplit_once('.')?;
    let (stem, hash) = stem.rsplit_once('-')?;
    (hash.len() == 16).then(|| format!("{stem}-{}.{extension}", hash.chars().rev().collect::<String>()))
}

fn integrity(content: &[u8]) -> String {
    format!("sha384-{}", BASE64.encode(&Sha384::digest(content)))
}

fn replaced(content: &[u8], from: &str, to: &str) -> Vec<u8> {
    String::from_utf8_lossy(content).replace(from, to).into_bytes()
}

fn read(folder: &Path) -> Files {
    let entries = fs::read_dir(folder).expect("the page is built").flatten();
    let files = entries.map(|entry| (entry.file_name().to_string_lossy().into_owned(), entry.path()));
    files
        .filter(|(name, _)| !name.ends_with(".gz") && !name.ends_with(".br"))
        .map(|(name, path)| (name, fs::read(path).expect("a file of the page can be read")))
        .collect()
}
