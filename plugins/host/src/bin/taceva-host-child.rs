//! Child process that runs a plugin. Host programs start it if their own `main` cannot begin with [`main_if_child`](taceva_host::main_if_child).

use std::process::ExitCode;

#[expect(clippy::print_stderr, reason = "a program says why it does nothing")]
fn main() -> ExitCode {
    #[cfg(target_os = "linux")]
    taceva_host::main_if_child();
    eprintln!("taceva-host-child is started by programs that host plugins; do not run it directly");
    ExitCode::from(64)
}
