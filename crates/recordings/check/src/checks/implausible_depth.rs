//! TAC041: implausible depths, such as the distance to a camera or a robot.

use taceva_core::Channel;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC041",
    name: "implausible-depth",
    looks_for: "depths that are not indentations: above the thickness of any gel, or never near 0",
    hint: "map the indentation as Pz, 0 at the first touch and positive into the gel; subtract the height of the surface with `offset` of \
        the column",
    reads: None,
    find,
};

/// Minimum number of depths for the check.
const LEAST: usize = 3;
/// Maximum plausible median depth of presses, mm. The thickest gels on sale have 10 mm.
const DEEPEST_MM: f64 = 12.0;
/// Depths are distances if none falls below this fraction of the greatest depth, and all exceed `DISTANCE_MM`.
const NEVER_BELOW: f64 = 0.5;
const DISTANCE_MM: f64 = 5.0;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let Some(position) = evidence.table.channels().position(Channel::PZ.name()) else {
        return Vec::new();
    };
    let column = evidence.table.truth(position);
    let mut depths: Vec<f64> = (0..column.len())
        .filter_map(|row| Some(column.get(row)?.abs()))
        .collect();
    depths.sort_by(f64::total_cmp);
    if depths.len() < LEAST {
        return Vec::new();
    }
    let (least, greatest) = (depths[0], depths[depths.len() - 1]);
    let usual = depths[depths.len() / 2];
    let message = if usual > DEEPEST_MM {
        format!(
            "the median of Pz is {usual} mm, more than the thickness of any gel: Pz may be the distance to the camera"
        )
    } else if least > NEVER_BELOW * greatest && least > DISTANCE_MM {
        format!(
            "Pz is between {least} mm and {greatest} mm, never near 0: Pz may be a distance instead of an indentation"
        )
    } else {
        return Vec::new();
    };
    vec![Found::overall(Severity::Warning, message)]
}
