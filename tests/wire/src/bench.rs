//! Simulated gel in real time.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::time::{Duration, Instant};

use taceva_core::{FrameInfo, FrameMut, Pose, Rig, Speed};
use taceva_sim::optics::{AmbientLight, Bits, Camera, OpticsSpec};
use taceva_sim::{Bench, MountError, Mounted, SimulatedRig};

use crate::error::WireError;
use crate::fault::{Device, Fault, FaultKind, Faults};
use crate::options::BenchOptions;

/// A simulated gel in real time, shared by all its emulated devices.
#[derive(Clone, Debug)]
pub struct WallBench {
    inner: Arc<Inner>,
}

#[derive(Debug)]
struct Inner {
    rig: SimulatedRig,
    began: Instant,
    camera: Mutex<Camera>,
    truth: Mutex<Truth>,
    faults: Faults,
    options: BenchOptions,
}

/// True state of the bench, independent of the links.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Truth {
    /// Position of the tip in the sensor's frame, mm.
    pub tip_mm: [f64; 3],
    /// Force on the gel in the sensor's frame, N; 0 while a board is mounted.
    pub force_n: [f64; 3],
    /// Depth of a ball below the true surface of the gel, mm; 0 without contact, and while a board is mounted.
    pub depth_mm: f64,
    /// True while the tip moves.
    pub is_moving: bool,
    /// Length of the tip's path since the start of the bench, mm.
    pub way_mm: f64,
    /// Time for which the tip was in motion since the start of the bench.
    pub in_motion: Duration,
    /// Time at which the tip was last seen in motion, since the start of the bench.
    pub moved: Duration,
    /// Time of the last observation.
    looked: Duration,
    /// Greatest depth coordinate of the tip (z, into the gel) since the last reset, mm.
    pub deepest_mm: f64,
    /// Monitored limit of the normal force, N; `None` if no limit is monitored.
    pub limit_n: Option<f64>,
    /// Time at which the force first exceeded the limit, since the start of the bench; `None` before.
    pub passed: Option<Duration>,
    /// Depth of the tip at the time `passed`, mm; `None` before.
    pub passed_mm: Option<f64>,
    /// First time after `passed` at which the tip stood; `None` before.
    pub stopped: Option<Duration>,
}

/// Interval at which the gel is observed.
const TICK: Duration = Duration::from_millis(1);
/// Number of readings averaged when a box sets the load to zero.
const TARE_READINGS: u32 = 16;

impl WallBench {
    /// Starts a bench.
    ///
    /// # Errors
    /// [`WireError`] if the gel or its camera cannot be created, or no thread starts.
    pub fn start(options: &BenchOptions) -> Result<WallBench, WireError> {
        let parameters = options.parameters()?;
        let spec = OpticsSpec::new(&parameters);
        let size = spec.native.map(|side| (side / options.reduction).max(1));
        // Cameras send 8 bits.
        let mut camera = Camera::new(&spec, size, UNIT, options.seed)?.with_bits(Bits::Eight);
        camera.prepare();
        let rig = SimulatedRig::of(&mut Rig::new(), "wire");
        rig.lay(Bench::new(parameters, UNIT, options.seed));
        let truth = Truth {
            tip_mm: rig.tip_mm(),
            deepest_mm: f64::NEG_INFINITY,
            ..Truth::default()
        };
        let bench = WallBench {
            inner: Arc::new(Inner {
                rig,
                began: Instant::now(),
                camera: Mutex::new(camera),
                truth: Mutex::new(truth),
                faults: Faults::default(),
                options: options.clone(),
            }),
        };
        let watched = Arc::downgrade(&bench.inner);
        std::thread::Builder::new()
            .name("gel".to_owned())
            .spawn(move || watch(&watched))
            .map_err(WireError::Thread)?;
        Ok(bench)
    }

    /// Options of the bench.
    pub fn options(&self) -> &BenchOptions {
        &self.inner.options
    }

    /// Name of every emulated device, which shows a host that the device is simulated.
    pub fn serial(&self) -> String {
        format!("TACEVA-SIM{:04}", self.inner.options.seed % 10_000)
    }

    /// Advances the gel to the present, and returns the time since the start.
    pub fn now(&self) -> Duration {
        let now = self.inner.began.elapsed();
        self.inner.rig.advance(now);
        now
    }

    /// Starts a motion of the tip from its present position.
    pub(crate) fn set_out(&self, target: Pose, speed: Speed) {
        self.now();
        self.inner.rig.set_out(target, speed);
    }

    /// Ends the present motion at the present position.
    pub(crate) fn stand(&self) {
        self.now();
        self.inner.rig.stand();
    }

    pub(crate) fn is_moving(&self) -> bool {
        self.now();
        self.inner.rig.is_moving()
    }

    /// Pose of the tip as the robot measures it.
    pub(crate) fn pose(&self) -> Pose {
        self.now();
        self.inner.rig.pose_now()
    }

    /// Present reading of the transducer in the sensor's frame, N.
    pub(crate) fn reading_n(&self) -> [f64; 3] {
        self.now();
        self.inner.rig.read_now()
    }

    /// Sets the load to zero in the transducer itself.
    pub(crate) fn tare(&self) {
        self.now();
        self.inner.rig.tare_now(TARE_READINGS);
    }

    /// Measuring range of the transducer along each axis, N.
    pub fn force_range_n(&self) -> f64 {
        self.inner.options.model.parameters().transducer.range_n
    }

    /// Maximum depth of a press, mm, and its maximum force, N.
    pub(crate) fn limits(&self) -> [f64; 2] {
        let probing = self.inner.options.model.parameters().probing;
        [probing.depth_max_mm, probing.force_max_n]
    }

    /// Size and format of the camera's frames.
    pub fn frame_info(&self) -> FrameInfo {
        self.camera().frame_info()
    }

    /// Frame rate, Hz.
    pub fn frame_rate_hz(&self) -> f64 {
        self.inner.options.model.parameters().camera.rate_hz
    }

    /// Present picture of the camera.
    pub(crate) fn picture(&self) -> Result<Vec<u8>, WireError> {
        self.now();
        let mut camera = self.camera();
        let info = camera.frame_info();
        let mut pixels = vec![0; info.byte_len().unwrap_or_default()];
        let into = FrameMut::new(info, &mut pixels)
            .map_err(|error| WireError::Request(error.to_string()))?;
        self.inner.rig.render_now(&mut camera, into)?;
        Ok(pixels)
    }

    /// Changes the specimen on the robot.
    ///
    /// # Errors
    /// [`MountError::InContact`] while the tip is in the gel.
    pub fn mount(&self, specimen: Mounted) -> Result<(), MountError> {
        self.now();
        self.inner.rig.mount(specimen)
    }

    /// Sets the light around the sensor.
    pub fn light(&self, light: AmbientLight) {
        self.inner.rig.light_now(light);
    }

    /// Starts a fault of a link.
    pub fn inject(&self, fault: Fault) {
        self.inner.faults.put(fault);
    }

    /// Sets a known latency. Each message that `device` streams from now on arrives later by `lag`, in the same order. Streams of ATI boxes and of
    /// G-code machines ignore it.
    pub fn set_lag(&self, device: Device, lag: Duration) {
        self.inner.faults.set_lag(device, lag);
    }

    pub(crate) fn lag(&self, device: Device) -> Duration {
        self.inner.faults.lag(device)
    }

    pub(crate) fn is_faulty(&self, device: Device, kind: FaultKind) -> bool {
        self.inner.faults.is_on(device, kind)
    }

    pub(crate) fn withholds(&self, device: Device) -> bool {
        self.inner.faults.withholds(device)
    }

    pub(crate) fn delay(&self, device: Device) -> Duration {
        self.inner.faults.delay(device)
    }

    /// Present true state.
    pub fn truth(&self) -> Truth {
        self.inner.look();
        *self.inner.truth()
    }

    /// Resets the greatest depth and the exceeded limit, and monitors `limit_n` from now on.
    pub fn watch(&self, limit_n: Option<f64>) {
        let mut truth = self.inner.truth();
        truth.deepest_mm = f64::NEG_INFINITY;
        truth.limit_n = limit_n;
        (truth.passed, truth.passed_mm, truth.stopped) = (None, None, None);
    }

    fn camera(&self) -> MutexGuard<'_, Camera> {
        self.inner
            .camera
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }
}

/// Number of the nominal sensor unit.
const UNIT: u32 = 0;

impl Inner {
    fn truth(&self) -> MutexGuard<'_, Truth> {
        self.truth.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Advances the gel to the present time and records the true state.
    fn look(&self) {
        let now = self.began.elapsed();
        let mut truth = self.truth();
        self.rig.advance(now);
        let before = std::mem::replace(&mut truth.tip_mm, self.rig.tip_mm());
        let squares = [0, 1, 2].map(|axis| (truth.tip_mm[axis] - before[axis]).powi(2));
        let step_mm = squares.iter().sum::<f64>().sqrt();
        if step_mm > 0.0 {
            truth.way_mm += step_mm;
            truth.moved = now;
        }
        let since = std::mem::replace(&mut truth.looked, now);
        if truth.is_moving {
            truth.in_motion += now.saturating_sub(since);
        }
        truth.is_moving = self.rig.is_moving();
        let contact = self.rig.truth().unwrap_or_default();
        (truth.force_n, truth.depth_mm) = (contact.force_n, contact.depth_mm);
        truth.deepest_mm = truth.deepest_mm.max(truth.tip_mm[2]);
        let is_beyond = truth.limit_n.is_some_and(|limit| truth.force_n[2] > limit);
        if is_beyond && truth.passed.is_none() {
            truth.passed = Some(now);
            truth.passed_mm = Some(truth.tip_mm[2]);
        }
        if truth.passed.is_some() && truth.stopped.is_none() && !truth.is_moving {
            truth.stopped = Some(now);
        }
    }
}

/// Observes the gel every millisecond, until the bench is dropped.
fn watch(bench: &Weak<Inner>) {
    while let Some(inner) = bench.upgrade() {
        inner.look();
        drop(inner);
        std::thread::sleep(TICK);
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::Millimetre;

    use super::*;

    fn at_mm(z: f64) -> Pose {
        let mut pose = Pose::default();
        pose.position.z = Millimetre(z);
        pose
    }

    #[test]
    fn the_truth_says_when_a_limit_was_passed_and_when_the_tip_stood() {
        let bench = WallBench::start(&BenchOptions::quiet(3)).expect("a bench");
        bench.watch(Some(0.2));
        let speed = Speed::try_new(200.0).expect("above 0");
        bench.set_out(at_mm(0.5), speed);
        while bench.truth().passed.is_none() {
            std::thread::sleep(TICK);
        }
        bench.stand();
        let truth = bench.truth();
        assert!(!truth.is_moving && truth.stopped >= truth.passed);
        assert!(
            truth.force_n[2] > 0.2 && truth.deepest_mm > 0.0,
            "{truth:?}"
        );
        assert!(truth.depth_mm > 0.0 && truth.depth_mm < 0.6, "{truth:?}");
        assert!(truth.way_mm > 20.0 && truth.moved >= truth.passed.unwrap_or_default());
        std::thread::sleep(TICK);
        assert_eq!(bench.truth().moved, truth.moved, "it stands");
        bench.watch(None);
        assert_eq!(bench.truth().passed, None);
    }
}
