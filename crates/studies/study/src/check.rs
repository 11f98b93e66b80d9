//! Looks for what spoils a recording, before any number is computed from it.
//!
//! One file a check under `check/`; each is a pure function of the [`Evidence`] and has a stable code.

mod blank;
mod channel_order;
mod clipped_taxel;
mod clock_jumps;
mod clusters;
mod damaged_frames;
mod dead_zone;
mod doubled_frames;
mod dropped_frames;
mod duplicate_frames;
mod evidence;
mod facts;
mod finding;
mod label_lag;
mod label_outliers;
mod leakage;
mod left_out;
mod lossy_frames;
mod lost_frames;
mod missing_labels;
mod placeholder;
mod pressed_reference;
mod pressed_rest;
mod run;
mod saturation;
mod signal_facts;
mod stream;
mod stuck_channel;
mod stuck_taxel;
mod timing;
mod units;
mod unmentioned_columns;

pub use evidence::{Evidence, FrameFacts};
pub use finding::{Check, CheckReport, Finding, Severity};
pub use run::{CheckRequest, check, check_plan};
pub use signal_facts::{SignalFacts, TaxelFacts};

/// Every check, in the order of its code.
pub static ALL: [&Check; 27] = [
    &units::CHECK,
    &duplicate_frames::CHECK,
    &channel_order::CHECK,
    &saturation::CHECK,
    &placeholder::CHECK,
    &pressed_reference::CHECK,
    &leakage::CHECK,
    &timing::CHECK,
    &stuck_channel::CHECK,
    &clusters::CHECK,
    &missing_labels::CHECK,
    &facts::CHECK,
    &damaged_frames::CHECK,
    &label_outliers::CHECK,
    &unmentioned_columns::CHECK,
    &lost_frames::CHECK,
    &stuck_taxel::CHECK,
    &clipped_taxel::CHECK,
    &pressed_rest::CHECK,
    &label_lag::CHECK,
    &left_out::CHECK,
    &doubled_frames::CHECK,
    &dropped_frames::CHECK,
    &clock_jumps::CHECK,
    &blank::CHECK,
    &lossy_frames::CHECK,
    &dead_zone::CHECK,
];
