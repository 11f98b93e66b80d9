//! Tests with programs of other authors. They show that an emulator and a driver of this project do not share an error.

mod ffmpeg;
#[cfg(unix)]
mod grbl;
#[cfg(unix)]
mod marlin;
mod mjpeg;
mod netft;
mod printer;
mod python;
mod ur;
mod xarm;

use std::net::Ipv4Addr;

/// A loopback address that no other test uses at the same time, because each client uses one fixed port.
pub(crate) fn address(last: u8) -> Ipv4Addr {
    let [.., high, low] = std::process::id().to_be_bytes();
    Ipv4Addr::new(127, high.max(1), low, last)
}
