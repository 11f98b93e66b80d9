//! All checks, one per file. Each check has a stable code and is a pure function of the [`Evidence`](crate::Evidence).

mod angle_jumps;
pub(crate) mod blank;
mod byte_counts;
mod certificates;
mod certified_range;
mod changed_rest;
mod channel_order;
mod clipped_taxel;
mod clock_jumps;
mod clusters;
mod contradictory_labels;
pub(crate) mod damaged_frames;
mod dead_zone;
pub(crate) mod depth_maps;
mod doubled_frames;
mod dropped_frames;
pub(crate) mod duplicate_frames;
mod equal_channels;
mod equal_taxels;
mod equal_views;
mod implausible_depth;
mod import_warnings;
mod label_lag;
mod label_outliers;
pub(crate) mod leakage;
mod lossy_frames;
mod lost_frames;
mod missing_labels;
mod normalised_labels;
mod omissions;
mod placeholder;
mod pressed_reference;
mod pressed_rest;
mod quaternion_norms;
mod repeated_stamps;
mod saturation;
mod sensor_facts;
mod slow_labels;
mod stuck_channel;
mod stuck_taxel;
mod timing;
mod units;
mod unmentioned_columns;
pub(crate) mod unseen_classes;
mod zero_shift;

use crate::finding::Check;

/// Checks that read only labels and statistics of whole pictures, not of tiles.
pub(crate) static OF_PICTURES: [&Check; 5] = [
    &channel_order::CHECK,
    &saturation::CHECK,
    &pressed_reference::CHECK,
    &blank::CHECK,
    &dead_zone::CHECK,
];

/// Checks that need the statistics of taxels alone.
pub(crate) static OF_SIGNALS: [&Check; 3] = [
    &stuck_taxel::CHECK,
    &clipped_taxel::CHECK,
    &equal_taxels::CHECK,
];

/// All checks, in the order of their codes.
pub static ALL: [&Check; 45] = [
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
    &certificates::CHECK,
    &certified_range::CHECK,
    &unseen_classes::CHECK,
    &contradictory_labels::CHECK,
    &quaternion_norms::CHECK,
    &depth_maps::CHECK,
    &changed_rest::CHECK,
    &zero_shift::CHECK,
    &repeated_stamps::CHECK,
    &slow_labels::CHECK,
    &equal_channels::CHECK,
    &equal_taxels::CHECK,
    &normalised_labels::CHECK,
    &implausible_depth::CHECK,
    &angle_jumps::CHECK,
    &import_warnings::CHECK,
    &equal_views::CHECK,
    &byte_counts::CHECK,
];
