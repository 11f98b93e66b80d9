#![doc = include_str!("../README.md")]

mod changed_pictures;
mod check;
mod checks;
mod count;
mod depth_facts;
mod evidence;
mod finding;
mod rest_change;
mod run;
mod signal_facts;
mod stamps;
mod tiles;
mod untouched;
mod views;

pub use changed_pictures::{codes_of_pictures, codes_of_signals};
pub use check::check;
pub use checks::ALL;
pub use depth_facts::{DepthFacts, OneMap};
pub use evidence::{Evidence, FrameFacts};
pub use finding::{Check, CheckReport, Finding, Severity};
pub use rest_change::RestChange;
pub use run::{CheckRequest, check_plan};
pub use signal_facts::{SignalFacts, TaxelFacts, ValueCount};
pub use tiles::Tiles;
