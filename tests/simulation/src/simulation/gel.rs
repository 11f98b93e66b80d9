//! The gel and the instruments of a simulated rig.

/// The gel and the instruments of one seed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gel {
    pub(super) stiffness_n_mm: f64,
    /// Half the span of the noise of the transducer.
    pub(super) noise_n: f64,
    /// Half the span of what is called zero, where the host finds it from noisy readings.
    pub(super) zero_noise_n: f64,
    /// The force at which the transducer is at the end of its range.
    pub(super) saturation_n: f64,
    pub(super) normal_max_n: f64,
    /// Half the span of the noise of a reported pose along each axis, in mm.
    pub(super) pose_noise_mm: f64,
}

impl Gel {
    /// How far what is said of a force can be from it, in N.
    pub(super) fn force_error_n(&self) -> f64 {
        self.noise_n + self.zero_noise_n
    }

    /// The standard deviation of a reported pose along an axis: that of an even spread.
    pub(super) fn pose_deviation_mm(&self) -> f64 {
        self.pose_noise_mm / 3.0_f64.sqrt()
    }
}
