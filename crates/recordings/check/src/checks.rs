//! Every check: one file each, a pure function of the [`Evidence`](crate::Evidence) with a stable code.

pub(crate) mod blank;
mod channel_order;
mod clipped_taxel;
mod clock_jumps;
mod clusters;
pub(crate) mod damaged_frames;
mod dead_zone;
mod doubled_frames;
mod dropped_frames;
mod duplicate_frames;
mod label_lag;
mod label_outliers;
pub(crate) mod leakage;
mod lossy_frames;
mod lost_frames;
mod missing_labels;
mod omissions;
mod placeholder;
mod pressed_reference;
mod pressed_rest;
mod saturation;
mod sensor_facts;
mod stuck_channel;
mod stuck_taxel;
mod timing;
mod units;
mod unmentioned_columns;

use crate::finding::Check;

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
    &sensor_facts::CHECK,
    &damaged_frames::CHECK,
    &label_outliers::CHECK,
    &unmentioned_columns::CHECK,
    &lost_frames::CHECK,
    &stuck_taxel::CHECK,
    &clipped_taxel::CHECK,
    &pressed_rest::CHECK,
    &label_lag::CHECK,
    &omissions::CHECK,
    &doubled_frames::CHECK,
    &dropped_frames::CHECK,
    &clock_jumps::CHECK,
    &blank::CHECK,
    &lossy_frames::CHECK,
    &dead_zone::CHECK,
];
