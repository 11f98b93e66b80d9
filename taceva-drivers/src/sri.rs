//! Drivers for force transducers of Sunrise Instruments (SRI).

pub mod m8128;
