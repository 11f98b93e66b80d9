//! Tests that mostly wait for emulated devices in real time. `.ci/test` runs them at the same time as tests that need the processor.

mod rig_session;
mod rig_tap;
mod wire_box;
#[cfg(target_os = "linux")]
mod wire_disk_full;
mod wire_study;
