//! The sensor of a rig, and facts about its gel that no camera states.

use serde::Deserialize;
use taceva_core::{Certificate, Instrument};

use super::Check;
use super::certificate::WrittenCertificate;
use super::latency::{LATENCY, UNCERTAINTY};
use crate::footprint_spec::FootprintSpec;
use crate::text::{SceneError, Setting};

/// A sensor of a rig.
#[derive(Clone, Debug, PartialEq)]
pub struct RigSensor {
    /// Text that selects the driver of the sensor.
    pub driver: Setting<String>,
    /// Delay between a frame and its stamp, in ms; `None` uses the latency that the driver states.
    pub latency_ms: Option<Setting<f64>>,
    /// Standard uncertainty of `latency_ms`, in ms, measured by taps; `None` if unknown.
    pub latency_u_ms: Option<Setting<f64>>,
    /// True if ambient light cannot reach the camera; `None` if not stated. A scene must not state the opposite.
    pub opaque: Option<Setting<bool>>,
    /// True if the gel has markers; `None` if not stated. A scene must not state the opposite.
    pub markers: Option<Setting<bool>>,
    /// Outline of the sensing surface, seen from above; `None` if not stated. A scene may state a smaller outline.
    pub footprint: Option<Setting<FootprintSpec>>,
    /// Calibration certificate, if any.
    pub certificate: Option<Certificate>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table with `driver`")]
pub(super) struct WrittenSensor {
    driver: Setting<String>,
    latency_ms: Option<Setting<f64>>,
    latency_u_ms: Option<Setting<f64>>,
    opaque: Option<Setting<bool>>,
    markers: Option<Setting<bool>>,
    footprint: Option<Setting<FootprintSpec>>,
    certificate: Option<WrittenCertificate>,
}

impl WrittenSensor {
    pub(super) fn check(self, check: &Check<'_>) -> Result<RigSensor, SceneError> {
        if let Some(footprint) = &self.footprint
            && let Err(problem) = footprint.value.footprint(None)
        {
            return check.refuse(footprint.at(), problem);
        }
        Ok(RigSensor {
            driver: self.driver,
            latency_ms: check.latency(LATENCY, self.latency_ms)?,
            latency_u_ms: check.latency(UNCERTAINTY, self.latency_u_ms)?,
            opaque: self.opaque,
            markers: self.markers,
            footprint: self.footprint,
            certificate: check.certificate(Instrument::Sensor, self.certificate)?,
        })
    }
}
