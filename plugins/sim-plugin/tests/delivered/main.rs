//! Plugins as delivered: built libraries with their manifests, in this process and in child processes.
//!
//! This program is its own host child, so its `main` begins like that of every host.

#[cfg(target_os = "linux")]
mod built;
#[cfg(target_os = "linux")]
mod check;
mod manifest;
#[cfg(target_os = "linux")]
#[path = "../../../host/tests/support/runner.rs"]
mod runner;
#[cfg(target_os = "linux")]
mod side_by_side;

#[cfg(target_os = "linux")]
fn main() -> std::process::ExitCode {
    taceva_conformance::main_if_child();
    runner::run(&[
        (
            "the_manifest_says_what_the_drivers_say_of_themselves",
            manifest::the_manifest_says_what_the_drivers_say_of_themselves,
        ),
        (
            "every_device_of_the_bench_passes_every_check_of_plugins",
            check::every_device_of_the_bench_passes_every_check_of_plugins,
        ),
        (
            "one_of_each_kind_in_c_passes_every_check_of_plugins",
            check::one_of_each_kind_in_c_passes_every_check_of_plugins,
        ),
        (
            "plugins_of_different_languages_and_flags_keep_their_contracts_in_one_process",
            side_by_side::plugins_of_different_languages_and_flags_keep_their_contracts_in_one_process,
        ),
        (
            "c_and_rust_plugins_of_four_builds_give_right_frames_and_wrenches_while_all_are_open",
            side_by_side::c_and_rust_plugins_of_four_builds_give_right_frames_and_wrenches_while_all_are_open,
        ),
    ])
}

#[cfg(not(target_os = "linux"))]
fn main() {
    manifest::the_manifest_says_what_the_drivers_say_of_themselves();
}
