//! Presses of the bench.

use super::PressError;
use crate::parameters::{Outline, Parameters};
use crate::specimen::Indenter;

/// A press as commanded to the rig.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Press {
    /// Id of the press, which determines its random numbers.
    pub id: u64,
    /// Id of the point. Presses at one point share the first contact and the zero of the transducer.
    pub point: u64,
    /// Place of the ball, along x and y.
    pub place_mm: [f64; 2],
    /// Travel of the robot after first contact.
    pub depth_mm: f64,
    /// Shear of the ball along the gel, after the travel.
    pub shear_mm: [f64; 2],
    /// Travel at the turning point during unloading; `None` during loading.
    pub turned_mm: Option<f64>,
    /// Ball that presses.
    pub indenter: Indenter,
}

impl Press {
    /// Maximum travel that this press has reached.
    pub(super) fn deepest_mm(&self) -> f64 {
        self.turned_mm
            .map_or(self.depth_mm, |turned| turned.max(self.depth_mm))
    }

    #[inline]
    pub(super) fn check(
        &self,
        parameters: &Parameters,
        outline: Outline,
    ) -> Result<(), PressError> {
        let named = [
            ("place x", self.place_mm[0]),
            ("place y", self.place_mm[1]),
            ("depth", self.depth_mm),
            ("shear x", self.shear_mm[0]),
            ("shear y", self.shear_mm[1]),
            ("turned", self.turned_mm.unwrap_or(0.0)),
        ];
        if let Some((name, value)) = named.into_iter().find(|(_, value)| !value.is_finite()) {
            return Err(PressError::NotFinite { name, value });
        }
        if !outline.contains(self.place_mm) {
            return Err(PressError::Outside {
                place_mm: self.place_mm,
                outline,
            });
        }
        let depth_max_mm = parameters.probing.depth_max_mm;
        for depth_mm in [self.depth_mm, self.deepest_mm()] {
            if !(0.0..=depth_max_mm).contains(&depth_mm) {
                return Err(PressError::Depth {
                    depth_mm,
                    depth_max_mm,
                });
            }
        }
        let shear_most_mm = SHEAR_MOST;
        for shear_mm in self.shear_mm {
            if shear_mm.abs() > shear_most_mm {
                return Err(PressError::Shear {
                    shear_mm,
                    shear_most_mm,
                });
            }
        }
        Ok(())
    }
}

/// Maximum shear along one axis, in mm. With more shear, a ball would miss a dome.
const SHEAR_MOST: f64 = 5.0;
