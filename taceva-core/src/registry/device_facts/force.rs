//! Facts about a force transducer before it is opened.

use crate::driver::Axes;
use crate::quantity::{Hertz, Newton};

/// Facts about a force transducer. Undeclared facts are `None`.
///
/// ```
/// use taceva_core::{Axes, ForceFacts, Hertz};
/// let facts = ForceFacts::default().with_axes(Axes::SIX).with_rate(Hertz(1000.0));
/// assert_eq!(facts.force_max, None);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ForceFacts {
    /// Components that the transducer measures.
    pub axes: Axes,
    /// Readings per second.
    pub rate: Option<Hertz>,
    /// Greatest measurable magnitude of each force.
    pub force_max: Option<Newton>,
    /// Noise of the readings under a constant load: one standard deviation per component.
    pub noise: Option<Newton>,
    /// Step between two neighbouring force readings. Equal readings reveal a frozen signal only if the step is below the noise.
    pub resolution: Option<Newton>,
    /// Delay from the measurement to the stamp of a reading, ms. A run subtracts this delay from the stamps; 0 needs no correction.
    pub latency_ms: Option<f64>,
    /// True if the transducer numbers its readings, see [`ForceTransducer::sequence`](crate::ForceTransducer::sequence).
    pub numbered: bool,
    /// True if the transducer can take the present load as zero.
    pub tare: bool,
}

impl ForceFacts {
    /// The same facts with another [`axes`](ForceFacts::axes).
    #[must_use]
    pub fn with_axes(mut self, axes: Axes) -> ForceFacts {
        self.axes = axes;
        self
    }

    /// The same facts with another [`rate`](ForceFacts::rate).
    #[must_use]
    pub fn with_rate(mut self, rate: impl Into<Option<Hertz>>) -> ForceFacts {
        self.rate = rate.into();
        self
    }

    /// The same facts with another [`force_max`](ForceFacts::force_max).
    #[must_use]
    pub fn with_force_max(mut self, force_max: impl Into<Option<Newton>>) -> ForceFacts {
        self.force_max = force_max.into();
        self
    }

    /// The same facts with another [`noise`](ForceFacts::noise).
    #[must_use]
    pub fn with_noise(mut self, noise: impl Into<Option<Newton>>) -> ForceFacts {
        self.noise = noise.into();
        self
    }

    /// The same facts with another [`resolution`](ForceFacts::resolution).
    #[must_use]
    pub fn with_resolution(mut self, resolution: impl Into<Option<Newton>>) -> ForceFacts {
        self.resolution = resolution.into();
        self
    }

    /// The same facts with another [`latency_ms`](ForceFacts::latency_ms).
    #[must_use]
    pub fn with_latency_ms(mut self, latency_ms: impl Into<Option<f64>>) -> ForceFacts {
        self.latency_ms = latency_ms.into();
        self
    }

    /// The same facts with another [`numbered`](ForceFacts::numbered).
    #[must_use]
    pub fn with_numbered(mut self, numbered: bool) -> ForceFacts {
        self.numbered = numbered;
        self
    }

    /// The same facts with another [`tare`](ForceFacts::tare).
    #[must_use]
    pub fn with_tare(mut self, tare: bool) -> ForceFacts {
        self.tare = tare;
        self
    }

    /// True if consecutive readings of a working transducer are rarely equal: the resolution, if known, is below the noise.
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
