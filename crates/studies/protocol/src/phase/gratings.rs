//! Boards of every spacing, each pressed many times at the centre at different angles.

use taceva_core::{Nanometre, Specimen};

use super::{PhaseInputs, straight};
use crate::phase_kind::PhaseKind;
use crate::press::{Motion, Press};
use crate::scene::spacings;

/// Half a turn, in thousandths of a degree. Lines and dots look the same after half a turn.
const HALF_TURN: i64 = 180_000;

/// Presses ordered by board, because an operator changes boards by hand.
pub(super) fn presses(inputs: &PhaseInputs<'_>) -> Vec<Press> {
    let draws = inputs.draws(PhaseKind::Gratings);
    let spec = &inputs.protocol.gratings;
    let Ok(spacings) = spacings(spec) else {
        // Parsing has rejected such gratings.
        return Vec::new();
    };
    let depth = fraction_of(inputs.depth_max, spec.depth_fraction.value);
    let boards = spec.kinds.value.iter().flat_map(|kind| {
        let spacings = spacings.iter();
        spacings.map(move |spacing| Specimen::Grating {
            kind: *kind,
            spacing: *spacing,
        })
    });
    boards
        .enumerate()
        .flat_map(|(board, specimen)| {
            (0..spec.presses.value).map(move |press| {
                let place = [board as u64, u64::from(press)];
                let turn = draws.between(0, HALF_TURN - 1, place);
                let turn_millidegrees = i32::try_from(turn).expect("less than half a turn");
                Press {
                    specimen,
                    turn_millidegrees,
                    // Presses at equal angles must still have different ids.
                    repeat: Some(press),
                    ..inputs.press([Nanometre(0); 2], Motion::Indent(vec![straight(depth)]))
                }
            })
        })
        .collect()
}

/// Product of `fraction` and `depth`, rounded to whole nanometres.
pub(crate) fn fraction_of(depth: Nanometre, fraction: f64) -> Nanometre {
    Nanometre::from_millimetres(depth.to_millimetres() * fraction)
        .expect("a fraction of a length is a length")
}
