//! Drivers in Rust behind the C tables, as a host meets them: what they promise holds, and no mistake on either side ends the program.

#[path = "boundary/drivers.rs"]
mod drivers;
#[path = "boundary/estimators.rs"]
mod estimators;
#[path = "boundary/fake_host.rs"]
mod fake_host;
#[path = "boundary/mistakes.rs"]
mod mistakes;
#[path = "boundary/promises.rs"]
mod promises;
