//! Threads that look on while a run on real devices goes on, so that a limit is seen within a motion and not after it.
//!
//! One thread owns the force transducer: what it reads it shows to the [`Supervisor`] and puts where the run finds it. Another looks at the
//! robot whenever it reports and at the enabling switch, over a connection of its own where the robot has one, and hears when nothing is heard and when somebody
//! wishes to stop. Both halt through the supervisor, which decides alone.
//!
//! They run with the priority of the process. On a busy machine a thread may wait for a tenth of a second: `chrt -f 10 taceva run …` makes
//! that milliseconds.

mod mailbox;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use taceva_core::{
    Deadline, DriverKey, EnablingSwitch, ForceTransducer, Pose, Progress, Robot, RobotWatch, Stamp,
};
use taceva_drivers::MonotonicClock;
use taceva_protocol::{Cancel, Enabling, Observation, RigLimits, SharedSupervisor, Supervisor};

use crate::viewer::Viewer;
use mailbox::Mailbox;

/// Between two looks at the robot, each of which waits for what it reports next: less than the 10 ms between two reports of an arm, of which every
/// second would be missed otherwise. A signal that froze is found by eight readings that each come after the tip was seen elsewhere.
const LOOK: Duration = Duration::from_millis(5);
/// A robot that says nothing for so long has missed a look.
const LOOK_DEADLINE: Deadline = Deadline::after(Duration::from_millis(20));

/// What is looked at, and who may wish to stop.
pub(super) struct Guarded<'a> {
    pub(super) robot: &'a mut dyn Robot,
    pub(super) force: &'a mut dyn ForceTransducer,
    /// The driver of the transducer.
    pub(super) driver: DriverKey,
    pub(super) limits: RigLimits,
    /// What somebody holds while the robot moves, if the rig has it.
    pub(super) switch: Option<&'a dyn EnablingSwitch>,
    pub(super) cancel: &'a Cancel,
    pub(super) progress: &'a dyn Progress,
    /// Who sees every force and every pose too, if anybody.
    pub(super) viewer: Option<&'a dyn Viewer>,
}

impl Guarded<'_> {
    /// Lets `conduct` move the robot while threads look on; they end when it does.
    pub(super) fn conduct<T>(
        self,
        conduct: impl FnOnce(&mut dyn Robot, &mut dyn ForceTransducer, SharedSupervisor) -> T,
    ) -> T {
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
        let mut supervisor = Supervisor::new(limits, robot.halt_handle());
        if switch.is_some() {
            // Until somebody has looked.
            supervisor.enabling(Enabling::Released);
        }
        let supervisor = SharedSupervisor::new(supervisor);
        let (mailbox, reader) = Mailbox::of(force, driver);
        let watcher = Watcher {
            supervisor: &supervisor,
            watch: robot.watch_handle(),
            last: None,
            switch,
            cancel,
            progress,
            viewer,
            was_cancelled: false,
        };
        let is_over = AtomicBool::new(false);
        std::thread::scope(|scope| {
            scope.spawn(|| reader.serve(force, &supervisor, viewer));
            scope.spawn(|| watcher.look_on(&is_over));
            let _over = Over::new(&is_over);
            // Dropped here, so that the reader ends even if the conduct panics.
            let mut mailbox = mailbox;
            conduct(robot, &mut mailbox, supervisor.clone())
        })
    }
}

/// Tells a thread that it is over, however that comes.
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

/// Looks at the robot, and notices readings that stay away and wishes to stop.
struct Watcher<'a> {
    supervisor: &'a SharedSupervisor,
    watch: Option<Arc<dyn RobotWatch>>,
    /// The last pose that was heard of.
    last: Option<(Pose, Stamp)>,
    switch: Option<&'a dyn EnablingSwitch>,
    cancel: &'a Cancel,
    progress: &'a dyn Progress,
    viewer: Option<&'a dyn Viewer>,
    was_cancelled: bool,
}

impl Watcher<'_> {
    fn look_on(mut self, is_over: &AtomicBool) {
        while !is_over.load(Ordering::Acquire) {
            std::thread::sleep(LOOK);
            self.obey();
            self.feel();
            self.look();
        }
    }

    /// A wish to stop ends the motion that goes on, once: the retreat after it is another. One that was repeated ends that too.
    fn obey(&mut self) {
        // Asked for first: who insists between both questions wishes to stop.
        let is_insisted = self.progress.is_insisted();
        let is_cancelled = is_insisted || self.progress.is_cancelled();
        let is_first = is_cancelled && !self.was_cancelled;
        if is_first {
            self.was_cancelled = true;
            self.cancel.cancel();
        }
        if is_first || is_insisted {
            self.supervisor.lock().halt();
        }
    }

    /// Whether the switch is held; one that cannot be read counts as let go.
    fn feel(&mut self) {
        let Some(switch) = self.switch else {
            return;
        };
        let enabling = match switch.is_held() {
            Ok(true) => Enabling::Held,
            Ok(false) => Enabling::Released,
            Err(_) => Enabling::Lost,
        };
        self.supervisor.lock().enabling(enabling);
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
                        self.supervisor.lock().fail(fault);
                    }
                }
            }
        }
        let mut supervisor = self.supervisor.lock();
        if !supervisor.is_under_way() {
            return;
        }
        let now_s = MonotonicClock.now_s();
        // A pose that is shown again because none came is the older for it. What is halted for, the run learns of its own motion.
        let seen = self
            .last
            .map(|(pose, stamp)| Observation::UnderWay { pose, stamp });
        for observation in seen.iter().chain([&Observation::Silence]) {
            let _ = supervisor.observe(observation, now_s);
        }
    }
}
