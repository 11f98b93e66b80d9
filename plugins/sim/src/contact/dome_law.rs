//! Contact of a ball with a skin over a soft hemisphere.
//!
//! The force is F(d) = k₁ d + k₂ d^(3/2) at the depth d along the line through both centres: the buckled point stiffness of the skin, and Hertz's law
//! of the gel. A ball off the apex meets the dome at an angle. Such a ball presses less along the normal and slides, so that the rim appears softer.

use super::indentation::Indentation;
use super::stand::{Answer, Stand, dot};
use crate::elastic::hertz;
use crate::parameters::Dome;

#[derive(Clone, Copy, Debug)]
pub(super) struct DomeLaw {
    dome: Dome,
    /// 1 / √R for the relative radius R of the dome and the ball for which the gel stiffness is specified.
    inverse_root_stated: f64,
}

/// Radius of the ball for which the gel stiffness is specified, mm.
const STATED_INDENTER_MM: f64 = 2.0;

impl DomeLaw {
    pub(super) fn new(dome: Dome) -> DomeLaw {
        let stated = hertz::relative_radius(STATED_INDENTER_MM, dome.radius_mm);
        DomeLaw {
            dome,
            inverse_root_stated: 1.0 / stated.sqrt(),
        }
    }

    #[inline]
    pub(super) fn answer(&self, depth_mm: f64, indenter_radius_mm: f64) -> Answer {
        let relative = hertz::relative_radius(indenter_radius_mm, self.dome.radius_mm);
        let root = depth_mm.sqrt();
        let gel = self.dome.gel_n_per_mm_3_2 * relative.sqrt() * self.inverse_root_stated;
        let gel_force = gel * depth_mm * root;
        let skin_force = self.dome.skin_n_per_mm * depth_mm;
        let stiffness = self.dome.skin_n_per_mm + 1.5 * gel * root;
        Answer {
            force_n: skin_force + gel_force,
            shear_n_per_mm: self.dome.tangential_ratio * stiffness,
            radius_mm: (relative * depth_mm).sqrt(),
            // k₂ = (4/3) E/(1 − ν²) √R.
            young_modulus_mpa: gel * 9.0 / (16.0 * relative.sqrt()),
            skin_share: skin_force / (skin_force + gel_force),
        }
    }

    /// Height of the lowest point of a ball at first touch, relative to the apex.
    pub(super) fn touch_height_mm(&self, place_mm: [f64; 2], indenter_radius_mm: f64) -> f64 {
        self.rise(place_mm, indenter_radius_mm) - self.dome.radius_mm - indenter_radius_mm
    }

    /// Height of the ball's centre above the dome's centre, at first touch.
    fn rise(&self, [x, y]: [f64; 2], indenter_radius_mm: f64) -> f64 {
        let reach = self.dome.radius_mm + indenter_radius_mm;
        (reach * reach - x * x - y * y).max(0.0).sqrt()
    }

    pub(super) fn stand(
        &self,
        indentation: &Indentation,
        depth_mm: f64,
        shear_mm: [f64; 2],
    ) -> Stand {
        let [x, y] = indentation.place_mm;
        let [dx, dy] = shear_mm;
        let radius = indentation.indenter_radius_mm;
        let rise = self.rise(indentation.place_mm, radius) - depth_mm;
        let centres = [x + dx, y + dy, rise];
        let distance = dot(centres, centres).sqrt();
        let normal = centres.map(|component| component / distance);
        let moved = [dx, dy, -depth_mm];
        let inwards = dot(moved, normal);
        Stand {
            normal_depth_mm: self.dome.radius_mm + radius - distance,
            normal,
            slide: std::array::from_fn(|axis| moved[axis] - inwards * normal[axis]),
        }
    }
}
