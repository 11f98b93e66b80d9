//! Acceptance tests: check results against limits.

mod check;
mod interval;
mod limits_file;
mod process;
mod reason;
mod sheet;
mod subject;
mod template;

pub use check::{AcceptError, LimitCheck, accept};
pub use limits_file::{Limit, LimitsError, LimitsFile};
pub use process::{ProcessRisk, add_process_risks};
pub use sheet::{ACCEPTANCE_SCHEMA, Acceptance};
pub use template::limits_template;

#[cfg(test)]
mod tests;
