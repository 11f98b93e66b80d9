//! The drivers as a program meets them: by name, with arguments, and going wrong.

mod conformance;
mod doctor;
mod fault;
mod replay;
mod support;
mod toy;
