//! Drivers as a program uses them: by name, with arguments, and with failures.

mod conformance;
mod devices;
mod doctor;
mod fault;
mod replay;
mod replay_refusals;
mod support;
mod toy;
