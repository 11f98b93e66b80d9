#![doc = include_str!("../README.md")]

mod canvas;
mod cells;
mod difference;
mod estimate;
mod example;
mod fault;
mod faults;
mod findings;
mod foreign;
mod label_scores;
mod labels;
mod list;
mod looks;
mod monitor;
mod notes;
mod others;
mod pass;
mod ratio;
mod relative;
mod report;
mod samples;
mod scale;
mod score;
mod setup;
mod severity;
mod stages;
mod stress;
mod study;
mod taxel_scale;
mod taxel_scores;
mod taxels;
mod time_scores;
mod times;
mod wear;
mod worn;

pub use difference::ErrorDifference;
pub use estimate::{Estimate, Undefined};
pub use example::Examples;
pub use fault::{Fault, Scope};
pub use faults::{
    FAULTS, GEL_FAULTS, LIST, RECORDING_FAULTS, RECORDING_LIST, TAXEL_FAULTS, TAXEL_LIST,
    TIME_FAULTS, TIME_LIST, select,
};
pub use foreign::PictureFault;
pub use monitor::{Alarm, Change, Monitor, watch};
pub use others::OtherFaults;
pub use relative::add_reference;
pub use report::{
    ByChannel, CellScore, CleanScore, FaultList, FaultReport, STRESS_SCHEMA, SeverityReport,
    SkippedFault, StressReport, TimeScore, Unnoticed,
};
pub use setup::{StressRequest, stress_plan, usual_list};
pub use severity::{By, NEVER, TARGETS, Unreached, severities};
pub use stress::Stress;
pub use study::{stress, stress_beside, stress_unseen};
pub use wear::{
    ChannelWear, GelWear, LimitMet, RecordingWear, WEAR_SCHEMA, WearBy, WearReport, WearRequest,
    wear,
};
pub use worn::{WornFault, WornGel};
