//! Tests that recordings are written, survive damage and interruption, and are read back.

mod joined;
mod presses;
mod recording;
mod signals;
mod streams;
mod support;
mod traced;
