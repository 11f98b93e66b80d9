//! The program `taceva`.

use std::process::ExitCode;

fn main() -> ExitCode {
    // First of all: the program runs itself again as the process of a plugin.
    taceva_cli::main_if_child();
    ExitCode::from(taceva_cli::main_with(std::env::args_os()))
}
