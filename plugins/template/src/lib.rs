#![doc = include_str!("../README.md")]

mod kind;
mod name;
mod project;
mod python;

pub use kind::Kind;
pub use name::{Name, NameError};
pub use project::{File, Sources, headers, project};
pub use python::{python_project, torch_project};
