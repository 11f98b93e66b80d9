//! TAC034: untouched pictures that differ from the reference frame, because the camera, the light or the gel has changed.

use taceva_core::{Field, Unit, by_count, counted};

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use crate::rest_change::{RestChange, lower_median};
use crate::tiles::Tiles;

pub(super) static CHECK: Check = Check {
    code: "TAC034",
    name: "changed-rest",
    looks_for: "pictures without contact that differ from the reference more than from one another: on average by a third of the mean change by \
                contact, or in one tile (1/8 of the width) by the largest change by contact",
    hint: "record a new untouched reference picture: that corrects most changes of light, exposure, dust and position; otherwise check \
        the lens, the lamps and the coating",
    reads: Some(Field::Frame),
    find,
};

/// Minimum number of untouched pictures, and of pictures with contact, from which a mean is computed.
const LEAST: usize = 3;
/// Force below which there is no contact, N. `UNTOUCHED_MM` is this limit for the depth, mm.
const UNTOUCHED_N: f64 = 0.02;
const UNTOUCHED_MM: f64 = 0.01;
/// Minimum change of the untouched pictures since the reference, as a multiple of the median noise. For normal noise this is three standard
/// deviations.
const NOISES: f64 = 4.5;
/// Fraction of the greatest load above which a picture shows contact.
const PRESSED: f64 = 0.5;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let (Some(load), Some(reference)) = (evidence.load(), evidence.reference) else {
        return Vec::new();
    };
    let channel = &evidence.table.channels().as_slice()[load];
    let untouched_to = match channel.unit() {
        Unit::Newton => UNTOUCHED_N,
        Unit::Millimetre => UNTOUCHED_MM,
        _ => return Vec::new(),
    };
    let pictures = evidence.loaded_pictures(load);
    let greatest = pictures.iter().map(|picture| picture.2).fold(0.0, f64::max);
    let without_depth = evidence.without_depth();
    let rest: Vec<(usize, &Tiles)> = pictures
        .iter()
        .filter(|picture| picture.2 < untouched_to && without_depth[picture.0])
        .map(|picture| (picture.0, picture.1))
        .collect();
    let pressed: Vec<&Tiles> = pictures
        .iter()
        .filter(|picture| picture.2 >= PRESSED * greatest && picture.2 >= 2.0 * untouched_to)
        .map(|picture| picture.1)
        .collect();
    if rest.len() < LEAST || pressed.len() < LEAST {
        return Vec::new();
    }
    // The median of each tile would cost more for the same result: static faults are in every picture.
    let Some(mean) = Tiles::mean(rest.iter().map(|(_, tiles)| *tiles)) else {
        return Vec::new();
    };
    // Contact is measured from untouched pictures of the same time, because both contain the fault.
    let Some(change) = RestChange::of(&reference.tiles, &mean, &pressed) else {
        return Vec::new();
    };
    let percent = |part: f64, whole: f64| 100.0 * part / whole;
    let pictures = counted(rest.len(), "picture");
    let differ = by_count(rest.len(), "differs", "differ");
    let is_clear = |change: f64, of: fn(&Tiles, &Tiles) -> f64| change > NOISES * noise(&rest, of);
    let message = if change.is_overall() && is_clear(change.mean, Tiles::distance) {
        format!(
            "{pictures} without contact {differ} from the reference by {:.0} % of the mean change by contact",
            percent(change.mean, change.contact_mean)
        )
    } else if change.is_local() && is_clear(change.greatest, Tiles::greatest) {
        format!(
            "{pictures} without contact {differ} from the reference in one place by {:.0} % of the largest change by contact",
            percent(change.greatest, change.contact_greatest)
        )
    } else {
        return Vec::new();
    };
    let rows: Vec<usize> = rest.iter().map(|(row, _)| *row).collect();
    vec![evidence.found(Severity::Warning, message, &rows)]
}

/// Median noise of an untouched picture, estimated from consecutive untouched pictures. A single faulty picture hardly changes the estimate.
fn noise(rest: &[(usize, &Tiles)], of: fn(&Tiles, &Tiles) -> f64) -> f64 {
    let consecutive = rest.windows(2).map(|pair| of(pair[0].1, pair[1].1));
    lower_median(consecutive) / std::f64::consts::SQRT_2
}
