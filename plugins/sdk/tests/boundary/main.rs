//! Tests of Rust drivers behind C tables, called like by a host. Drivers keep their guarantees, and no mistake of either side ends the program.

mod drivers;
mod estimators;
mod fake_host;
mod mistakes;
mod motions;
mod places;
mod promises;
