//! Emulated robot, gel and force transducer. They count as real devices and run in real time.

use std::sync::{Arc, Mutex, MutexGuard};
use std::time::Duration;

use taceva_core::{ErrorKind, Millimetre, Point, Pose};
use taceva_drivers::MonotonicClock;

/// Stiffness of the gel, in N/mm. The surface is at height 0.
const STIFFNESS_N_MM: f64 = 0.5;
/// Position of the tip at the start, in mm.
const HOME_MM: [f64; 3] = [0.0, 0.0, -2.0];

/// State of the emulated rig, shared by its devices and the test.
#[derive(Clone)]
pub(crate) struct World(Arc<Mutex<State>>);

pub(crate) struct State {
    /// Start and end of the current motion, in mm.
    way: [[f64; 3]; 2],
    /// Times of the start and end of the current motion, in s.
    span_s: [f64; 2],
    pub(crate) is_halted: bool,
    pub(crate) motions: u32,
    /// Number of force readings that were returned.
    pub(crate) readings: u64,
    /// Number of force readings that are still to be withheld.
    pub(crate) withheld: u32,
    pub(crate) deepest_mm: f64,
    /// Number of halts of the robot.
    pub(crate) halts: usize,
    /// Times of the halts, in s.
    halted_s: Vec<f64>,
    /// Delay of the answer to the next halt.
    pub(crate) answer_delay: Duration,
    /// Greatest x without an obstacle, in mm. Beyond this x, an obstacle in the air presses the tip with 1 N.
    pub(crate) obstacle_x_mm: f64,
    /// Time at which the tip first reached the obstacle, in s.
    pub(crate) struck_s: Option<f64>,
    /// True if the emergency stop is pressed.
    pub(crate) is_stopped: bool,
    /// True if the robot reports no pose, because its cable is unplugged.
    pub(crate) is_lost: bool,
    /// True if the robot reports that it is emulated.
    pub(crate) is_emulated: bool,
    /// Number of motions and releases that were requested after the robot had reported its emergency stop.
    pub(crate) defied: u32,
    told: bool,
    /// True if a person holds the enabling switch.
    pub(crate) is_held: bool,
    pub(crate) is_unplugged: bool,
    /// Error that the camera returns instead of a frame, if any.
    pub(crate) camera: Option<ErrorKind>,
    /// Number of frames that the camera returned.
    pub(crate) pictures: u32,
    /// Last frame in contact, which a frozen camera repeats.
    pub(crate) touched: [u8; 4],
    pub(crate) is_frozen: bool,
    /// Fault of the changer.
    pub(crate) changer: Misfortune,
    /// Changes of the changer: item, height of the tip in mm, if the robot was halted, and if the tip stayed still.
    pub(crate) changes: Vec<(String, f64, bool, bool)>,
    /// Every light that was set: name of its light scene, and height of the tip in mm at this time.
    pub(crate) lights: Vec<(String, f64)>,
}

/// Faults that a test changer can have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Misfortune {
    None,
    Fails,
    Hangs,
    Vanishes,
    BringsAnother,
}

impl World {
    pub(crate) fn new() -> World {
        World(Arc::new(Mutex::new(State {
            way: [HOME_MM; 2],
            span_s: [0.0; 2],
            is_halted: false,
            motions: 0,
            readings: 0,
            withheld: 0,
            deepest_mm: 0.0,
            halts: 0,
            halted_s: Vec::new(),
            answer_delay: Duration::ZERO,
            obstacle_x_mm: f64::INFINITY,
            struck_s: None,
            is_stopped: false,
            is_lost: false,
            is_emulated: false,
            defied: 0,
            told: false,
            is_held: true,
            is_unplugged: false,
            camera: None,
            pictures: 0,
            touched: [60, 90, 0, 0],
            is_frozen: false,
            changer: Misfortune::None,
            changes: Vec::new(),
            lights: Vec::new(),
        })))
    }

    pub(crate) fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().expect("nobody panics with it")
    }

    /// Moves the tip, and waits until it rests. Returns true if the tip arrived.
    pub(crate) fn travel(&self, to: [f64; 3], speed_mm_s: f64) -> bool {
        let until_s = {
            let mut state = self.state();
            if state.is_halted {
                return false;
            }
            let now_s = MonotonicClock.now_s();
            let from = state.tip(now_s);
            let way_mm = [0, 1, 2].map(|axis| (to[axis] - from[axis]).powi(2));
            let seconds = way_mm.iter().sum::<f64>().sqrt() / speed_mm_s;
            state.way = [from, to];
            state.span_s = [now_s, now_s + seconds];
            state.motions += 1;
            now_s + seconds
        };
        loop {
            let left_s = until_s - MonotonicClock.now_s();
            let state = self.state();
            if state.is_halted || state.is_stopped {
                return false;
            }
            if left_s <= 0.0 {
                return true;
            }
            drop(state);
            std::thread::sleep(Duration::from_secs_f64(left_s.min(0.001)));
        }
    }

    pub(crate) fn halt(&self) {
        let mut state = self.state();
        state.stand();
        state.is_halted = true;
        state.halts += 1;
        state.halted_s.push(MonotonicClock.now_s());
        let delay = std::mem::take(&mut state.answer_delay);
        drop(state);
        std::thread::sleep(delay);
    }

    /// Presses the emergency stop.
    pub(crate) fn stop(&self) {
        let mut state = self.state();
        state.stand();
        state.is_stopped = true;
    }
}

impl State {
    /// Time of the first halt at or after `time_s`, in s.
    pub(crate) fn first_halt_after(&self, time_s: f64) -> f64 {
        let mut later = self.halted_s.iter().filter(|halted_s| **halted_s >= time_s);
        *later.next().expect("it was halted")
    }

    /// True if a motion is in progress: it began more than `since_s` before `now_s`, and does not end shortly.
    pub(crate) fn is_amid_motion(&self, now_s: f64, since_s: f64) -> bool {
        const LEFT_S: f64 = 0.005;
        let [begin_s, end_s] = self.span_s;
        !self.is_halted && now_s > begin_s + since_s && now_s + LEFT_S < end_s
    }

    fn stand(&mut self) {
        self.way = [self.tip(MonotonicClock.now_s()); 2];
    }

    pub(crate) fn tip(&self, now_s: f64) -> [f64; 3] {
        let [from, to] = self.way;
        let [begin_s, end_s] = self.span_s;
        if now_s >= end_s {
            return to;
        }
        let part = (now_s - begin_s) / (end_s - begin_s);
        [0, 1, 2].map(|axis| from[axis] + (to[axis] - from[axis]) * part)
    }

    /// Force on the tip at `now_s`, without noise, in N.
    pub(crate) fn force_n(&mut self, now_s: f64) -> f64 {
        let [x, _, z] = self.tip(now_s);
        self.deepest_mm = self.deepest_mm.max(z);
        if x > self.obstacle_x_mm {
            let [from, to] = self.way.map(|place| place[0]);
            let [begin_s, end_s] = self.span_s;
            let part = (self.obstacle_x_mm - from) / (to - from);
            self.struck_s
                .get_or_insert(begin_s + part * (end_s - begin_s));
            return 1.0;
        }
        STIFFNESS_N_MM * z.max(0.0)
    }

    /// True if the robot rejects motions because the emergency stop is pressed.
    pub(crate) fn refuses(&mut self) -> bool {
        if self.is_stopped {
            self.defied += u32::from(std::mem::replace(&mut self.told, true));
        }
        self.is_stopped
    }
}

pub(crate) fn pose([x, y, z]: [f64; 3]) -> Pose {
    let [x, y, z] = [x, y, z].map(Millimetre);
    Pose {
        position: Point { x, y, z },
        ..Pose::default()
    }
}
