//! Specimens: balls and boards.

use std::fmt;

use taceva_core::{GratingKind, Nanometre};
use thiserror::Error;

/// A rigid ball.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Indenter {
    /// Ball of radius 2 mm, for calibration.
    #[default]
    Ball2,
    /// Ball of radius 4 mm.
    Ball4,
    /// Ball of radius 10 mm, an alternative for surface maps.
    Ball10,
}

impl Indenter {
    /// All balls of the bench.
    pub const ALL: [Indenter; 3] = [Indenter::Ball2, Indenter::Ball4, Indenter::Ball10];

    /// Radius, mm.
    pub const fn radius_mm(self) -> f64 {
        match self {
            Indenter::Ball2 => 2.0,
            Indenter::Ball4 => 4.0,
            Indenter::Ball10 => 10.0,
        }
    }

    /// Finds the ball with this radius; `None` if no ball has it.
    pub fn from_radius(radius: Nanometre) -> Option<Indenter> {
        Indenter::ALL
            .into_iter()
            .find(|ball| Nanometre::from_millimetres(ball.radius_mm()) == Some(radius))
    }
}

impl fmt::Display for Indenter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "ball of {} mm radius", self.radius_mm())
    }
}

/// A board with a relief of equal ridges or bumps and gaps, 10 mm square. The period is twice the spacing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Grating {
    kind: GratingKind,
    spacing: Nanometre,
}

/// Finest spacing, nm; the next constants are the coarsest spacing and the step between boards.
const SPACING_MIN: i64 = 250_000;
const SPACING_MAX: i64 = 1_750_000;
const SPACING_STEP: i64 = 50_000;

impl Grating {
    /// Creates the board of this kind and spacing.
    ///
    /// # Errors
    /// [`GratingError`] if the catalogue has no such board: spacings are 0.25 to 1.75 mm in steps of 0.05 mm.
    pub fn new(kind: GratingKind, spacing: Nanometre) -> Result<Grating, GratingError> {
        let in_range = (SPACING_MIN..=SPACING_MAX).contains(&spacing.0);
        if in_range && (spacing.0 - SPACING_MIN) % SPACING_STEP == 0 {
            Ok(Grating { kind, spacing })
        } else {
            Err(GratingError { spacing })
        }
    }

    /// All boards, lines first, from fine to coarse.
    pub fn catalogue() -> impl Iterator<Item = Grating> {
        GratingKind::ALL.into_iter().flat_map(|kind| {
            (0..=(SPACING_MAX - SPACING_MIN) / SPACING_STEP).map(move |step| Grating {
                kind,
                spacing: Nanometre(SPACING_MIN + step * SPACING_STEP),
            })
        })
    }

    /// Kind of the relief: lines or dots.
    pub fn kind(&self) -> GratingKind {
        self.kind
    }

    /// Width of a ridge, and of the gap next to it.
    pub fn spacing(&self) -> Nanometre {
        self.spacing
    }

    /// Distance between the centres of ridges, mm.
    pub fn period_mm(&self) -> f64 {
        Nanometre(2 * self.spacing.0).to_millimetres()
    }
}

/// Error for a grating outside the catalogue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("no grating of {spacing} spacing, expected 0.25 to 1.75 mm in steps of 0.05 mm")]
pub struct GratingError {
    spacing: Nanometre,
}

/// Pose of a board on the gel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GratingPose {
    /// Rotation about z.
    pub yaw_degree: f64,
    /// Offset of the centre.
    pub offset_mm: [f64; 2],
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_catalogue_holds_31_spacings_of_both_kinds_and_makes_each_of_them() {
        let boards: Vec<Grating> = Grating::catalogue().collect();
        assert_eq!(boards.len(), 62);
        for board in boards {
            assert_eq!(Grating::new(board.kind(), board.spacing()), Ok(board));
        }
    }

    #[test]
    fn a_spacing_beside_the_catalogue_is_refused_by_name() {
        for nanometres in [200_000, 1_800_000, 275_000, 0, -250_000] {
            let refused = Grating::new(GratingKind::Dot, Nanometre(nanometres));
            assert!(refused.is_err(), "{nanometres}");
        }
        let error = Grating::new(GratingKind::Line, Nanometre(275_000)).expect_err("between two");
        assert_eq!(
            error.to_string(),
            "no grating of 0.275 mm spacing, expected 0.25 to 1.75 mm in steps of 0.05 mm"
        );
    }

    #[test]
    fn balls_are_found_by_their_radius() {
        assert_eq!(
            Indenter::from_radius(Nanometre(10_000_000)),
            Some(Indenter::Ball10)
        );
        assert_eq!(Indenter::from_radius(Nanometre(3_000_000)), None);
    }
}
