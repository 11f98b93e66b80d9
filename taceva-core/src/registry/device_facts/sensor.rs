//! Facts about a sensor before it is opened.

use crate::footprint::Footprint;
use crate::frame::FrameInfo;
use crate::quantity::{Hertz, Millimetre, Newton};

/// Facts that a driver declares about a sensor. An undeclared fact is `None`.
///
/// ```
/// use taceva_core::{Footprint, Millimetre, SensorFacts};
/// let facts = SensorFacts::default().with_footprint(Footprint::disc(17.0, Some(3.5))?);
/// assert_eq!(facts.depth_limit(), Some(Millimetre(3.5)));
/// # Ok::<(), taceva_core::FootprintError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct SensorFacts {
    /// Size and format of the camera frames; `None` if they depend on the driver's arguments or on a replayed recording.
    pub frame: Option<FrameInfo>,
    /// Frames per second.
    pub rate: Option<Hertz>,
    /// True if the gel blocks ambient light from the camera.
    pub opaque: Option<bool>,
    /// True if markers in the gel show its shear.
    pub markers: Option<bool>,
    /// Lighting scenes that the sensor itself can set; empty for an opaque gel.
    pub scenes: Vec<String>,
    /// Outline of the sensing surface in top view, with the greatest indentation of this surface.
    pub footprint: Option<Footprint>,
    /// Greatest allowed indentation, at most the indentation that the footprint states.
    pub depth_max: Option<Millimetre>,
    /// Greatest normal force of a press.
    pub force_max: Option<Newton>,
    /// Pixels of the camera along x and y, before scaling.
    pub camera: Option<[u32; 2]>,
    /// Thickness of the gel.
    pub gel_thickness: Option<Millimetre>,
    /// Area of the sensing surface in the view of the camera, mm².
    pub field_of_view_mm2: Option<f64>,
    /// Delay from the capture of a frame to its time stamp, ms. A run subtracts this delay from the stamps.
    pub latency_ms: Option<f64>,
}

impl SensorFacts {
    /// The same facts with the given [`frame`](SensorFacts::frame).
    #[must_use]
    pub fn with_frame(mut self, frame: impl Into<Option<FrameInfo>>) -> SensorFacts {
        self.frame = frame.into();
        self
    }

    /// The same facts with the given [`rate`](SensorFacts::rate).
    #[must_use]
    pub fn with_rate(mut self, rate: impl Into<Option<Hertz>>) -> SensorFacts {
        self.rate = rate.into();
        self
    }

    /// The same facts with the given [`opaque`](SensorFacts::opaque).
    #[must_use]
    pub fn with_opaque(mut self, opaque: impl Into<Option<bool>>) -> SensorFacts {
        self.opaque = opaque.into();
        self
    }

    /// The same facts with the given [`markers`](SensorFacts::markers).
    #[must_use]
    pub fn with_markers(mut self, markers: impl Into<Option<bool>>) -> SensorFacts {
        self.markers = markers.into();
        self
    }

    /// The same facts with the given [`scenes`](SensorFacts::scenes).
    #[must_use]
    pub fn with_scenes(mut self, scenes: Vec<String>) -> SensorFacts {
        self.scenes = scenes;
        self
    }

    /// The same facts with the given [`footprint`](SensorFacts::footprint).
    #[must_use]
    pub fn with_footprint(mut self, footprint: impl Into<Option<Footprint>>) -> SensorFacts {
        self.footprint = footprint.into();
        self
    }

    /// The same facts with the given [`depth_max`](SensorFacts::depth_max).
    #[must_use]
    pub fn with_depth_max(mut self, depth_max: impl Into<Option<Millimetre>>) -> SensorFacts {
        self.depth_max = depth_max.into();
        self
    }

    /// The same facts with the given [`force_max`](SensorFacts::force_max).
    #[must_use]
    pub fn with_force_max(mut self, force_max: impl Into<Option<Newton>>) -> SensorFacts {
        self.force_max = force_max.into();
        self
    }

    /// The same facts with the given [`camera`](SensorFacts::camera).
    #[must_use]
    pub fn with_camera(mut self, camera: impl Into<Option<[u32; 2]>>) -> SensorFacts {
        self.camera = camera.into();
        self
    }

    /// The same facts with the given [`gel_thickness`](SensorFacts::gel_thickness).
    #[must_use]
    pub fn with_gel_thickness(
        mut self,
        gel_thickness: impl Into<Option<Millimetre>>,
    ) -> SensorFacts {
        self.gel_thickness = gel_thickness.into();
        self
    }

    /// The same facts with the given [`field_of_view_mm2`](SensorFacts::field_of_view_mm2).
    #[must_use]
    pub fn with_field_of_view_mm2(
        mut self,
        field_of_view_mm2: impl Into<Option<f64>>,
    ) -> SensorFacts {
        self.field_of_view_mm2 = field_of_view_mm2.into();
        self
    }

    /// The same facts with the given [`latency_ms`](SensorFacts::latency_ms).
    #[must_use]
    pub fn with_latency_ms(mut self, latency_ms: impl Into<Option<f64>>) -> SensorFacts {
        self.latency_ms = latency_ms.into();
        self
    }

    /// Greatest allowed indentation: [`depth_max`](SensorFacts::depth_max), or the indentation that the footprint states.
    pub fn depth_limit(&self) -> Option<Millimetre> {
        let footprint = self.footprint.and_then(|footprint| footprint.depth_max());
        self.depth_max
            .or(footprint.map(|depth| Millimetre(depth.to_millimetres())))
    }
}
