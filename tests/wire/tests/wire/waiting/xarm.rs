//! Tests of `ufactory/xarm` with the emulated control box.

mod contract;
mod expiring;
mod faults;
mod late;
mod setup;
