//! Sensing surface of a sensor. The surface is declared and not derived from samples, so the bins of positions do not depend on the samples.

use std::fmt;

use crate::nanometre::Nanometre;

/// Outline of the sensing surface in top view, centred on the sensor's axis, and its greatest indentation.
///
/// ```
/// use taceva_core::{Footprint, Nanometre};
/// let dome = Footprint::disc(17.0, Some(3.5))?;
/// assert!(dome.contains(Nanometre(12_000_000), Nanometre(-12_000_000)));
/// assert!(!dome.contains(Nanometre(12_100_000), Nanometre(12_100_000)));
/// # Ok::<(), taceva_core::FootprintError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Footprint {
    outline: Outline,
    depth_max: Option<Nanometre>,
}

/// Shape and size of a sensing surface in top view.
///
/// ```
/// use taceva_core::{Footprint, Nanometre, Outline};
/// let gel = Footprint::rectangle(8.0, 6.0, None)?;
/// let halves = Outline::Rectangle { half_x: Nanometre(8_000_000), half_y: Nanometre(6_000_000) };
/// assert_eq!(gel.outline(), halves);
/// # Ok::<(), taceva_core::FootprintError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Outline {
    /// A disc.
    Disc {
        /// Radius of the disc.
        radius: Nanometre,
    },
    /// A rectangle with sides along x and y.
    Rectangle {
        /// Half the length along x.
        half_x: Nanometre,
        /// Half the length along y.
        half_y: Nanometre,
    },
}

impl Footprint {
    /// Disc with the radius `radius_mm` and the greatest indentation `depth_max_mm`.
    ///
    /// # Errors
    /// [`FootprintError`] for a length that is not above 0, or is above 10 m.
    pub fn disc(radius_mm: f64, depth_max_mm: Option<f64>) -> Result<Footprint, FootprintError> {
        let radius = length("radius_mm", radius_mm)?;
        Footprint::new(Outline::Disc { radius }, depth_max_mm)
    }

    /// Rectangle centred on the sensor's axis. `half_x_mm` and `half_y_mm` are half its side lengths.
    ///
    /// # Errors
    /// The errors of [`disc`](Footprint::disc).
    pub fn rectangle(
        half_x_mm: f64,
        half_y_mm: f64,
        depth_max_mm: Option<f64>,
    ) -> Result<Footprint, FootprintError> {
        let half_x = length("half_x_mm", half_x_mm)?;
        let half_y = length("half_y_mm", half_y_mm)?;
        Footprint::new(Outline::Rectangle { half_x, half_y }, depth_max_mm)
    }

    fn new(outline: Outline, depth_max_mm: Option<f64>) -> Result<Footprint, FootprintError> {
        let depth_max = depth_max_mm
            .map(|depth| length("depth_max_mm", depth))
            .transpose()?;
        Ok(Footprint { outline, depth_max })
    }

    /// Shape and size of the surface in top view.
    pub fn outline(&self) -> Outline {
        self.outline
    }

    /// Greatest indentation; `None` if not declared.
    pub fn depth_max(&self) -> Option<Nanometre> {
        self.depth_max
    }

    /// Half the width and half the height of the smallest rectangle around the outline.
    pub fn half_extent(&self) -> [Nanometre; 2] {
        match self.outline {
            Outline::Disc { radius } => [radius, radius],
            Outline::Rectangle { half_x, half_y } => [half_x, half_y],
        }
    }

    /// Greatest distance of a surface point from the centre: the radius of a disc, or half a rectangle's diagonal rounded up to a nanometre.
    pub fn reach(&self) -> Nanometre {
        match self.outline {
            Outline::Disc { radius } => radius,
            Outline::Rectangle { half_x, half_y } => {
                let squared = square(half_x) + square(half_y);
                let root = squared.isqrt();
                let up = u128::from(root * root < squared);
                Nanometre(i64::try_from(root + up).expect("lengths are at most 10 m"))
            }
        }
    }

    /// True if the point (`x`, `y`) is on the sensing surface or its edge.
    pub fn contains(&self, x: Nanometre, y: Nanometre) -> bool {
        match self.outline {
            Outline::Disc { radius } => square(x) + square(y) <= square(radius),
            Outline::Rectangle { half_x, half_y } => x.0.abs() <= half_x.0 && y.0.abs() <= half_y.0,
        }
    }
}

fn square(length: Nanometre) -> u128 {
    let magnitude = u128::from(length.0.unsigned_abs());
    magnitude * magnitude
}

fn length(name: &'static str, millimetres: f64) -> Result<Nanometre, FootprintError> {
    let usable = millimetres > 0.0 && millimetres <= 10_000.0;
    let length = Nanometre::from_millimetres(millimetres).filter(|length| usable && length.0 > 0);
    length.ok_or(FootprintError { name, millimetres })
}

/// Error for a length of a footprint that is not above 0, or is above 10 m.
///
/// ```
/// use taceva_core::Footprint;
/// let error = Footprint::disc(-1.0, None).unwrap_err();
/// assert_eq!(error.to_string(), "`radius_mm` is -1, expected a length above 0 and up to 10000 mm");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FootprintError {
    name: &'static str,
    millimetres: f64,
}

impl fmt::Display for FootprintError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let FootprintError { name, millimetres } = self;
        write!(
            f,
            "`{name}` is {millimetres}, expected a length above 0 and up to 10000 mm"
        )
    }
}

impl std::error::Error for FootprintError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_edge_belongs_to_the_surface() {
        let gel = Footprint::rectangle(8.0, 10.0, Some(1.0)).expect("lengths");
        assert!(gel.contains(Nanometre(-8_000_000), Nanometre(10_000_000)));
        assert!(!gel.contains(Nanometre(8_000_001), Nanometre(0)));
        assert_eq!(gel.depth_max(), Some(Nanometre(1_000_000)));
    }

    #[test]
    fn the_reach_of_a_rectangle_is_its_half_diagonal() {
        let gel = Footprint::rectangle(3.0, 4.0, None).expect("lengths");
        assert_eq!(gel.reach(), Nanometre(5_000_000));
        let uneven = Footprint::rectangle(1e-6, 1e-6, None).expect("lengths");
        assert_eq!(uneven.reach(), Nanometre(2));
    }

    #[test]
    fn a_surface_without_extent_is_refused_by_name() {
        for radius in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-9, 1e9] {
            assert!(Footprint::disc(radius, None).is_err(), "{radius}");
        }
        let error = Footprint::disc(5.0, Some(0.0)).expect_err("no depth");
        assert_eq!(
            error.to_string(),
            "`depth_max_mm` is 0, expected a length above 0 and up to 10000 mm"
        );
    }
}
