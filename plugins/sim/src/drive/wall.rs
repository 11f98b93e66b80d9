//! Rig on wall-clock time, which passes independently of calls.
//!
//! Devices of a rig normally advance its clock. An emulated controller cannot do this, because time passes while clients connect and disconnect. In this mode,
//! the caller sets the time with [`advance`](SimulatedRig::advance).

use std::time::Duration;

use taceva_core::{FrameMut, Pose, Speed};

use super::rig::SimulatedRig;
use super::sensor::view;
use crate::bench::Bench;
use crate::optics::{AmbientLight, Camera, Luma, OpticsError};

impl SimulatedRig {
    /// Installs the gel of `bench` under the tip and removes the previous gel. Opens no sensor.
    pub fn lay(&self, bench: Bench) {
        self.state().lay(bench);
    }

    /// Begins a straight motion of the tip to `target`; [`advance`](SimulatedRig::advance) executes it.
    ///
    /// ```
    /// use std::time::Duration;
    /// use taceva_core::{Millimetre, Pose, Rig, Speed};
    /// use taceva_sim::SimulatedRig;
    /// let bench = SimulatedRig::of(&mut Rig::new(), "wall");
    /// let mut target = bench.pose_now();
    /// target.position.z = Millimetre(-18.0);
    /// bench.set_out(target, Speed::try_new(2.0)?);
    /// bench.advance(Duration::from_millis(500));
    /// // Approximate, because the robot has a position error of about 0.01 mm.
    /// assert!(bench.is_moving() && (bench.pose_now().position.z.0 + 19.0).abs() < 0.05);
    /// bench.advance(Duration::from_secs(2));
    /// assert_eq!((bench.is_moving(), bench.pose_now()), (false, target));
    /// # Ok::<(), taceva_core::SpeedError>(())
    /// ```
    pub fn set_out(&self, target: Pose, speed: Speed) {
        self.state().set_out(target.on_grid(), speed.mm_per_s());
    }

    /// Stops the motion in progress at the current place.
    pub fn stand(&self) {
        self.state().stand();
    }

    /// True while the tip moves.
    pub fn is_moving(&self) -> bool {
        self.state().is_moving()
    }

    /// Advances the clock to `until` and the tip along its motion. A time in the past has no effect.
    pub fn advance(&self, until: Duration) {
        self.state().advance(until);
    }

    /// Pose that the robot reports now.
    pub fn pose_now(&self) -> Pose {
        self.state().sent()
    }

    /// True position of the lowest point of the tip, in mm, z into the gel.
    pub fn tip_mm(&self) -> [f64; 3] {
        self.state().tip_mm()
    }

    /// Reads the transducer now, in N, without advancing the clock.
    pub fn read_now(&self) -> [f64; 3] {
        self.state().read()
    }

    /// Sets the tare to the mean of `readings` current readings, without advancing the clock: see [`Tare`](taceva_core::Tare).
    pub fn tare_now(&self, readings: u32) {
        self.state().tare(readings.max(1));
    }

    /// Sets the light around the sensor.
    pub fn light_now(&self, light: AmbientLight) {
        self.state().light = light;
    }

    /// Renders the current view of `camera` and returns its brightness.
    ///
    /// # Errors
    /// [`OpticsError`] if `into` is not a frame of that camera.
    pub fn render_now(&self, camera: &mut Camera, into: FrameMut<'_>) -> Result<Luma, OpticsError> {
        let view = view(&mut self.state(), camera.is_transparent());
        camera.render(&view, into)
    }
}
