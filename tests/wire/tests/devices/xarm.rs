//! `ufactory/xarm` against the emulated control box.

mod contract;
mod faults;
mod setup;
