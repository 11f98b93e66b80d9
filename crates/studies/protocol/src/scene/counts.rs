//! Counts of a protocol; the defaults are the counts of the paper.

use std::collections::BTreeMap;

use serde::Deserialize;
use taceva_core::GratingKind;

use super::classifier::GratingClassifier;
use super::depth_origin::DepthOrigin;
use super::wear::WearSpec;
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
    /// Settings for finding and keeping contact.
    pub contact: Contact,
    /// Presses for fitting and testing a model.
    pub calibration: Calibration,
    /// Held-out presses, which show the places with large errors.
    pub spatial: Spatial,
    /// Presses on gratings.
    pub gratings: Gratings,
    /// Presses in other light scenes.
    pub lighting: LightSweep,
    /// Repeated presses.
    pub repeatability: Repeatability,
    /// Presses for loading and unloading.
    pub hysteresis: Hysteresis,
    /// Places at which the surface height is measured, on every unit.
    pub surface: SurfaceMap,
    /// Frames without contact.
    pub idle: Idle,
    /// Strokes until the indenter slides; none unless the scene asks for them.
    pub slip: Slip,
    /// Presses of the ball whose contact shape is predicted; none unless the scene asks for them.
    pub shape: ShapePresses,
    /// Pairs of presses between which a board moves; none unless the scene asks for them.
    pub pose: PosePairs,
    /// Cycles of load between measured stages; `None` for a single stage.
    pub wear: Option<WearSpec>,
}

table! {
    /// Settings for finding contact and for motions in contact.
    Contact {
        /// Radius of the spherical indenter, in mm. The text of the paper states 2, a caption 10.
        indenter_radius_mm: f64 = 2.0,
        /// Search step between two force readings, in mm.
        step_mm: f64 = 0.1,
        /// Normal force that counts as contact, in N.
        #[serde(rename = "threshold_N")]
        threshold_n: f64 = 0.02,
        /// Height relative to which depths are measured.
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
    /// Presses for fitting and testing a model: several depths at each point, each straight and then sheared.
    Calibration {
        /// Number of points.
        points: u32 = 800,
        /// Greatest number of points to propose for a wanted width.
        points_max: u32 = 10_000,
        /// Number of depths at each point.
        indentations: u32 = 4,
        /// Least depth, in mm.
        depth_min_mm: f64 = 0.1,
        /// Greatest shear along x and along y, in mm; 0 for none.
        shear_mm: f64 = 0.75,
    }
}

table! {
    /// Held-out presses, which show the places with large errors.
    Spatial {
        /// Number of points, each pressed once at its own depth.
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
        /// Reliefs of the boards.
        kinds: Vec<GratingKind> = GratingKind::ALL.to_vec(),
        /// Number of presses on each board, each at its own angle.
        presses: u32 = 100,
        /// Depth of each press, as a fraction of the greatest depth.
        depth_fraction: f64 = 0.5,
        /// Classifier of the spacing.
        classified_by: GratingClassifier = GratingClassifier::Spectrum,
        /// Settings of a network classifier and of its features, by name.
        set: BTreeMap<String, toml::Value> = BTreeMap::new(),
    }
}

table! {
    /// The first held-out presses, repeated in each light scene.
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
        /// Number of presses at each point.
        trials: u32 = 10,
        /// Step between depths, in mm.
        depth_step_mm: f64 = 0.1,
        /// Shear along x at the greatest depth, in mm; 0 for none.
        shear_mm: f64 = 0.75,
        /// True to repeat the presses on every unit, which shows the differences between units.
        every_unit: bool = false,
    }
}

table! {
    /// Presses for loading and unloading.
    Hysteresis {
        /// Number of points.
        points: u32 = 100,
        /// Step between depths, in mm.
        depth_step_mm: f64 = 0.1,
        /// True to capture a frame at each depth of both branches, which the model predicts.
        predicted: bool = false,
    }
}

table! {
    /// Places at which the surface height is measured, on every unit.
    SurfaceMap {
        /// Number of points.
        points: u32 = 400,
    }
}

table! {
    /// Frames without contact.
    Idle {
        /// Number of frames.
        frames: u32 = 100,
    }
}

table! {
    /// Strokes along the gel until the indenter slides. A frame is labelled `slip` if the shear force is near the limit of Coulomb's friction.
    Slip {
        /// Number of strokes, each at its own place; 0 for none.
        strokes: u32 = 0,
        /// Speed of a stroke, in mm/s. The tip rests at each frame, so the speed sets the distance between frames.
        speed_mm_s: f64 = 5.0,
        /// Number of frames per second of a stroke.
        rate_hz: f64 = 50.0,
        /// Length of a stroke, in mm.
        length_mm: f64 = 1.0,
        /// Depth of a stroke, in mm, at most the greatest depth. A ball slides after about 1.5 times the depth times the coefficient of friction.
        depth_mm: f64 = 0.4,
        /// Coefficient of friction between indenter and gel; 1 on the simulated bench.
        friction: f64 = 1.0,
        /// Number of frames from which a frame is predicted.
        window: u32 = 5,
    }
}

table! {
    /// Presses of the ball at drawn places and depths. The predicted place and depth of the ball give a predicted depth map.
    ShapePresses {
        /// Number of presses, each at its own place; 0 for none.
        presses: u32 = 0,
        /// Number of depths of each press.
        depths: u32 = 3,
        /// Least depth, in mm.
        depth_min_mm: f64 = 0.1,
        /// Side of a pixel of the depth maps, in mm.
        pixel_mm: f64 = 0.25,
    }
}

table! {
    /// Pairs of presses of one board, between which it is shifted along the gel and turned about its axis.
    PosePairs {
        /// Number of pairs; 0 for none.
        pairs: u32 = 0,
        /// Greatest shift along x and along y, in mm, below the spacing of the board.
        shift_mm: f64 = 0.5,
        /// Greatest turn, in degrees.
        turn_degrees: f64 = 10.0,
        /// Relief of the board.
        kind: GratingKind = GratingKind::Dot,
        /// Spacing of the board, in mm.
        spacing_mm: f64 = 1.75,
        /// Depth of each press, as a fraction of the greatest depth.
        depth_fraction: f64 = 0.5,
    }
}
