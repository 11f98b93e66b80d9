//! Lists of the faults, and selection of faults for a test.

mod cable_noise;
mod camera_shift;
mod dead_pixels;
mod defocus;
mod dropped_frames;
mod dust;
mod exposure_drift;
mod exposure_high;
mod exposure_low;
mod force_noise;
mod jpeg;
mod label_lag;
mod led_loss;
mod marker_loss;
mod scratches;
mod sensor_noise;
mod stale_frames;
mod taxel_dead;
mod taxel_drift;
mod taxel_gain;
mod tear;

use taceva_core::{shown, suggestion};
use taceva_evaluate::EvaluateError;

use crate::fault::Fault;

pub(crate) use led_loss::note_on;

/// Name of the list of faults of pictures.
pub const LIST: &str = "gel-12";
/// Name of the list of faults of camera files, markers, clocks and labels.
pub const RECORDING_LIST: &str = "recording-5";
/// Name of the list of faults of taxels.
pub const TAXEL_LIST: &str = "taxel-3";
/// Name of the list of faults of times.
pub const TIME_LIST: &str = "time-1";
/// Another name of the list of faults of pictures.
const ALL: &str = "all";
/// Names of the faults of a gel. Such a fault changes force and picture together, so changed pictures alone cannot simulate it.
pub const GEL_FAULTS: [&str; 10] = [
    "gel_softening",
    "gel_hardening",
    "temperature",
    "friction",
    "gel_shift",
    "thickness",
    "coating_gloss",
    "gel_scratches",
    "gel_tear",
    "gel_dust",
];
/// Version of all lists of faults. Scores by lists of different versions are not compared.
pub(crate) const LIST_VERSION: u32 = 1;

/// Faults of pictures, in the order of the list [`LIST`].
pub static FAULTS: [&Fault; 12] = [
    &defocus::FAULT,
    &dead_pixels::FAULT,
    &exposure_low::FAULT,
    &exposure_high::FAULT,
    &sensor_noise::FAULT,
    &cable_noise::FAULT,
    &camera_shift::FAULT,
    &led_loss::FAULT,
    &scratches::FAULT,
    &tear::FAULT,
    &dust::FAULT,
    &stale_frames::FAULT,
];

/// Faults of camera files, markers, clocks and labels, in the order of the list [`RECORDING_LIST`].
pub static RECORDING_FAULTS: [&Fault; 5] = [
    &jpeg::FAULT,
    &exposure_drift::FAULT,
    &marker_loss::FAULT,
    &label_lag::FAULT,
    &force_noise::FAULT,
];

/// Faults of taxels, in the order of the list [`TAXEL_LIST`].
pub static TAXEL_FAULTS: [&Fault; 3] =
    [&taxel_dead::FAULT, &taxel_gain::FAULT, &taxel_drift::FAULT];

/// Faults of times, in the order of the list [`TIME_LIST`].
pub static TIME_FAULTS: [&Fault; 1] = [&dropped_frames::FAULT];

/// List of faults with a name.
pub(crate) struct KnownList {
    pub(crate) name: &'static str,
    pub(crate) faults: &'static [&'static Fault],
}

/// All lists.
pub(crate) static LISTS: [KnownList; 4] = [
    KnownList {
        name: LIST,
        faults: &FAULTS,
    },
    KnownList {
        name: RECORDING_LIST,
        faults: &RECORDING_FAULTS,
    },
    KnownList {
        name: TAXEL_LIST,
        faults: &TAXEL_FAULTS,
    },
    KnownList {
        name: TIME_LIST,
        faults: &TIME_FAULTS,
    },
];

/// Faults with the given `names`, in the order of all lists. The name of a list selects its faults, and `all` those of [`LIST`]. Spaces are trimmed.
///
/// # Errors
/// [`EvaluateError::Request`] for an unknown name, or without a name.
pub fn select(names: &[String]) -> Result<Vec<&'static Fault>, EvaluateError> {
    let names: Vec<&str> = names.iter().map(|name| name.trim()).collect();
    let known = LISTS.iter().flat_map(|list| {
        let ids = list.faults.iter().map(|fault| fault.id);
        [list.name].into_iter().chain(ids)
    });
    let known: Vec<&str> = known.collect();
    let is_known = |name: &str| name == ALL || known.contains(&name);
    if let Some(gel) = names.iter().find(|name| GEL_FAULTS.contains(name)) {
        return Err(EvaluateError::Request(format!(
            "fault `{gel}`: only the simulated bench has this fault of the gel; write in a scene with a simulated sensor: stress = {{ faults = [\"{gel}\"] }}"
        )));
    }
    if let Some(unknown) = names.iter().find(|name| !is_known(name)) {
        return Err(EvaluateError::Request(format!(
            "fault `{}`: unknown, {}",
            shown(unknown),
            suggestion(unknown, &known)
        )));
    }
    let names = &names;
    let wanted = LISTS.iter().flat_map(|list| {
        let is_all = list.name == LIST && names.contains(&ALL);
        let is_whole = is_all || names.contains(&list.name);
        let faults = list.faults.iter().copied();
        faults.filter(move |fault| is_whole || names.contains(&fault.id))
    });
    let chosen: Vec<&'static Fault> = wanted.collect();
    match chosen.is_empty() {
        true => Err(EvaluateError::Request(format!(
            "no fault is named, expected {LIST} or some of `{}`",
            known[1..].join("`, `")
        ))),
        false => Ok(chosen),
    }
}
