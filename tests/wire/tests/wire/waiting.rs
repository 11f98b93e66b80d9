//! Every driver of a robot and of a force transducer with its emulated device, through sockets and a pseudo-terminal.

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
