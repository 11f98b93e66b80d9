//! `ufactory/xarm` against the emulated control box, through sockets.

mod contract;
mod faults;
mod support;
