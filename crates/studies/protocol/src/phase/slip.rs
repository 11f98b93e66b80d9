//! Strokes along the gel until the indenter slides, for the detection of slip.

use taceva_core::{Nanometre, Phase, whole_count};

use super::{PhaseInputs, SHEAR_AXIS, nanometres};
use crate::phase_kind::PhaseKind;
use crate::press::{Motion, Press, Waypoint};

/// Directions of a stroke along x and y.
const DIRECTIONS: [[i64; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

/// One press for each stroke: all waypoints at one depth, each further along one direction by the distance between two frames.
pub(super) fn presses(inputs: &PhaseInputs<'_>) -> Vec<Press> {
    let draws = inputs.draws(PhaseKind::Slip);
    let spec = &inputs.protocol.slip;
    let length_mm = spec.length_mm.value;
    let step_mm = (spec.speed_mm_s.value / spec.rate_hz.value).min(length_mm);
    let steps = whole_count((length_mm / step_mm + SLACK).floor());
    let steps = i64::try_from(steps).unwrap_or(i64::MAX).min(STEPS_MOST);
    let step = nanometres(step_mm).0.max(1);
    let depth = nanometres(spec.depth_mm.value).min(inputs.depth_max);
    let stroke = |stroke: u64| {
        let place = draws.place(&inputs.footprint, stroke);
        let first = draws.between(0, 3, [stroke, SHEAR_AXIS]);
        let [along_x, along_y] = inwards(inputs, place, steps * step, first);
        let waypoints = (0..=steps).map(|number| Waypoint {
            depth,
            shear: [along_x, along_y].map(|along| Nanometre(along * number * step)),
            phase: Phase::Load,
        });
        inputs.press(place, Motion::Indent(waypoints.collect()))
    };
    (0..u64::from(spec.strokes.value)).map(stroke).collect()
}

/// Tolerance for the rounding error of a number of steps.
const SLACK: f64 = 1e-9;

/// Greatest number of steps of a stroke.
const STEPS_MOST: i64 = 10_000;

/// First direction, starting with number `first`, along which a stroke of `length` nanometres from `place` stays on the footprint; `[0, 0]` without
/// such a direction.
fn inwards(inputs: &PhaseInputs<'_>, place: [Nanometre; 2], length: i64, first: i64) -> [i64; 2] {
    let first = usize::try_from(first).unwrap_or_default();
    let mut directions = DIRECTIONS.into_iter().cycle().skip(first).take(4);
    let stays = |[along_x, along_y]: &[i64; 2]| {
        let [x, y] = place.map(|side| side.0);
        let end = [x + along_x * length, y + along_y * length].map(Nanometre);
        inputs.footprint.contains(end[0], end[1])
    };
    directions.find(stays).unwrap_or_default()
}
