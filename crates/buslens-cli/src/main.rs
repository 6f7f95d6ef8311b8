//! The command `buslens`: what the library does, for shells and scripts.

mod decode;

use std::io::Write;
use std::process::ExitCode;

use clap::Command;

fn main() -> ExitCode {
    // Usage errors end here, with exit code 2.
    let matches = command().get_matches();
    let done = match matches.subcommand() {
        Some((decode::NAME, matches)) => decode::run(matches),
        _ => unreachable!("clap takes no other subcommand"),
    };
    match done {
        Ok(text) => {
            // A closed pipe, as of `buslens decode … | head`, is the reader's choice.
            let _ = std::io::stdout().write_all(text.as_bytes());
            ExitCode::SUCCESS
        }
        Err(reason) => {
            eprintln!("buslens: {reason}");
            ExitCode::FAILURE
        }
    }
}

fn command() -> Command {
    Command::new("buslens")
        .about("Reads field-bus telegrams: Modbus and PROFIBUS-DP, byte by byte, in the words of the devices' manuals.")
        .after_help("Exit codes: 0 done, 1 the input cannot be read, 2 the command is not understood.")
        .subcommand_required(true)
        .arg_required_else_help(true)
        .subcommand(decode::command())
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_command_is_well_formed() {
        super::command().debug_assert();
    }
}
