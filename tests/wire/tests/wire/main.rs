//! Drivers and public clients against emulated devices, and the program that serves them.

mod clients;
#[cfg(target_os = "linux")]
mod kernel;
mod mjpeg;
mod program;
mod waiting;
