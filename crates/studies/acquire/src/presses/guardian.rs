//! Guard threads of a run on real devices. They detect limits that are exceeded during a motion.
//!
//! One thread owns the force transducer: it shows each reading to the [`Supervisor`] and stores it for the run. Another thread reads the pose of the
//! robot, over a second connection if the robot has one, and the enabling switch. This thread also watches for missing readings and cancellation.
//! Both threads halt through the supervisor, which makes all decisions.
//!
//! The threads have the priority of the process. On a busy machine, a thread may wait for a tenth of a second. `chrt -f 10 taceva run …` reduces this
//! wait to milliseconds. A turn is one reading by a thread. The program prints each late turn and each late halt with its cause, and their counts
//! when the session ends.

mod causes;
mod halt_counts;
mod halts;
mod mailbox;
mod misses;
mod punctuality;
mod thread_facts;
mod turn;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use taceva_core::{
    Deadline, DriverKey, EnablingSwitch, ForceTransducer, Pose, Progress, Robot, RobotWatch, Stamp,
};
use taceva_drivers::MonotonicClock;
use taceva_protocol::{
    Cancel, Enabling, Observation, RigLimits, SharedSupervisor, Supervisor, Trip,
};

use crate::viewer::Viewer;
use halts::{HaltCall, HaltCalls, HaltFollower, Held, TimedHalt};
use mailbox::{Listeners, Mailbox};
use punctuality::Punctuality;
use turn::{Turn, TurnTimer};

/// Interval between pose readings; each reading then waits for the next report. An interval of 10 ms would miss every second report of an arm that
/// reports every 10 ms. Detecting a frozen signal takes eight readings, each after a motion.
const LOOK: Duration = Duration::from_millis(5);
/// Deadline for each pose.
const LOOK_DEADLINE: Deadline = Deadline::after(Duration::from_millis(20));

/// Greatest distance of two poses of a robot at rest, as a multiple of the noise of a pose.
const POSE_NOISES: f64 = 5.0;

/// Guarded devices, and the cancellation of their run.
pub(super) struct Guarded<'a> {
    pub(super) robot: &'a mut dyn Robot,
    pub(super) force: &'a mut dyn ForceTransducer,
    /// Key of the transducer's driver.
    pub(super) driver: DriverKey,
    pub(super) limits: RigLimits,
    /// Enabling switch, if the rig has a switch.
    pub(super) switch: Option<&'a dyn EnablingSwitch>,
    pub(super) cancel: &'a Cancel,
    pub(super) progress: &'a dyn Progress,
    /// Viewer that receives every force and pose, if any.
    pub(super) viewer: Option<&'a dyn Viewer>,
}

impl Guarded<'_> {
    /// Calls the closure `conduct`, which moves the robot, while guard threads watch. The threads end when `conduct` returns. Returns the result of
    /// `conduct`, and a warning if halts were late.
    pub(super) fn conduct<T>(
        self,
        conduct: impl FnOnce(&mut dyn Robot, &mut dyn ForceTransducer, SharedSupervisor) -> T,
    ) -> (T, Option<String>) {
        let Guarded {
            robot,
            force,
            driver,
            limits,
            switch,
            cancel,
            progress,
            viewer,
        } = self;
        let halts = Arc::new(HaltCalls::default());
        let slack_mm = POSE_NOISES * limits.signals.pose_noise_mm;
        let halt = TimedHalt::new(robot.halt_handle(), Arc::clone(&halts));
        let mut supervisor = Supervisor::new(limits, Arc::new(halt));
        if switch.is_some() {
            // State before the first reading of the switch.
            supervisor.enabling(Enabling::Released);
        }
        let supervisor = SharedSupervisor::new(supervisor);
        let (mailbox, reader) = Mailbox::of(force, driver);
        let punctuality = Punctuality::new(progress);
        let watcher = Watcher {
            supervisor: &supervisor,
            punctuality: &punctuality,
            was_under_way: false,
            was_stale: false,
            halts,
            follower: HaltFollower::new(slack_mm),
            watch: robot.watch_handle(),
            last: None,
            switch,
            cancel,
            progress,
            viewer,
            was_cancelled: false,
        };
        let is_over = AtomicBool::new(false);
        let conducted = std::thread::scope(|scope| {
            let listeners = Listeners {
                supervisor: &supervisor,
                punctuality: &punctuality,
                viewer,
                progress,
            };
            scope.spawn(move || reader.serve(force, listeners));
            scope.spawn(|| watcher.look_on(&is_over));
            scope.spawn(|| punctuality.show_until(&is_over));
            let _over = Over::new(&is_over);
            // Dropped here, so that the reader thread ends even if `conduct` panics.
            let mut mailbox = mailbox;
            halts::prepare_this_thread();
            conduct(robot, &mut mailbox, supervisor.clone())
        });
        (conducted, punctuality.end())
    }
}

/// Guard that sets a flag when it is dropped. The flag ends a thread.
pub(super) struct Over<'a>(&'a AtomicBool);

impl<'a> Over<'a> {
    pub(super) fn new(is_over: &'a AtomicBool) -> Over<'a> {
        Over(is_over)
    }
}

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Release);
    }
}

/// Watches the robot and the switch, and detects missing readings and cancellation.
struct Watcher<'a> {
    supervisor: &'a SharedSupervisor,
    punctuality: &'a Punctuality<'a>,
    /// True if a motion was in progress at the end of the last pose reading, or during this one.
    was_under_way: bool,
    /// True if the last turn of the thread found the robot halted because of a stale reading.
    was_stale: bool,
    halts: Arc<HaltCalls>,
    follower: HaltFollower,
    watch: Option<Arc<dyn RobotWatch>>,
    /// Last pose received; `None` before the first pose.
    last: Option<(Pose, Stamp)>,
    switch: Option<&'a dyn EnablingSwitch>,
    cancel: &'a Cancel,
    progress: &'a dyn Progress,
    viewer: Option<&'a dyn Viewer>,
    was_cancelled: bool,
}

impl Watcher<'_> {
    fn look_on(mut self, is_over: &AtomicBool) {
        halts::prepare_this_thread();
        let mut timer = TurnTimer::of_this_thread();
        while !is_over.load(Ordering::Acquire) {
            timer.begin(LOOK);
            self.obey();
            self.feel();
            self.look();
            self.time(&timer.end());
        }
        // The session may end before the end of a halt is known.
        let call = self.halts.take();
        self.follow_halt(call, self.was_under_way, Held::No, MonotonicClock.now_s());
    }

    /// Records that this turn of the thread was late, found a stale reading, or found a halt.
    fn time(&mut self, turn: &Turn) {
        let supervisor = self.supervisor.lock();
        let [is_under_way, was_under_way] = [supervisor.is_under_way(), self.was_under_way];
        let tripped = supervisor.tripped();
        let is_held = tripped.is_some() || supervisor.fault().is_some();
        // Every halt holds this lock, so the call and the state of the robot belong together.
        let call = self.halts.take();
        let stale_s = match tripped {
            Some(Trip::StaleForce { age_s } | Trip::StalePose { age_s }) => Some(age_s),
            _ => None,
        };
        drop(supervisor);
        self.was_under_way = is_under_way;
        if is_under_way || was_under_way {
            self.punctuality.turn("pose", turn);
        }
        let was_stale = std::mem::replace(&mut self.was_stale, stale_s.is_some());
        if let Some(age_s) = stale_s.filter(|_| !was_stale) {
            self.punctuality.stale(age_s, turn.ended_s);
        }
        self.punctuality.settle(turn.ended_s);
        let held = match self.last {
            _ if !is_held => Held::No,
            None => Held::Unseen,
            Some((pose, stamp)) => Held::At(pose, stamp),
        };
        self.follow_halt(call, is_under_way || was_under_way, held, turn.ended_s);
    }

    /// Records a halt of a motion when the tip is at rest, or the wait for rest has ended.
    fn follow_halt(&mut self, call: Option<HaltCall>, is_under_way: bool, held: Held, now_s: f64) {
        let halted = self.follower.turn(call, is_under_way, held, now_s);
        if let Some(halted) = halted {
            self.punctuality.halted(&halted);
        }
    }

    /// Handles cancellation. The first cancellation ends the motion in progress, but not the retreat. The second cancellation also ends the retreat.
    fn obey(&mut self) {
        // Read first, so that a second request between both calls is seen.
        let is_insisted = self.progress.is_insisted();
        let is_cancelled = is_insisted || self.progress.is_cancelled();
        let is_first = is_cancelled && !self.was_cancelled;
        if is_first {
            self.was_cancelled = true;
            self.cancel.cancel();
        }
        if is_first || is_insisted {
            let mut supervisor = self.supervisor.lock();
            self.was_under_way |= supervisor.is_under_way();
            supervisor.halt();
        }
    }

    /// Reads the enabling switch and reports its state to the supervisor. A switch that cannot be read counts as lost.
    fn feel(&mut self) {
        let Some(switch) = self.switch else {
            return;
        };
        let enabling = match switch.is_held() {
            Ok(true) => Enabling::Held,
            Ok(false) => Enabling::Released,
            Err(_) => Enabling::Lost,
        };
        let mut supervisor = self.supervisor.lock();
        self.was_under_way |= supervisor.is_under_way();
        supervisor.enabling(enabling);
    }

    fn look(&mut self) {
        if let Some(watch) = &self.watch {
            match watch.pose(LOOK_DEADLINE) {
                Ok(seen) => {
                    self.last = Some(seen);
                    if let Some(viewer) = self.viewer {
                        viewer.pose(&seen.0);
                    }
                }
                Err(error) => {
                    if let Some(fault) = error.fault() {
                        let mut supervisor = self.supervisor.lock();
                        self.was_under_way |= supervisor.is_under_way();
                        supervisor.fail(fault);
                    }
                }
            }
        }
        let mut supervisor = self.supervisor.lock();
        if !supervisor.is_under_way() {
            return;
        }
        self.was_under_way = true;
        let now_s = MonotonicClock.now_s();
        // A repeated pose keeps its stamp, so its age grows. A trip is ignored here, because the run detects it by its own motion.
        let seen = self
            .last
            .map(|(pose, stamp)| Observation::UnderWay { pose, stamp });
        for observation in seen.iter().chain([&Observation::Silence]) {
            let _ = supervisor.observe(observation, now_s);
        }
    }
}
