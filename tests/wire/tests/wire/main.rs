//! Tests of drivers and public clients with emulated devices, and of the program that serves these devices.

mod clients;
#[cfg(target_os = "linux")]
mod kernel;
mod mjpeg;
mod program;
mod waiting;
