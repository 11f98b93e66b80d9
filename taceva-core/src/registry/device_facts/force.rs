//! Properties of a force transducer, known before it is opened.

use crate::driver::Axes;
use crate::quantity::{Hertz, Newton};

/// Properties of a force transducer. A property that the driver does not declare is `None`.
///
/// ```
/// use taceva_core::{Axes, ForceFacts, Hertz};
/// let facts = ForceFacts::default().with_axes(Axes::SIX).with_rate(Hertz(1000.0));
/// assert_eq!(facts.force_max, None);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ForceFacts {
    /// Components of force and torque that the transducer measures.
    pub axes: Axes,
    /// Number of readings per second.
    pub rate: Option<Hertz>,
    /// Greatest magnitude that the transducer can measure, for each force component.
    pub force_max: Option<Newton>,
    /// Standard deviation of the readings of one force component under a constant load.
    pub noise: Option<Newton>,
    /// Smallest difference between two unequal readings of force. Equal readings reveal a frozen signal only if this difference is below the noise.
    pub resolution: Option<Newton>,
    /// Delay between a measurement and the time stamp of its reading, ms. A run subtracts this delay from the time stamps.
    pub latency_ms: Option<f64>,
    /// True if each reading has a sequence number, see [`ForceTransducer::sequence`](crate::ForceTransducer::sequence).
    pub numbered: bool,
    /// True if the transducer can be set to zero under the present load.
    pub tare: bool,
}

impl ForceFacts {
    /// Sets [`axes`](ForceFacts::axes).
    #[must_use]
    pub fn with_axes(mut self, axes: Axes) -> ForceFacts {
        self.axes = axes;
        self
    }

    /// Sets [`rate`](ForceFacts::rate).
    #[must_use]
    pub fn with_rate(mut self, rate: impl Into<Option<Hertz>>) -> ForceFacts {
        self.rate = rate.into();
        self
    }

    /// Sets [`force_max`](ForceFacts::force_max).
    #[must_use]
    pub fn with_force_max(mut self, force_max: impl Into<Option<Newton>>) -> ForceFacts {
        self.force_max = force_max.into();
        self
    }

    /// Sets [`noise`](ForceFacts::noise).
    #[must_use]
    pub fn with_noise(mut self, noise: impl Into<Option<Newton>>) -> ForceFacts {
        self.noise = noise.into();
        self
    }

    /// Sets [`resolution`](ForceFacts::resolution).
    #[must_use]
    pub fn with_resolution(mut self, resolution: impl Into<Option<Newton>>) -> ForceFacts {
        self.resolution = resolution.into();
        self
    }

    /// Sets [`latency_ms`](ForceFacts::latency_ms).
    #[must_use]
    pub fn with_latency_ms(mut self, latency_ms: impl Into<Option<f64>>) -> ForceFacts {
        self.latency_ms = latency_ms.into();
        self
    }

    /// Sets [`numbered`](ForceFacts::numbered).
    #[must_use]
    pub fn with_numbered(mut self, numbered: bool) -> ForceFacts {
        self.numbered = numbered;
        self
    }

    /// Sets [`tare`](ForceFacts::tare).
    #[must_use]
    pub fn with_tare(mut self, tare: bool) -> ForceFacts {
        self.tare = tare;
        self
    }

    /// True if consecutive readings of a transducer without fault are rarely equal: its resolution is unknown or below its noise.
    ///
    /// ```
    /// use taceva_core::{ForceFacts, Newton};
    /// let mut scale = ForceFacts::default();
    /// assert!(scale.seldom_repeats());
    /// scale.resolution = Some(Newton(0.01));
    /// assert!(!scale.seldom_repeats());
    /// ```
    pub fn seldom_repeats(&self) -> bool {
        self.resolution
            .is_none_or(|step| self.noise.is_some_and(|noise| step.0 < noise.0))
    }
}
