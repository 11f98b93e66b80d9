//! Tests of checks of plugins. Children of this program run the checks, so `main` begins like the `main` of every host.

#[cfg(target_os = "linux")]
#[path = "../../../host/tests/plugins/fixture.rs"]
#[expect(
    dead_code,
    reason = "shared with the tests of the host, which use all of it"
)]
mod fixture;
#[cfg(target_os = "linux")]
mod plugin;
#[cfg(target_os = "linux")]
#[path = "../../../host/tests/support/runner.rs"]
mod runner;

#[cfg(target_os = "linux")]
fn main() -> std::process::ExitCode {
    taceva_conformance::main_if_child();
    runner::run(plugin::TESTS)
}

#[cfg(not(target_os = "linux"))]
fn main() {}
