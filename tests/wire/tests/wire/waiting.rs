//! Tests of every driver of a robot or a force transducer with its emulated device, over sockets or a pseudo-terminal.

mod answers;
mod expiring;
mod gate;
#[cfg(unix)]
mod gcode;
#[cfg(unix)]
mod grbl;
mod links;
#[cfg(unix)]
mod marlin;
mod netft;
mod setup;
mod sri;
mod support;
mod ur;
mod xarm;
