//! Catalogue of the grating boards.

use taceva_core::Nanometre;

use crate::scene::Gratings;
use crate::text::{SceneProblem, Setting};

/// Finest spacing of the boards in the catalogue (TacEva 2025, spatial resolution).
const FINEST: Nanometre = Nanometre(250_000);
/// Coarsest spacing of the boards in the catalogue.
const COARSEST: Nanometre = Nanometre(1_750_000);
/// Step between the spacings of the boards in the catalogue.
const STEP: Nanometre = Nanometre(50_000);
const CATALOGUE: &str = "0.25 mm to 1.75 mm in steps of 0.05 mm, lines and dots";

/// Error for gratings outside the catalogue.
pub(crate) struct RefusedGratings {
    /// Byte offset of the wrong value in the scene, if known.
    pub(crate) at: Option<usize>,
    /// Problem to report.
    pub(crate) problem: SceneProblem,
}

/// Spacing `written` in a scene. Rejects a spacing that no board of the catalogue has.
pub(crate) fn spacing_of(written: &Setting<f64>) -> Result<Nanometre, RefusedGratings> {
    let in_catalogue = |length: &Nanometre| {
        (FINEST..=COARSEST).contains(length) && (length.0 - FINEST.0) % STEP.0 == 0
    };
    let length = Nanometre::from_millimetres(written.value);
    length.filter(in_catalogue).ok_or(RefusedGratings {
        at: written.at(),
        problem: SceneProblem::Grating {
            found: written.value,
            catalogue: CATALOGUE,
        },
    })
}

/// Spacings of boards that `gratings` requests. Rejects spacings that no board of the catalogue has.
pub(crate) fn spacings(gratings: &Gratings) -> Result<Vec<Nanometre>, RefusedGratings> {
    let Gratings {
        from_mm,
        to_mm,
        step_mm,
        kinds,
        ..
    } = gratings;
    let (from, to) = (spacing_of(from_mm)?, spacing_of(to_mm)?);
    let step = Nanometre::from_millimetres(step_mm.value)
        .filter(|step| step.0 > 0 && step.0 % STEP.0 == 0)
        .ok_or_else(|| RefusedGratings {
            at: step_mm.at(),
            problem: SceneProblem::Contradiction(format!(
                "`step_mm` is {}, expected a multiple of 0.05, the step between boards",
                step_mm.value
            )),
        })?;
    if from > to {
        return Err(RefusedGratings {
            at: from_mm.at(),
            problem: SceneProblem::Contradiction(format!(
                "gratings from {from} to {to}: expected `from_mm` at most `to_mm`"
            )),
        });
    }
    let twice = (1..kinds.value.len()).any(|at| kinds.value[..at].contains(&kinds.value[at]));
    if kinds.value.is_empty() || twice {
        return Err(RefusedGratings {
            at: kinds.at(),
            problem: SceneProblem::Contradiction(
                "`kinds` is empty or names a kind twice, expected \"line\", \"dot\" or both"
                    .to_owned(),
            ),
        });
    }
    Ok((from.0..=to.0)
        .step_by(usize::try_from(step.0).unwrap_or(usize::MAX))
        .map(Nanometre)
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_paper_s_boards_are_thirty_one_of_each_kind() {
        let spacings = spacings(&Gratings::default()).map_err(|refused| refused.problem);
        assert_eq!(spacings.expect("in the catalogue").len(), 31);
    }
}
