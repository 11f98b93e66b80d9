//! The program `taceva`.

use std::process::ExitCode;

fn main() -> ExitCode {
    // This call comes first, because the program also runs itself as the process of a plugin.
    taceva_cli::main_if_child();
    ExitCode::from(taceva_cli::main_with(std::env::args_os()))
}
