//! Tests of faults of pictures, their severities, and the scores of models on pictures with faults.

mod bad_input;
mod bench_checks;
mod bench_monitor;
mod drawing;
mod foreign;
mod golden;
mod leds;
mod looks;
#[cfg(target_os = "linux")]
mod memory;
mod monitor;
mod pictures;
mod recording_faults;
mod relative;
mod scores;
mod severities;
mod stages;
mod taxel_drawing;
mod taxel_recordings;
mod taxels;
mod wear;
