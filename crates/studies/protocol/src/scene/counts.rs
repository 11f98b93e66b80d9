//! Counts of a protocol, with those of the paper as defaults.

use std::collections::BTreeMap;

use serde::Deserialize;
use taceva_core::GratingKind;

use super::classifier::GratingClassifier;
use super::depth_origin::DepthOrigin;
use crate::text::Setting;

/// Declares a table of settings with its defaults.
macro_rules! table {
    ($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $field:ident: $kind:ty = $default:expr,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq, Deserialize)]
        #[serde(deny_unknown_fields, default, expecting = "a table of counts")]
        pub struct $name {
            $($(#[$field_doc])* pub $field: Setting<$kind>,)*
        }

        impl Default for $name {
            fn default() -> $name {
                $name { $($field: Setting::default_of($default),)* }
            }
        }
    };
}

/// Settings of all phases of a protocol.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table of protocols")]
pub struct Protocol {
    /// Settings for finding and holding contact.
    pub contact: Contact,
    /// Presses for fitting and testing a model.
    pub calibration: Calibration,
    /// Held-out presses, which show where errors are large.
    pub spatial: Spatial,
    /// Presses on gratings.
    pub gratings: Gratings,
    /// Presses in other scenes of light.
    pub lighting: LightSweep,
    /// Repeated presses.
    pub repeatability: Repeatability,
    /// Presses into the gel and out again.
    pub hysteresis: Hysteresis,
    /// Places at which the height of the surface is felt, on every unit.
    pub surface: SurfaceMap,
    /// Pictures without contact.
    pub idle: Idle,
}

table! {
    /// Settings for finding and holding contact.
    Contact {
        /// Radius of the spherical indenter, in mm; the paper's text says 2, a caption 10.
        indenter_radius_mm: f64 = 2.0,
        /// Step of the search between two readings of force, in mm.
        step_mm: f64 = 0.1,
        /// Normal force that counts as contact, in N.
        #[serde(rename = "threshold_N")]
        threshold_n: f64 = 0.02,
        /// Height from which depths count.
        depth_from: DepthOrigin = DepthOrigin::Contact,
        /// Height of travel and start of the search above the nominal surface, in mm.
        clearance_mm: f64 = 2.0,
        /// Depth below the nominal surface at which the search ends, in mm.
        search_mm: f64 = 12.0,
        /// Rest before a sample, in s.
        settle_s: f64 = 0.05,
        /// Speed of the tip in search and contact, in mm/s.
        speed_mm_s: f64 = 1.0,
        /// Speed of the tip out of contact, in mm/s.
        travel_mm_s: f64 = 20.0,
    }
}

table! {
    /// Presses for fitting and testing a model: at each point several depths, each straight and then sheared.
    Calibration {
        /// Number of points.
        points: u32 = 800,
        /// Depths at each point.
        indentations: u32 = 4,
        /// Least depth, in mm.
        depth_min_mm: f64 = 0.1,
        /// Greatest shear along x and along y, in mm; 0 for none.
        shear_mm: f64 = 0.75,
    }
}

table! {
    /// Held-out presses, which show where errors are large.
    Spatial {
        /// Number of points, each pressed once at a depth of its own.
        points: u32 = 1_600,
        /// Least depth, in mm.
        depth_min_mm: f64 = 0.1,
        /// Greatest shear along x and along y, in mm; 0 for none.
        shear_mm: f64 = 0.75,
    }
}

table! {
    /// Presses on gratings.
    Gratings {
        /// Finest spacing, in mm.
        from_mm: f64 = 0.25,
        /// Coarsest spacing, in mm.
        to_mm: f64 = 1.75,
        /// Step between spacings, in mm.
        step_mm: f64 = 0.05,
        /// The reliefs.
        kinds: Vec<GratingKind> = GratingKind::ALL.to_vec(),
        /// Presses on each board, each at its own angle.
        presses: u32 = 100,
        /// Depth of each press, as a fraction of the greatest.
        depth_fraction: f64 = 0.5,
        /// Classifier of the spacing.
        classified_by: GratingClassifier = GratingClassifier::Spectrum,
        /// Settings of a network classifier and of its features, by name.
        set: BTreeMap<String, toml::Value> = BTreeMap::new(),
    }
}

table! {
    /// The first held-out presses, repeated in each scene of light.
    LightSweep {
        /// Number of points.
        points: u32 = 100,
    }
}

table! {
    /// Repeated presses.
    Repeatability {
        /// Number of points.
        points: u32 = 100,
        /// Presses at each point.
        trials: u32 = 10,
        /// Step between depths, in mm.
        depth_step_mm: f64 = 0.1,
        /// Shear along x at the greatest depth, in mm; 0 for none.
        shear_mm: f64 = 0.75,
    }
}

table! {
    /// Presses into the gel and out again.
    Hysteresis {
        /// Number of points.
        points: u32 = 100,
        /// Step between depths, in mm.
        depth_step_mm: f64 = 0.1,
    }
}

table! {
    /// Places at which the height of the surface is felt, on every unit.
    SurfaceMap {
        /// Number of points.
        points: u32 = 400,
    }
}

table! {
    /// Pictures without contact.
    Idle {
        /// Number of pictures.
        frames: u32 = 100,
    }
}
