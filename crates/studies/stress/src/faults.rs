//! List of the faults, and selection of faults for a test.

mod cable_noise;
mod camera_shift;
mod dead_pixels;
mod defocus;
mod dust;
mod exposure_high;
mod exposure_low;
mod led_loss;
mod scratches;
mod sensor_noise;
mod stale_frames;
mod tear;

use taceva_core::{shown, suggestion};
use taceva_evaluate::EvaluateError;

use crate::fault::Fault;

/// Name of the list of all faults.
pub const LIST: &str = "gel-12";
/// Another name of the list of all faults.
const ALL: &str = "all";
/// Faults of a gel. Changed pictures alone cannot simulate them, because force and picture change together.
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
/// Version of the list. Scores by lists of different versions are not compared.
pub(crate) const LIST_VERSION: u32 = 1;

/// All faults, in the order of the list.
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

/// Faults called `names`, in the order of the list; all for the name of the list, or for `all`. Spaces around a name do not count.
///
/// # Errors
/// [`EvaluateError::Request`] for an unknown name, or without a name.
pub fn select(names: &[String]) -> Result<Vec<&'static Fault>, EvaluateError> {
    let names: Vec<&str> = names.iter().map(|name| name.trim()).collect();
    let ids: Vec<&str> = FAULTS.iter().map(|fault| fault.id).collect();
    let known: Vec<&str> = [LIST].into_iter().chain(ids).collect();
    let is_all = |name: &str| name == ALL || name == LIST;
    let is_known = |name: &str| is_all(name) || known.contains(&name);
    if let Some(gel) = names.iter().find(|name| GEL_FAULTS.contains(name)) {
        return Err(EvaluateError::Request(format!(
            "fault `{gel}`: only the bench knows its gel; write in a scene with a simulated sensor: stress = {{ faults = [\"{gel}\"] }}"
        )));
    }
    if let Some(unknown) = names.iter().find(|name| !is_known(name)) {
        return Err(EvaluateError::Request(format!(
            "fault `{}`: unknown, {}",
            shown(unknown),
            suggestion(unknown, &known)
        )));
    }
    let is_every = names.iter().any(|name| is_all(name));
    let chosen: Vec<&'static Fault> = FAULTS
        .into_iter()
        .filter(|fault| is_every || names.contains(&fault.id))
        .collect();
    match chosen.is_empty() {
        true => Err(EvaluateError::Request(format!(
            "no fault is named, expected {LIST} or some of `{}`",
            known[1..].join("`, `")
        ))),
        false => Ok(chosen),
    }
}
