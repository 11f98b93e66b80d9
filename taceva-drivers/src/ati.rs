//! Force transducers of ATI Industrial Automation.

pub mod netft;
