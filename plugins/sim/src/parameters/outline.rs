//! Outline of the probed surface.

use std::fmt;

use super::{Body, Parameters};

/// Outline of the probed surface, centred on the sensor's axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outline {
    /// A disc, on a dome.
    Disc {
        /// Radius of the disc.
        radius_mm: f64,
    },
    /// A rectangle, on a flat gel.
    Rectangle {
        /// Half the width and half the height.
        half_mm: [f64; 2],
    },
}

impl Parameters {
    /// Outline of the probed surface.
    pub fn outline(&self) -> Outline {
        let half_mm = [self.probing.half_width_mm, self.probing.half_height_mm];
        match self.body {
            Body::Layer(_) => Outline::Rectangle { half_mm },
            Body::Dome(_) => Outline::Disc {
                radius_mm: half_mm[0],
            },
        }
    }
}

impl Outline {
    /// True if a place is within the outline, edge included.
    #[inline]
    pub fn contains(&self, [x, y]: [f64; 2]) -> bool {
        match *self {
            Outline::Disc { radius_mm } => x * x + y * y <= radius_mm * radius_mm,
            Outline::Rectangle { half_mm } => x.abs() <= half_mm[0] && y.abs() <= half_mm[1],
        }
    }

    /// Place for `across` and `along`, each 0 to 1. Uniform inputs cover the outline uniformly.
    pub fn place(&self, across: f64, along: f64) -> [f64; 2] {
        match *self {
            Outline::Disc { radius_mm } => {
                let (sin, cos) = libm::sincos(std::f64::consts::TAU * along);
                let radius = radius_mm * across.sqrt();
                [radius * cos, radius * sin]
            }
            Outline::Rectangle { half_mm } => [
                (2.0 * across - 1.0) * half_mm[0],
                (2.0 * along - 1.0) * half_mm[1],
            ],
        }
    }
}

impl fmt::Display for Outline {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Outline::Disc { radius_mm } => write!(f, "a disc of {radius_mm} mm radius"),
            Outline::Rectangle { half_mm: [x, y] } => {
                write!(f, "a rectangle of ±{x} × ±{y} mm")
            }
        }
    }
}
