//! Simulated world: a tip that presses on a spring, and faults of calls to its devices.

use taceva_core::Fault;

use super::draws::Draws;
use super::fault::{FaultKind, Faults};
use super::gel::Gel;
use super::guard::Guard;
use super::oracle::{Ended, Oracle, SILENCE, TOO_HARD};
use taceva_protocol::Cancel;

/// Travel time of a call to a device, s each way.
const LINK_S: f64 = 0.000_5;
const SLOW_LINK_S: f64 = 0.004;
/// Delay of force readings in the buffers of a slow link, s; their stamps are correct.
const LAG_S: f64 = 0.015;
/// Interval between readings of the transducer, s.
const READING_S: f64 = 0.005;
/// Interval between frames, s.
const FRAME_S: f64 = 0.02;
/// Index of the random draws for pose noise, which separates them from force noise.
const POSE_NOISE: u64 = 8;
/// Age of readings with stale stamps, s.
const STALE_S: f64 = 0.12;

/// The last motion of the tip.
#[derive(Clone, Copy, Debug)]
struct Motion {
    from: [f64; 3],
    to: [f64; 3],
    start_s: f64,
    end_s: f64,
}

impl Motion {
    /// Position of the tip at the time `at_s`, s, in mm. Before the motion, it is the start; after the motion, the target.
    fn tip_at(&self, at_s: f64) -> [f64; 3] {
        if at_s >= self.end_s {
            return self.to;
        }
        let part = ((at_s - self.start_s) / (self.end_s - self.start_s)).max(0.0);
        [0, 1, 2].map(|axis| self.from[axis] + (self.to[axis] - self.from[axis]) * part)
    }
}

/// State of the simulated world.
pub(super) struct World {
    pub(super) now_s: f64,
    pub(super) tip: [f64; 3],
    motion: Motion,
    /// Place of contact, mm; `None` without contact. Depth is measured from the uneven surface at this place.
    touched: Option<[f64; 2]>,
    pub(super) halted: bool,
    /// True after the emergency stop was pressed, until a person acknowledges it.
    pub(super) stopped: bool,
    /// True if a call of the run was already rejected because of the emergency stop.
    has_noted_stop: bool,
    pub(super) gel: Gel,
    pub(super) oracle: Oracle,
    pub(super) faults: Faults,
    pub(super) cancel: Cancel,
    /// Monitoring threads, which get every reading during a motion.
    pub(super) guard: Option<Guard>,
    draws: Draws,
    readings: u64,
    poses: u64,
    zero_n: f64,
    last_force: Option<[f64; 3]>,
    /// True while the transducer repeats an old force.
    frozen: bool,
    /// Time since which a reading is awaited, s; `None` while the transducer gives readings.
    listening_s: Option<f64>,
    last_frame_s: f64,
    pub(super) sabotage: Sabotage,
}

/// Planted bug in the world or in the rig, which the oracle must find.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(not(test), expect(dead_code, reason = "mistakes are planted by tests"))]
pub(super) enum Sabotage {
    /// No bug.
    Nothing,
    /// The supervisor uses a force limit that is 1.5 times the limit of the rig.
    LooseLimits,
    /// Halts take too long.
    SlowHalt,
    /// The disk acknowledges data that it did not sync.
    LazyDisk,
    /// Frames have the current stamp and the previous picture.
    OldFrames,
    /// The thread that reads the enabling switch always finds it held.
    UnheededSwitch,
}

impl World {
    /// World with a parked tip, before the first event.
    pub(super) fn new(gel: Gel, oracle: Oracle, faults: Faults, draws: Draws) -> World {
        // Parked beside the gel and above it.
        let parked = [30.0, 5.0, -8.0];
        World {
            now_s: 0.0,
            tip: parked,
            motion: Motion {
                from: parked,
                to: parked,
                start_s: 0.0,
                end_s: 0.0,
            },
            touched: None,
            halted: false,
            stopped: false,
            has_noted_stop: false,
            gel,
            oracle,
            faults,
            cancel: Cancel::new(),
            guard: None,
            draws,
            readings: 0,
            poses: 0,
            zero_n: 0.0,
            last_force: None,
            frozen: false,
            listening_s: None,
            last_frame_s: 0.0,
            sabotage: Sabotage::Nothing,
        }
    }

    /// Advances time.
    pub(super) fn pass(&mut self, seconds: f64) {
        self.now_s += seconds;
        self.oracle.passed(self.now_s);
    }

    /// Ends a halt, and resets the time of missing readings.
    pub(super) fn release(&mut self) {
        self.halted = false;
        self.listening_s = None;
    }

    /// Rejects calls that move or release the robot while the emergency stop holds. A second request after a rejection is a violation.
    pub(super) fn obey(&mut self, asked: &'static str) -> Result<(), Fault> {
        if !self.is_stopped() {
            return Ok(());
        }
        if std::mem::replace(&mut self.has_noted_stop, true) {
            self.oracle.defied(asked);
        }
        Err(Fault::EmergencyStop)
    }

    /// A person acknowledges an emergency stop at the robot.
    pub(super) fn acknowledge(&mut self) {
        (self.stopped, self.has_noted_stop) = (false, false);
    }

    /// Position of the tip as the robot reports it.
    pub(super) fn reported(&mut self) -> [f64; 3] {
        self.poses += 1;
        let noise = |axis: u64| {
            let part = self.draws.fraction([self.poses, POSE_NOISE + axis]);
            self.gel.pose_noise_mm * (2.0 * part - 1.0)
        };
        let noise = [noise(0), noise(1), noise(2)];
        [0, 1, 2].map(|axis| self.tip[axis] + noise[axis])
    }

    /// A person brings the tip above the gel.
    pub(super) fn lift(&mut self) {
        self.tip[2] = -2.0;
        self.touched = None;
        let (tip, now_s) = (self.tip, self.now_s);
        self.motion = Motion {
            from: tip,
            to: tip,
            start_s: now_s,
            end_s: now_s,
        };
    }

    /// Requires a halt of the robot from `since_s` on, unless it is halted already.
    pub(super) fn hazard(&mut self, hazard: &'static str, since_s: f64) {
        if !self.halted {
            self.oracle.hazard(hazard, since_s);
        }
    }

    /// Advances time by the delay of a request or of an answer.
    pub(super) fn link(&mut self) {
        let slow = self.faults.strike(FaultKind::SlowLink, self.now_s);
        self.pass(if slow { SLOW_LINK_S } else { LINK_S });
    }

    /// Height of the gel at a place, mm: slightly uneven, and tilted by its slope.
    pub(super) fn surface(&self, [x, y]: [f64; 2]) -> f64 {
        0.1 + 0.05 * (0.7 * x).sin() * (0.9 * y).cos() + self.gel.slope * x
    }

    /// True indentation with the tip at a position, mm.
    pub(super) fn depth(&self, [x, y, z]: [f64; 3]) -> f64 {
        (z - self.surface([x, y])).max(0.0)
    }

    /// True normal force with the tip at a position, N.
    pub(super) fn force(&self, tip: [f64; 3]) -> f64 {
        self.gel.stiffness_n_mm * self.depth(tip)
    }

    /// Moves the tip along a line.
    pub(super) fn glide(&mut self, target: [f64; 3], speed_mm_s: f64) {
        let from = self.tip;
        let seconds = self.way_to(target) / speed_mm_s;
        let start_s = self.now_s;
        let indented_mm = self.depth(from);
        let stuck = self.faults.strike(FaultKind::StuckRobot, start_s);
        if !stuck {
            let (before, after) = (self.force(from), self.force(target));
            // Beyond the noise, the next reading must show it.
            let bound = self.gel.normal_max_n + self.gel.force_error_n();
            let passes = after > before && after > bound;
            if passes && self.frozen {
                self.oracle.overlooked();
            } else if passes {
                let part = ((bound - before) / (after - before)).max(0.0);
                self.hazard(TOO_HARD, start_s + part * seconds);
            }
            self.tip = target;
        }
        self.pass(seconds);
        self.motion = Motion {
            from,
            to: self.tip,
            start_s,
            end_s: self.now_s,
        };
        let [x, y, z] = self.tip;
        let is_inward = self.depth(self.tip) > indented_mm;
        self.touched = (self.depth(self.tip) > 0.0).then_some(self.touched.unwrap_or([x, y]));
        let depth_mm = self.touched.map_or(0.0, |place| z - self.surface(place));
        self.oracle.moved(Ended {
            depth_mm,
            force_n: self.force(self.tip),
            is_inward,
            is_frozen: self.frozen,
        });
    }

    /// Waits for the next reading of force; `None` if none comes within `deadline_s`.
    pub(super) fn read_force(&mut self, deadline_s: f64) -> Option<([f64; 3], f64)> {
        if self.faults.strike(FaultKind::Silence, self.now_s) {
            let listening_s = *self.listening_s.get_or_insert(self.now_s);
            // The force is unknown until the next reading; the tip rests meanwhile.
            self.oracle.blinded();
            self.hazard(SILENCE, listening_s + STALE_AFTER_S);
            self.pass(deadline_s);
            return None;
        }
        let next_s = ((self.now_s / READING_S).floor() + 1.0) * READING_S;
        self.pass(next_s - self.now_s);
        Some(self.sense())
    }

    /// Records that there was no reading since `since_s`, s. A halt is required when readings have been missing for too long.
    pub(super) fn missed(&mut self, since_s: f64) {
        let listening_s = *self.listening_s.get_or_insert(since_s);
        self.oracle.blinded();
        self.hazard(SILENCE, listening_s + STALE_AFTER_S);
    }

    /// Present reading of the transducer, and the time at which it was true.
    fn sense(&mut self) -> ([f64; 3], f64) {
        self.listening_s = None;
        self.oracle.heard();
        self.readings += 1;
        let noise = |axis: u64| {
            let part = self.draws.fraction([self.readings, axis]);
            self.gel.noise_n * (2.0 * part - 1.0)
        };
        let is_slow = self.faults.strike(FaultKind::SlowLink, self.now_s);
        let mut valid_s = self.now_s - if is_slow { LAG_S } else { 0.0 };
        let normal = self.force(self.motion.tip_at(valid_s)) - self.zero_n;
        let mut force = [noise(0), noise(1), normal + noise(2)];
        self.frozen = self.faults.strike(FaultKind::Freeze, self.now_s);
        if let (true, Some(last)) = (self.frozen, self.last_force) {
            force = last;
        }
        if self.frozen {
            self.oracle.blinded();
        } else if valid_s >= self.motion.end_s && self.oracle.sighted() {
            self.hazard(TOO_HARD, self.now_s);
        }
        self.last_force = Some(force);
        if self.faults.strike(FaultKind::NotANumber, self.now_s) {
            force[2] = f64::NAN;
            self.hazard("a NaN reading", self.now_s);
        }
        if self.faults.strike(FaultKind::Saturation, self.now_s) {
            force[2] = self.gel.saturation_n;
            self.hazard("a saturated reading", self.now_s);
        }
        if self.faults.strike(FaultKind::StaleStamps, self.now_s) {
            valid_s -= STALE_S;
            self.hazard("an old reading", self.now_s);
        }
        (force, valid_s)
    }

    /// Reading for a thread; `None` from a silent transducer. During a motion, silence is a hazard.
    pub(super) fn overhear(&mut self, is_moving: bool) -> Option<([f64; 3], f64)> {
        if self.faults.strike(FaultKind::Silence, self.now_s) {
            self.oracle.blinded();
            if is_moving {
                let listening_s = *self.listening_s.get_or_insert(self.now_s);
                self.hazard(SILENCE, listening_s + STALE_AFTER_S);
            }
            return None;
        }
        Some(self.sense())
    }

    /// Starts a motion, and restarts the time without a reading.
    pub(super) fn set_out(&mut self) {
        self.listening_s = None;
    }

    /// True once the emergency stop was pressed.
    pub(super) fn is_stopped(&mut self) -> bool {
        self.stopped |= self
            .faults
            .strike_once(FaultKind::EmergencyStop, self.now_s);
        self.stopped
    }

    /// End time of a motion to `target` that begins now, s.
    pub(super) fn arrival_s(&self, target: [f64; 3], speed_mm_s: f64) -> f64 {
        self.now_s + self.way_to(target) / speed_mm_s
    }

    /// Position at the time `at_s`, s, in a motion to `target` that begins now, mm. After the motion, the position is `target`.
    pub(super) fn on_way(&self, target: [f64; 3], speed_mm_s: f64, at_s: f64) -> [f64; 3] {
        let length_mm = self.way_to(target);
        let step_mm = speed_mm_s * (at_s - self.now_s).max(0.0);
        if length_mm <= step_mm {
            return target;
        }
        let part = step_mm / length_mm;
        [0, 1, 2].map(|axis| self.tip[axis] + (target[axis] - self.tip[axis]) * part)
    }

    fn way_to(&self, target: [f64; 3]) -> f64 {
        let squares = [0, 1, 2].map(|axis| (target[axis] - self.tip[axis]).powi(2));
        squares.iter().sum::<f64>().sqrt()
    }

    /// Sets the present load as zero.
    pub(super) fn tare(&mut self) {
        self.zero_n = self.force(self.tip);
    }

    /// Time until the next frame arrives, and its exposure time, s. The exposure time is `None` if the frame does not arrive in time.
    pub(super) fn expose(&mut self, deadline_s: f64) -> (f64, Option<f64>) {
        if self.faults.strike(FaultKind::DroppedFrames, self.now_s) {
            // Every second frame arrives, with the previous picture.
            return match self.readings.is_multiple_of(2) {
                true => (FRAME_S, Some(self.last_frame_s)),
                false => (deadline_s, None),
            };
        }
        let next_s = ((self.now_s / FRAME_S).floor() + 1.0) * FRAME_S;
        self.last_frame_s = next_s;
        (next_s - self.now_s, Some(next_s))
    }
}

/// Time without a reading after which a halt is required, s.
const STALE_AFTER_S: f64 = taceva_protocol::STALE_S;
