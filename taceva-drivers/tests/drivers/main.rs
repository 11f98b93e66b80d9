//! The drivers as a program meets them: by name, with arguments, and going wrong.

mod conformance;
mod devices;
mod doctor;
mod fault;
mod replay;
mod replay_refusals;
mod support;
mod toy;
