//! The programs that the other commands need, and how each is installed where it is missing.

use std::path::PathBuf;
use std::process::Command;

use crate::steps::{self, Result};

/// The target that the page is compiled for.
pub const WASM: &str = "wasm32-unknown-unknown";

/// The Cargo that started this tool.
pub fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Where Cargo puts what it compiles.
pub fn target_folder() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| PathBuf::from("target"), PathBuf::from)
}

/// Where Cargo keeps the sources of libraries.
pub fn cargo_home() -> Option<PathBuf> {
    match std::env::var_os("CARGO_HOME") {
        Some(home) => Some(PathBuf::from(home)),
        None => Some(std::env::home_dir()?.join(".cargo")),
    }
}

/// Where the compiler is installed.
pub fn sysroot() -> Option<PathBuf> {
    let printed = steps::output(rustc().args(["--print", "sysroot"])).ok()?;
    Some(PathBuf::from(printed.trim()))
}

fn rustc() -> Command {
    Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
}

/// Sees to it that the compiler can compile for `WASM`. Asks the compiler and not rustup: a
/// compiler from elsewhere may bring the target, too.
pub fn wasm_target() -> Result {
    let mut question = rustc();
    question.args(["--print", "target-libdir", "--target", WASM]);
    let folder = steps::output(&mut question)?;
    if std::path::Path::new(folder.trim()).exists() {
        return Ok(());
    }
    println!("Adding the target {WASM} to the compiler.");
    steps::run(Command::new("rustup").args(["target", "add", WASM])).map_err(|error| {
        format!(
            "{error}\nThe page needs the compiler's target {WASM}. With rustup that is \
             `rustup target add {WASM}`; with a compiler from elsewhere, look for its package \
             of that name."
        )
    })
}

/// Sees to it that `cargo fmt` and `cargo clippy` are there.
pub fn component(name: &str) -> Result {
    // `clippy` is started as `cargo clippy`, `rustfmt` as `cargo fmt`.
    let command = name.trim_start_matches("rust");
    let there = cargo().args([command, "--version"]).output().is_ok_and(|output| output.status.success());
    if there {
        return Ok(());
    }
    println!("Adding {name} to the compiler.");
    steps::run(Command::new("rustup").args(["component", "add", name])).map_err(|error| {
        format!(
            "{error}\nThe checks need {name}. With rustup that is `rustup component add {name}`; \
             with a compiler from elsewhere, look for its package of that name."
        )
    })
}

/// A program of this name and version from the registry of Rust, compiled where it is missing, which takes
/// minutes. It stays inside Cargo's target folder.
pub fn installed(name: &str, version: &str) -> Result<PathBuf> {
    let folder = target_folder().join("tools");
    let program = folder.join("bin").join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    // Cargo notes what it installed.
    let noted = format!("\"{name} {version} (");
    let there = || {
        let notes = std::fs::read_to_string(folder.join(".crates.toml"));
        program.is_file() && notes.is_ok_and(|notes| notes.contains(&noted))
    };
    if !there() {
        println!("Compiling {name} {version}; this happens once and takes minutes.");
        let wanted = format!("{name}@{version}");
        let mut install = cargo();
        install.args(["install", "--quiet", "--locked", "--root"]).arg(&folder).arg(wanted);
        steps::run(&mut install)?;
    }
    if there() {
        std::path::absolute(&program).map_err(|error| format!("{}: {error}.", program.display()))
    } else {
        Err(format!("{} is not of version {version}.", program.display()))
    }
}

/// What draws the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    Chromium,
    Firefox,
    Webkit,
}

impl Engine {
    pub const ALL: [Self; 3] = [Self::Chromium, Self::Firefox, Self::Webkit];

    pub const fn key(self) -> &'static str {
        match self {
            Self::Chromium => "chromium",
            Self::Firefox => "firefox",
            Self::Webkit => "webkit",
        }
    }

    pub const fn label(self) -> &'static str {
        match self {
            Self::Chromium => "Chromium",
            Self::Firefox => "Firefox",
            Self::Webkit => "WebKit",
        }
    }
}

/// A browser and the program that drives it.
pub struct Browser {
    pub program: PathBuf,
    pub driver: PathBuf,
    /// A screen for it, where it needs one.
    pub screen: Option<PathBuf>,
}

/// Finds a browser and its driver, and installs them where they are missing.
pub fn browser(engine: Engine) -> Result<Browser> {
    match engine {
        Engine::Chromium => chromium(),
        Engine::Firefox => firefox(),
        Engine::Webkit => webkit(),
    }
}

/// Chromium or Chrome.
fn chromium() -> Result<Browser> {
    let find = || Some(Browser { program: find_chromium()?, driver: find_driver()?, screen: None });
    if let Some(browser) = find() {
        return Ok(browser);
    }
    let tried = install(
        "Chromium and its driver",
        &[
            // Without a font the page has no letters, and a text no width.
            ("apt-get", &["chromium", "chromium-driver", "fonts-dejavu-core"]),
            ("dnf", &["chromium", "chromedriver", "dejavu-sans-fonts"]),
            ("pacman", &["chromium", "ttf-dejavu"]),
        ],
    );
    find().ok_or_else(|| {
        format!(
            "{tried}The page tests need Chromium or Chrome, and chromedriver of the same version. \
             Install both, on the PATH or named by the variables BUSLENS_CHROMIUM and \
             BUSLENS_CHROMEDRIVER, then start this again."
        )
    })
}

/// Firefox. Its driver is a program from the registry of Rust where the system has none.
fn firefox() -> Result<Browser> {
    const GECKODRIVER: &str = "0.37.1";
    let find = || on_path(&["firefox-esr", "firefox"]);
    let mut tried = String::new();
    if find().is_none() {
        tried = install(
            "Firefox",
            &[("apt-get", &["firefox-esr"]), ("dnf", &["firefox"]), ("pacman", &["firefox"])],
        );
    }
    let program = find().ok_or_else(|| {
        format!("{tried}The page tests with `--browsers` need Firefox on the PATH: install it, then start this again.")
    })?;
    let driver = match on_path(&["geckodriver"]) {
        Some(driver) => driver,
        None => installed("geckodriver", GECKODRIVER)?,
    };
    Ok(Browser { program, driver, screen: None })
}

/// WebKit as GTK has it, in the browser that comes with it for tests.
fn webkit() -> Result<Browser> {
    let mini_browser = || {
        let folders = ["/usr/lib", "/usr/libexec", "/usr/lib64"].into_iter().flat_map(|folder| {
            let inner = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
            std::iter::once(PathBuf::from(folder)).chain(inner)
        });
        let mut files = folders.flat_map(|folder| {
            ["webkit2gtk-4.1", "webkitgtk-6.0"].map(|name| folder.join(name).join("MiniBrowser"))
        });
        files.find(|file| file.is_file())
    };
    let find = || {
        let (driver, screen) = (on_path(&["WebKitWebDriver"])?, on_path(&["Xvfb"])?);
        Some(Browser { program: mini_browser()?, driver, screen: Some(screen) })
    };
    if let Some(browser) = find() {
        return Ok(browser);
    }
    let tried = install(
        "WebKit, its driver and a screen for it",
        &[("apt-get", &["webkit2gtk-driver", "libwebkit2gtk-4.1-0", "xvfb"])],
    );
    find().ok_or_else(|| {
        format!(
            "{tried}The page tests in WebKit need WebKitWebDriver and Xvfb on the PATH, and WebKitGTK's \
             MiniBrowser: Debian has them in webkit2gtk-driver, xvfb and libwebkit2gtk-4.1-0."
        )
    })
}

fn find_chromium() -> Option<PathBuf> {
    named("BUSLENS_CHROMIUM")
        .or_else(|| {
            on_path(&["chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"])
        })
        .or_else(|| {
            let mut usual = vec![
                PathBuf::from("/Applications/Google Chrome.app/Contents/MacOS/Google Chrome"),
                PathBuf::from("/Applications/Chromium.app/Contents/MacOS/Chromium"),
            ];
            for folder in ["ProgramFiles", "ProgramFiles(x86)", "LocalAppData"] {
                let folder = std::env::var_os(folder).map(PathBuf::from);
                usual.extend(folder.map(|folder| folder.join(r"Google\Chrome\Application\chrome.exe")));
            }
            usual.into_iter().find(|path| path.is_file())
        })
}

fn find_driver() -> Option<PathBuf> {
    named("BUSLENS_CHROMEDRIVER").or_else(|| on_path(&["chromedriver"]))
}

/// The path in an environment variable.
fn named(variable: &str) -> Option<PathBuf> {
    std::env::var_os(variable).map(PathBuf::from)
}

/// The first of the programs that a folder of the PATH holds.
fn on_path(programs: &[&str]) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
    // npm is a batch file on Windows.
    let extensions: &[&str] = if cfg!(windows) { &[".exe", ".cmd"] } else { &[""] };
    let mut files = programs.iter().flat_map(|program| {
        folders.iter().flat_map(move |folder| {
            extensions.iter().map(move |extension| folder.join(format!("{program}{extension}")))
        })
    });
    files.find(|file| file.is_file())
}

/// Installs packages with the first of the package managers that this system has. Says what went
/// wrong, in a sentence before the one that asks a person to do it; nothing went wrong is "".
fn install(what: &str, managers: &[(&str, &[&str])]) -> String {
    let Some((manager, packages)) = managers.iter().find(|(manager, _)| on_path(&[manager]).is_some()) else {
        return String::new();
    };
    let Some(rights) = rights() else {
        return format!("{what} could not be installed: {manager} asks for root. ");
    };
    println!("Installing {what} with {manager}: {}.", packages.join(", "));
    let start = || {
        let mut command = match rights {
            Rights::Root => Command::new(manager),
            Rights::Sudo => {
                let mut command = Command::new("sudo");
                command.args(["-n", manager]);
                command
            }
        };
        // It may ask nothing: nobody might be there to answer.
        command.env("DEBIAN_FRONTEND", "noninteractive").stdin(std::process::Stdio::null());
        command
    };
    let result = match *manager {
        "apt-get" => steps::run_quietly(start().args(["update", "-qq"])).and_then(|()| {
            steps::run_quietly(
                start().args(["install", "-y", "-qq", "--no-install-recommends"]).args(*packages),
            )
        }),
        "pacman" => steps::run_quietly(start().args(["-S", "--noconfirm", "--needed"]).args(*packages)),
        _ => steps::run_quietly(start().args(["install", "-y"]).args(*packages)),
    };
    match result {
        Ok(()) => String::new(),
        Err(sentence) => format!("{sentence} "),
    }
}

/// How a package manager may be started.
enum Rights {
    Root,
    Sudo,
}

fn rights() -> Option<Rights> {
    let user = Command::new("id").arg("-u").output().ok()?;
    if user.stdout.trim_ascii() == b"0" {
        return Some(Rights::Root);
    }
    // `-n`: without asking for a password.
    let sudo = Command::new("sudo").args(["-n", "true"]).output().ok()?;
    sudo.status.success().then_some(Rights::Sudo)
}

/// The version of axe-core that the page is held against.
const AXE_VERSION: &str = "4.14.1";

/// Finds axe-core, the checker of accessibility, and fetches it with npm where it is missing.
/// It stays inside Cargo's target folder.
pub fn axe() -> Result<PathBuf> {
    let folder = target_folder().join("page-tests");
    let package = folder.join("node_modules").join("axe-core");
    let script = package.join("axe.min.js");
    let version = format!("\"version\": \"{AXE_VERSION}\"");
    let there = || {
        let description = std::fs::read_to_string(package.join("package.json"));
        description.is_ok_and(|text| text.contains(&version)) && script.is_file()
    };
    if !there() {
        let mut tried = String::new();
        if on_path(&["npm"]).is_none() {
            let packages: &[&str] = &["nodejs", "npm"];
            tried = install("npm", &[("apt-get", packages), ("dnf", packages), ("pacman", packages)]);
        }
        let npm = on_path(&["npm"]).ok_or_else(|| {
            format!("{tried}The page tests fetch axe-core with npm: install Node.js with npm, then start this again.")
        })?;
        println!("Fetching axe-core {AXE_VERSION} with npm.");
        std::fs::create_dir_all(&folder)
            .map_err(|error| format!("{} cannot be made: {error}.", folder.display()))?;
        steps::run(
            Command::new(npm)
                .arg("install")
                .arg("--prefix")
                .arg(&folder)
                .args(["--no-save", "--ignore-scripts", "--no-audit", "--no-fund"])
                .arg(format!("axe-core@{AXE_VERSION}")),
        )?;
    }
    if there() {
        std::path::absolute(&script).map_err(|error| format!("{}: {error}.", script.display()))
    } else {
        Err(format!("npm ran, but {} is not of version {AXE_VERSION}.", script.display()))
    }
}
