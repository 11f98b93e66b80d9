//! Force transducers of ATI Industrial Automation.

mod netft;

pub use netft::NetftFactory;
