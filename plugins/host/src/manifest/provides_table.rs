//! Content of a `[[provides]]` table, with the keys of all kinds.

use serde::Deserialize;
use taceva_core::{DriverKind, PixelFormat};
use toml::Spanned;

use super::argument::WrittenArgument;
use super::usb_id::UsbId;

/// Content of a `[[provides]]` table, with the keys of all kinds.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenProvides {
    pub(super) kind: Kind,
    pub(super) key: Spanned<String>,
    pub(super) title: Spanned<String>,
    pub(super) source: Option<Spanned<Source>>,
    pub(super) frame: Option<Spanned<WrittenFrame>>,
    pub(super) rate_hz: Option<Spanned<f64>>,
    pub(super) gel: Option<Spanned<WrittenGel>>,
    pub(super) camera: Option<Spanned<WrittenCamera>>,
    pub(super) field_of_view_mm2: Option<Spanned<f64>>,
    pub(super) footprint: Option<Spanned<WrittenFootprint>>,
    pub(super) limits: Option<Spanned<WrittenLimits>>,
    pub(super) scenes: Option<Spanned<Vec<String>>>,
    pub(super) holds: Option<Spanned<Vec<String>>>,
    pub(super) workspace: Option<Spanned<WrittenWorkspace>>,
    pub(super) repeatability_mm: Option<Spanned<f64>>,
    pub(super) pose_noise_mm: Option<Spanned<f64>>,
    pub(super) deceleration_mm_s2: Option<Spanned<f64>>,
    pub(super) stop_ms: Option<Spanned<f64>>,
    pub(super) latency_ms: Option<Spanned<f64>>,
    #[serde(rename = "noise_N")]
    pub(super) noise_n: Option<Spanned<f64>>,
    #[serde(rename = "resolution_N")]
    pub(super) resolution_n: Option<Spanned<f64>>,
    pub(super) guarded_motion: Option<Spanned<bool>>,
    pub(super) axes: Option<Spanned<Vec<Spanned<String>>>>,
    pub(super) tare: Option<Spanned<bool>>,
    pub(super) numbered: Option<Spanned<bool>>,
    #[serde(default)]
    pub(super) usb: Vec<UsbId>,
    #[serde(default)]
    pub(super) args: Vec<WrittenArgument>,
}

#[derive(Clone, Copy, Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
pub(super) enum Kind {
    Sensor,
    Robot,
    Force,
    Lighting,
    Changer,
    Estimator,
}

impl Kind {
    pub(super) fn name(self) -> &'static str {
        match self {
            Kind::Sensor => DriverKind::Sensor.name(),
            Kind::Robot => DriverKind::Robot.name(),
            Kind::Force => DriverKind::Force.name(),
            Kind::Lighting => DriverKind::Lighting.name(),
            Kind::Changer => DriverKind::Changer.name(),
            Kind::Estimator => "estimator",
        }
    }
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Source {
    Real,
    Simulated,
    Recorded,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenFrame {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) format: PixelFormat,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenGel {
    pub(super) opaque: Option<bool>,
    pub(super) markers: Option<bool>,
    pub(super) thickness_mm: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenCamera {
    pub(super) width: u32,
    pub(super) height: u32,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenFootprint {
    pub(super) shape: Shape,
    pub(super) radius_mm: Option<f64>,
    pub(super) half_x_mm: Option<f64>,
    pub(super) half_y_mm: Option<f64>,
    pub(super) depth_max_mm: Option<f64>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Shape {
    Disc,
    Rect,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenLimits {
    #[serde(rename = "Pz_max_mm")]
    pub(super) depth_mm: Option<f64>,
    #[serde(rename = "Fz_max_N")]
    pub(super) force_n: Option<f64>,
    pub(super) speed_max_mm_s: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenWorkspace {
    pub(super) least_mm: [f64; 3],
    pub(super) greatest_mm: [f64; 3],
}
