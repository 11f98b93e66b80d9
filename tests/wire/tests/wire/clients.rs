//! Programs of others on the other end of our sockets: they show that our two ends are not wrong in the same way.

mod ffmpeg;
mod netft;
mod printer;
mod python;
mod ur;
mod xarm;

use std::net::Ipv4Addr;

/// An address of loopback that no other test uses at the same time: clients know one port each.
pub(crate) fn address(last: u8) -> Ipv4Addr {
    let [.., high, low] = std::process::id().to_be_bytes();
    Ipv4Addr::new(127, high.max(1), low, last)
}
