//! Gel and instruments of a simulated rig.

/// Properties of the gel and of the instruments in the scenario of one seed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gel {
    pub(super) stiffness_n_mm: f64,
    /// Half the range of the transducer's noise, N.
    pub(super) noise_n: f64,
    /// Half the range of the zero error if the host determines the zero from noisy readings, N.
    pub(super) zero_noise_n: f64,
    /// Force at the end of the transducer's range, N.
    pub(super) saturation_n: f64,
    pub(super) normal_max_n: f64,
    /// Half the range of the noise of a reported pose, mm per axis.
    pub(super) pose_noise_mm: f64,
    /// Tilt of the surface: change of its height along x, mm per mm.
    pub(super) slope: f64,
}

impl Gel {
    /// Largest difference between a reading and the true force, N.
    pub(super) fn force_error_n(&self) -> f64 {
        self.noise_n + self.zero_noise_n
    }

    /// Standard deviation of a reported pose along an axis, mm, for uniform noise.
    pub(super) fn pose_deviation_mm(&self) -> f64 {
        self.pose_noise_mm / 3.0_f64.sqrt()
    }
}
