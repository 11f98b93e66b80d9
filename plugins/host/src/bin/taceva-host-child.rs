//! Child process that runs a plugin, for host programs whose own `main` cannot begin with [`main_if_child`](taceva_host::main_if_child).
//! They name this program instead.

use std::process::ExitCode;

#[expect(clippy::print_stderr, reason = "a program says why it does nothing")]
fn main() -> ExitCode {
    #[cfg(target_os = "linux")]
    taceva_host::main_if_child();
    eprintln!(
        "taceva-host-child is started by a program that hosts plugins, and does nothing by itself"
    );
    ExitCode::from(64)
}
