//! How many presses of which kind: the counts of a protocol, with those of the paper as defaults.

use std::collections::BTreeMap;

use serde::Deserialize;
use taceva_core::GratingKind;

use super::classifier::GratingClassifier;
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

/// Every count of a protocol.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table of protocols")]
pub struct Protocol {
    /// How contact is searched for and held.
    pub contact: Contact,
    /// Presses that a model is fitted and tested on.
    pub calibration: Calibration,
    /// Presses held out to see where errors are large.
    pub spatial: Spatial,
    /// Presses on gratings.
    pub gratings: Gratings,
    /// Presses under other light.
    pub lighting: LightSweep,
    /// Presses that are repeated.
    pub repeatability: Repeatability,
    /// Presses into the gel and out again.
    pub hysteresis: Hysteresis,
    /// Places where the height of the surface is felt, on every unit.
    pub surface: SurfaceMap,
    /// Pictures without contact.
    pub idle: Idle,
}

table! {
    /// How contact is searched for and held.
    Contact {
        /// Radius of the spherical indenter in mm; the paper's text says 2, a caption 10.
        indenter_radius_mm: f64 = 2.0,
        /// How far the tip goes between two looks at the force, in mm.
        step_mm: f64 = 0.1,
        /// The normal force that counts as contact, in N.
        #[serde(rename = "threshold_N")]
        threshold_n: f64 = 0.02,
        /// Height above the nominal surface from which the search begins and at which the tip travels, in mm.
        clearance_mm: f64 = 2.0,
        /// Depth below the nominal surface at which the search gives up, in mm.
        search_mm: f64 = 12.0,
        /// Rest before a sample is taken, in s.
        settle_s: f64 = 0.05,
        /// Speed of the tip while it searches and presses, in mm/s.
        speed_mm_s: f64 = 1.0,
        /// Speed of the tip out of contact, in mm/s.
        travel_mm_s: f64 = 20.0,
    }
}

table! {
    /// Presses that a model is fitted and tested on: at each point some depths, each straight and then sheared.
    Calibration {
        /// Points.
        points: u32 = 800,
        /// Depths a point.
        indentations: u32 = 4,
        /// The least depth in mm.
        depth_min_mm: f64 = 0.1,
        /// The greatest shear along x and along y in mm; 0 for none.
        shear_mm: f64 = 0.75,
    }
}

table! {
    /// Presses held out to see where errors are large.
    Spatial {
        /// Points, each pressed once at a depth of its own.
        points: u32 = 1_600,
        /// The least depth in mm.
        depth_min_mm: f64 = 0.1,
        /// The greatest shear along x and along y in mm; 0 for none.
        shear_mm: f64 = 0.75,
    }
}

table! {
    /// Presses on gratings.
    Gratings {
        /// The finest spacing in mm.
        from_mm: f64 = 0.25,
        /// The coarsest spacing in mm.
        to_mm: f64 = 1.75,
        /// From one spacing to the next, in mm.
        step_mm: f64 = 0.05,
        /// The reliefs.
        kinds: Vec<GratingKind> = GratingKind::ALL.to_vec(),
        /// Presses a board, each turned by an angle of its own.
        presses: u32 = 100,
        /// The depth of each press as a fraction of the greatest.
        depth_fraction: f64 = 0.5,
        /// What classifies the spacing of each press from its picture.
        classified_by: GratingClassifier = GratingClassifier::Spectrum,
        /// Settings of a network that classifies, and of its features, by name.
        set: BTreeMap<String, toml::Value> = BTreeMap::new(),
    }
}

table! {
    /// Presses under other light: the first ones of the held-out set again in each scene of light.
    LightSweep {
        /// Points.
        points: u32 = 100,
    }
}

table! {
    /// Presses that are repeated.
    Repeatability {
        /// Points.
        points: u32 = 100,
        /// Times each point is approached, pressed and left.
        trials: u32 = 10,
        /// From one depth to the next, in mm.
        depth_step_mm: f64 = 0.1,
        /// The shear along x in mm at the greatest depth; 0 for none.
        shear_mm: f64 = 0.75,
    }
}

table! {
    /// Presses into the gel and out again.
    Hysteresis {
        /// Points.
        points: u32 = 100,
        /// From one depth to the next, in mm.
        depth_step_mm: f64 = 0.1,
    }
}

table! {
    /// Places where the height of the surface is felt, on every unit.
    SurfaceMap {
        /// Points.
        points: u32 = 400,
    }
}

table! {
    /// Pictures without contact.
    Idle {
        /// Pictures.
        frames: u32 = 100,
    }
}
