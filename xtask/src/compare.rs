//! `cargo xtask compare`: Buslens beside other programs that read Modbus, on the same data (`compare/`).

use std::path::Path;
use std::process::Command;

use crate::steps::{self, Result};
use crate::{page_tests, size, tools};

/// What is compared with that has no crate: by the installer of its language, with what names the folder for it.
const PACKAGES: [(&str, &[&str], &str, &[&str]); 2] = [
    ("pip", &["install", "--quiet", "--target"], "python", &["pymodbus", "scapy"]),
    ("npm", &["install", "--silent", "--no-fund", "--no-audit", "--prefix"], "node", &["jsmodbus"]),
];

/// Prints the table, and what the page weighs and takes, if there is one.
pub fn run() -> Result {
    let folder = tools::target_folder().join("compare");
    for (installer, arguments, language, packages) in PACKAGES {
        let into = folder.join(language);
        if into.exists() {
            continue;
        }
        println!("Installing {} by {installer}.", packages.join(" and "));
        let installed = steps::run_quietly(Command::new(installer).args(arguments).arg(&into).args(packages));
        if let Err(why) = installed {
            println!("{} are left out: {why}", packages.join(" and "));
        }
    }
    println!("modbus-serial is left out: it is a client, and takes no bytes that it did not ask for.");
    let compare = ["run", "--quiet", "--profile", "bench", "--package", "compare", "--"];
    steps::run(tools::cargo().args(compare).arg(&folder))?;
    let page = Path::new("dist");
    if !page.join("index.html").exists() {
        println!("\nWhat the page weighs is printed once it is built: `cargo xtask build`.");
        return Ok(());
    }
    println!();
    size::check(page)?;
    page_tests::run(&["the_first_telegram_is_read_within_a_second"])
}
