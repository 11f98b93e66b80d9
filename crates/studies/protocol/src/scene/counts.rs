//! Settings of a protocol. The defaults are the numbers of the TacEva paper.

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
    /// Settings for finding contact and for motions in contact.
    pub contact: Contact,
    /// Settings of presses for fitting and testing a model.
    pub calibration: Calibration,
    /// Settings of held-out presses, which show the places with large errors.
    pub spatial: Spatial,
    /// Settings of presses on gratings.
    pub gratings: Gratings,
    /// Settings of held-out presses that are repeated in each light scene.
    pub lighting: LightSweep,
    /// Settings of repeated presses.
    pub repeatability: Repeatability,
    /// Settings of presses that are recorded during loading and unloading.
    pub hysteresis: Hysteresis,
    /// Settings of the places at which the surface height is measured, on every unit.
    pub surface: SurfaceMap,
    /// Settings of frames without contact.
    pub idle: Idle,
    /// Settings of strokes until the indenter slides; without strokes unless the scene asks for them.
    pub slip: Slip,
    /// Settings of presses of the ball whose contact shape is predicted; without presses unless the scene asks for them.
    pub shape: ShapePresses,
    /// Settings of pairs of presses between which a board moves; without pairs unless the scene asks for them.
    pub pose: PosePairs,
    /// Load cycles between measured stages; `None` if the gel is not worn.
    pub wear: Option<WearSpec>,
}

table! {
    /// Settings for finding contact and for motions in contact.
    Contact {
        /// Radius of the spherical indenter, in mm. The text of the TacEva paper states 2, a caption of the paper 10.
        indenter_radius_mm: f64 = 2.0,
        /// Step of the search for contact, after which force is read, in mm.
        step_mm: f64 = 0.1,
        /// Normal force that counts as contact, in N.
        #[serde(rename = "threshold_N")]
        threshold_n: f64 = 0.02,
        /// Height from which depths are measured: the first contact or the fitted surface.
        depth_from: DepthOrigin = DepthOrigin::Contact,
        /// Height above the nominal surface at which the tip travels and the search begins, in mm.
        clearance_mm: f64 = 2.0,
        /// Depth below the nominal surface at which the search ends, in mm.
        search_mm: f64 = 12.0,
        /// Rest of the tip before a sample, in s.
        settle_s: f64 = 0.05,
        /// Speed of the tip during the search and in contact, in mm/s.
        speed_mm_s: f64 = 1.0,
        /// Speed of the tip out of contact, in mm/s.
        travel_mm_s: f64 = 20.0,
    }
}

table! {
    /// Presses for fitting and testing a model: several depths at each point, each straight and then sheared.
    Calibration {
        /// Number of contact points.
        points: u32 = 800,
        /// Greatest number of contact points that may be proposed to reach a wanted width of an interval.
        points_max: u32 = 10_000,
        /// Number of depths at each contact point.
        indentations: u32 = 4,
        /// Least depth of a press, in mm.
        depth_min_mm: f64 = 0.1,
        /// Greatest shear displacement along x and along y, in mm; 0 for no shear.
        shear_mm: f64 = 0.75,
    }
}

table! {
    /// Held-out presses, which show the places with large errors.
    Spatial {
        /// Number of contact points, each pressed once to its own depth.
        points: u32 = 1_600,
        /// Least depth of a press, in mm.
        depth_min_mm: f64 = 0.1,
        /// Greatest shear displacement along x and along y, in mm; 0 for no shear.
        shear_mm: f64 = 0.75,
    }
}

table! {
    /// Presses on gratings.
    Gratings {
        /// Finest spacing of the boards, in mm.
        from_mm: f64 = 0.25,
        /// Coarsest spacing of the boards, in mm.
        to_mm: f64 = 1.75,
        /// Step between the spacings of the boards, in mm.
        step_mm: f64 = 0.05,
        /// Kinds of gratings on the boards: lines, dots or both.
        kinds: Vec<GratingKind> = GratingKind::ALL.to_vec(),
        /// Number of presses on each board, each at its own angle.
        presses: u32 = 100,
        /// Depth of each press, as a share of the depth limit.
        depth_fraction: f64 = 0.5,
        /// Classifier that predicts the spacing of a grating.
        classified_by: GratingClassifier = GratingClassifier::Spectrum,
        /// Settings of a network classifier and of its features, by name.
        set: BTreeMap<String, toml::Value> = BTreeMap::new(),
    }
}

table! {
    /// Settings of the first held-out presses, which are repeated in each light scene.
    LightSweep {
        /// Number of contact points.
        points: u32 = 100,
    }
}

table! {
    /// Settings of repeated presses at the same contact points.
    Repeatability {
        /// Number of contact points.
        points: u32 = 100,
        /// Number of presses at each contact point.
        trials: u32 = 10,
        /// Step between depths, in mm.
        depth_step_mm: f64 = 0.1,
        /// Shear displacement along x at the greatest depth, in mm; 0 for no shear.
        shear_mm: f64 = 0.75,
        /// True to repeat the presses on every unit, which shows the differences between units.
        every_unit: bool = false,
    }
}

table! {
    /// Settings of presses that are recorded during loading and unloading.
    Hysteresis {
        /// Number of contact points.
        points: u32 = 100,
        /// Step between depths, in mm.
        depth_step_mm: f64 = 0.1,
        /// True to capture a frame at each depth of loading and unloading, so that the model predicts these samples.
        predicted: bool = false,
    }
}

table! {
    /// Places at which the surface height is measured, on every unit.
    SurfaceMap {
        /// Number of contact points.
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
    /// Strokes along the gel until the indenter slides. A frame is labelled `slip` at a shear force near friction × normal force.
    Slip {
        /// Number of strokes, each at its own place; 0 for none.
        strokes: u32 = 0,
        /// Speed of a stroke, in mm/s. The tip rests at each frame, so the speed only determines the distance between frames.
        speed_mm_s: f64 = 5.0,
        /// Number of frames per second of a stroke at this speed.
        rate_hz: f64 = 50.0,
        /// Length of a stroke, in mm.
        length_mm: f64 = 1.0,
        /// Depth of a stroke, in mm, at most the greatest depth. A ball slides after about 1.5 × depth × friction.
        depth_mm: f64 = 0.4,
        /// Coefficient of friction between indenter and gel; 1 on the simulated bench.
        friction: f64 = 1.0,
        /// Number of successive frames from which the label of the last one is predicted.
        window: u32 = 5,
    }
}

table! {
    /// Presses of the ball at random places and depths. A depth map is computed from the place and depth of the ball that the model predicts.
    ShapePresses {
        /// Number of presses, each at its own place; 0 for none.
        presses: u32 = 0,
        /// Number of depths of each press.
        depths: u32 = 3,
        /// Least depth of a press, in mm.
        depth_min_mm: f64 = 0.1,
        /// Side of a pixel of the depth maps, in mm.
        pixel_mm: f64 = 0.25,
    }
}

table! {
    /// Pairs of presses of one board. Within a pair, the board is shifted along the gel and turned about its axis.
    PosePairs {
        /// Number of pairs; 0 for none.
        pairs: u32 = 0,
        /// Greatest shift of the board along x and along y, in mm. It must be below the spacing of the board.
        shift_mm: f64 = 0.5,
        /// Greatest turn of the board within a pair, in degrees.
        turn_degrees: f64 = 10.0,
        /// Kind of grating on the board.
        kind: GratingKind = GratingKind::Dot,
        /// Spacing of the board, in mm.
        spacing_mm: f64 = 1.75,
        /// Depth of each press, as a share of the depth limit.
        depth_fraction: f64 = 0.5,
    }
}
