//! What stands around the sensor and is not perfect: a robot, a force transducer, and the search for contact.

mod label;
mod search;
mod transducer;

pub use label::Label;
pub use search::Touch;

pub(crate) use search::search;
pub(crate) use transducer::TransducerModel;
