//! `buslens decode` by itself, as scripts know it from the time when it was an example of the library.

#[path = "../src/decode.rs"]
mod decode;

use std::io::Write;
use std::process::ExitCode;

fn main() -> ExitCode {
    match decode::run(&decode::command().get_matches()) {
        Ok(text) => {
            let _ = std::io::stdout().write_all(text.as_bytes());
            ExitCode::SUCCESS
        }
        Err(reason) => {
            eprintln!("decode: {reason}");
            ExitCode::FAILURE
        }
    }
}
