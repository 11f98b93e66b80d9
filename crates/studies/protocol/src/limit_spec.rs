//! Limits in a scene, which may only tighten the limits of the devices.

use serde::Deserialize;

use crate::text::Setting;

/// Limits in a scene. If a limit is absent, the limit of the device applies.
///
/// # Units
/// mm, N and mm/s; `Pz` is the indentation depth, `Fz` the normal force, `Fxy` the magnitude of the shear.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table of limits")]
pub struct LimitSpec {
    /// Deepest indentation.
    #[serde(rename = "Pz_max_mm")]
    pub depth_max_mm: Option<Setting<f64>>,
    /// Greatest normal force.
    #[serde(rename = "Fz_max_N")]
    pub normal_max_n: Option<Setting<f64>>,
    /// Greatest shear force.
    #[serde(rename = "Fxy_max_N")]
    pub shear_max_n: Option<Setting<f64>>,
    /// Greatest speed of the tip out of contact.
    pub speed_max_mm_s: Option<Setting<f64>>,
}

impl LimitSpec {
    /// Each limit with its key.
    pub(crate) fn named(&self) -> [(&'static str, Option<Setting<f64>>); 4] {
        [
            ("Pz_max_mm", self.depth_max_mm),
            ("Fz_max_N", self.normal_max_n),
            ("Fxy_max_N", self.shear_max_n),
            ("speed_max_mm_s", self.speed_max_mm_s),
        ]
    }

    /// Merges the limits of this table with the limits of `outer` as defaults.
    pub(crate) fn or(self, outer: LimitSpec) -> LimitSpec {
        LimitSpec {
            depth_max_mm: self.depth_max_mm.or(outer.depth_max_mm),
            normal_max_n: self.normal_max_n.or(outer.normal_max_n),
            shear_max_n: self.shear_max_n.or(outer.shear_max_n),
            speed_max_mm_s: self.speed_max_mm_s.or(outer.speed_max_mm_s),
        }
    }
}
