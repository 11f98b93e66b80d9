//! Force transducers of Sunrise Instruments (SRI).

mod m8128;

pub use m8128::M8128Factory;
