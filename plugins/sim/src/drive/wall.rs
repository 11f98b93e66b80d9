//! A rig whose time is that of a clock on the wall: it passes whether anybody waits or not.
//!
//! Devices that are opened from a rig turn its clock themselves. An emulated controller cannot: its clients come and go while time
//! passes. Here time is a value, [`advance`](SimulatedRig::advance), and everything else is as it is at that moment.

use std::time::Duration;

use taceva_core::{FrameMut, Pose, Speed};

use super::rig::SimulatedRig;
use super::sensor::view;
use crate::bench::Bench;
use crate::optics::{AmbientLight, Camera, Luma, OpticsError};

impl SimulatedRig {
    /// Puts the gel of `bench` under the tip, in the place of the last one; no sensor is opened for it.
    pub fn lay(&self, bench: Bench) {
        self.state().lay(bench);
    }

    /// Begins to move the tip to `target` along a straight line, from where it is; [`advance`](SimulatedRig::advance) makes the way.
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
    /// // Nearly: the robot stands beside its targets by some 0.01 mm.
    /// assert!(bench.is_moving() && (bench.pose_now().position.z.0 + 19.0).abs() < 0.05);
    /// bench.advance(Duration::from_secs(2));
    /// assert_eq!((bench.is_moving(), bench.pose_now()), (false, target));
    /// # Ok::<(), taceva_core::SpeedError>(())
    /// ```
    pub fn set_out(&self, target: Pose, speed: Speed) {
        self.state().set_out(target.on_grid(), speed.mm_per_s());
    }

    /// Ends the motion that is under way, where the tip is at this moment.
    pub fn stand(&self) {
        self.state().stand();
    }

    /// Whether the tip is on its way.
    pub fn is_moving(&self) -> bool {
        self.state().is_moving()
    }

    /// Lets time pass until `until` on the rig's clock, and the tip go on along its way; a time that has passed changes nothing.
    pub fn advance(&self, until: Duration) {
        self.state().advance(until);
    }

    /// Where the robot believes that the tip is at this moment.
    pub fn pose_now(&self) -> Pose {
        self.state().sent()
    }

    /// Where the lowest point of the tip truly is at this moment, in mm, z into the gel.
    pub fn tip_mm(&self) -> [f64; 3] {
        self.state().tip_mm()
    }

    /// What the transducer says at this moment, in N: a reading, which takes no time.
    pub fn read_now(&self) -> [f64; 3] {
        self.state().read()
    }

    /// Calls the mean of `readings` of this moment zero: see [`Tare`](taceva_core::Tare). It takes no time.
    pub fn tare_now(&self, readings: u32) {
        self.state().tare(readings.max(1));
    }

    /// Sets the light around the sensor.
    pub fn light_now(&self, light: AmbientLight) {
        self.state().light = light;
    }

    /// Draws what `camera` sees at this moment, and says how bright it is.
    ///
    /// # Errors
    /// [`OpticsError`] if `into` is not a frame of that camera.
    pub fn render_now(&self, camera: &mut Camera, into: FrameMut<'_>) -> Result<Luma, OpticsError> {
        let view = view(&mut self.state(), camera.is_transparent());
        camera.render(&view, into)
    }
}
