//! The simulated bench: its model, pictures and devices, and whole studies on it.

mod bench;
mod conformance;
mod devices;
mod figures;
mod gel_faults;
mod parameters;
mod pictures;
mod run;
mod trial;
mod verification;
mod wall;
