//! Imperfect devices around the sensor: robot, force transducer, and search for contact.

mod label;
mod search;
mod transducer;

pub use label::Label;
pub use search::Touch;

pub(crate) use search::search;
pub(crate) use transducer::TransducerModel;
