//! Rust drivers behind the C tables, as a host calls them. Their guarantees hold, and no mistake on either side ends the program.

mod drivers;
mod estimators;
mod fake_host;
mod mistakes;
mod motions;
mod places;
mod promises;
