//! The program `taceva`.

use std::process::ExitCode;

fn main() -> ExitCode {
    // Before anything else: the program runs itself again to keep a plugin in a process of its own.
    taceva_cli::main_if_child();
    ExitCode::from(taceva_cli::main_with(std::env::args_os()))
}
