//! Pairs of presses of one board, between which it is shifted along the gel and turned about its axis.

use taceva_core::{Nanometre, Specimen};

use super::gratings::fraction_of;
use super::{PhaseInputs, nanometres, straight};
use crate::phase_kind::PhaseKind;
use crate::press::{Motion, Press};
use crate::scene::spacing_of;

/// Two presses for each pair. A press has its index as repeat, so presses 0 and 1 are a pair, then 2 and 3.
///
/// A place is at most half of the greatest shift from the centre, along each axis. A turn is between 0 and the greatest turn. The two presses of a
/// pair therefore differ by at most the greatest shift along each axis, and the greatest turn.
pub(super) fn presses(inputs: &PhaseInputs<'_>) -> Vec<Press> {
    let draws = inputs.draws(PhaseKind::Pose);
    let spec = &inputs.protocol.pose;
    let Ok(spacing) = spacing_of(&spec.spacing_mm) else {
        // Parsing has rejected such a board.
        return Vec::new();
    };
    let specimen = Specimen::Grating {
        kind: spec.kind.value,
        spacing,
    };
    let depth = fraction_of(inputs.depth_max, spec.depth_fraction.value);
    let reach = nanometres(spec.shift_mm.value / 2.0).0;
    let turn = millidegrees(spec.turn_degrees.value);
    (0..2 * spec.pairs.value)
        .map(|press| {
            let draw = |least: i64, greatest: i64, axis: u64| {
                draws.between(least, greatest, [u64::from(press), axis])
            };
            let place = [0, 1].map(|axis| Nanometre(draw(-reach, reach, axis)));
            let turned = draw(0, turn, 2);
            Press {
                specimen,
                turn_millidegrees: i32::try_from(turned).expect("at most a quarter of a turn"),
                repeat: Some(press),
                ..inputs.press(place, Motion::Indent(vec![straight(depth)]))
            }
        })
        .collect()
}

/// Converts an angle in degrees that was checked during parsing.
#[expect(
    clippy::cast_possible_truncation,
    reason = "an angle of a scene is above 0 and at most 90 degrees"
)]
fn millidegrees(degrees: f64) -> i64 {
    (degrees * 1e3).round() as i64
}
