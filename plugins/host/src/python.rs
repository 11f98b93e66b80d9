//! Python plugins: interpreters, queries of their environments, and plugin processes.

mod digest;
mod error;
mod interpreter;
mod open_to;
mod own_interpreter;
mod run;

pub(crate) use self::digest::digest;
pub use self::error::PythonError;
pub(crate) use self::error::other_wire;
pub use self::interpreter::Interpreter;
pub(crate) use self::interpreter::Lying;
#[cfg(target_os = "linux")]
pub(crate) use self::open_to::closed_by;
pub(crate) use self::own_interpreter::{arguments, own};
pub use self::own_interpreter::{beside_this_program, run_within};
