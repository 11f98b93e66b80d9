//! Drivers in Rust behind the C tables, as a host meets them: what they promise holds, and no mistake on either side ends the program.

mod drivers;
mod estimators;
mod fake_host;
mod mistakes;
mod motions;
mod places;
mod promises;
