//! A force transducer with its own reader thread, and a mailbox for its last reading.

use std::sync::mpsc::{Receiver, RecvError, Sender, TryRecvError, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use taceva_core::{
    Axes, Deadline, DriverError, DriverKey, ErrorKind, ForceTransducer, Stamp, Tare, Wrench,
};
use taceva_drivers::MonotonicClock;
use taceva_protocol::{Observation, SharedSupervisor};

use crate::viewer::Viewer;

/// Deadline of one reading, after which it is retried.
const READ_DEADLINE: Deadline = Deadline::after(Duration::from_millis(20));
/// Delay before a failing transducer is retried.
const FAILED_REST: Duration = Duration::from_millis(5);

/// Last reading of the transducer.
#[derive(Default)]
struct Latest {
    /// Number of readings.
    count: u64,
    reading: Option<(Wrench, Stamp, Option<u64>)>,
    error: Option<DriverError>,
}

/// Shared slot of the last reading.
#[derive(Default)]
struct Slot {
    latest: Mutex<Latest>,
    news: Condvar,
}

impl Slot {
    fn lock(&self) -> MutexGuard<'_, Latest> {
        self.latest.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn put(&self, change: impl FnOnce(&mut Latest)) {
        change(&mut self.lock());
        self.news.notify_all();
    }
}

/// Tasks for the owner of the transducer.
enum Task {
    Start(Deadline),
    Stop,
    Zero(Deadline),
}

/// A task, and the channel for its outcome.
type Request = (Task, Sender<Result<(), DriverError>>);

/// Transducer for a run: `read` returns the newest reading of the reader thread.
pub(super) struct Mailbox {
    slot: Arc<Slot>,
    requests: Sender<Request>,
    driver: DriverKey,
    axes: Axes,
    has_tare: bool,
    /// Number of readings at the last `read`.
    taken: u64,
    sequence: Option<u64>,
}

/// Reader of the transducer.
pub(super) struct Reader {
    slot: Arc<Slot>,
    requests: Receiver<Request>,
}

impl Mailbox {
    /// Creates the mailbox of `force`, and its reader.
    pub(super) fn of(force: &mut dyn ForceTransducer, driver: DriverKey) -> (Mailbox, Reader) {
        let (requests, received) = channel();
        let slot = Arc::new(Slot::default());
        let mailbox = Mailbox {
            slot: Arc::clone(&slot),
            requests,
            driver,
            axes: force.axes(),
            has_tare: force.tare().is_some(),
            taken: 0,
            sequence: None,
        };
        let requests = received;
        (mailbox, Reader { slot, requests })
    }

    fn ask(&self, task: Task) -> Result<(), DriverError> {
        let gone = || DriverError::new(ErrorKind::Disconnected, &self.driver, "reach its reader");
        let (outcome, done) = channel();
        self.requests.send((task, outcome)).map_err(|_| gone())?;
        // The device enforces the deadline.
        done.recv().unwrap_or_else(|RecvError| Err(gone()))
    }
}

impl ForceTransducer for Mailbox {
    fn axes(&self) -> Axes {
        self.axes
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.ask(Task::Start(deadline))
    }

    /// Newest reading. Each reading is returned once.
    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        let taken = self.taken;
        let is_old = |latest: &mut Latest| latest.count == taken && latest.error.is_none();
        let waited =
            self.slot
                .news
                .wait_timeout_while(self.slot.lock(), deadline.remaining(), is_old);
        let (mut latest, _) = waited.unwrap_or_else(PoisonError::into_inner);
        if let Some(error) = latest.error.take() {
            return Err(error);
        }
        match latest.reading.filter(|_| latest.count > taken) {
            Some((wrench, stamp, number)) => {
                self.taken = latest.count;
                self.sequence = number;
                Ok((wrench, stamp))
            }
            None => {
                let timeout = DriverError::new(ErrorKind::Timeout, &self.driver, "read the force");
                Err(timeout.because(format!("no reading within {deadline}")))
            }
        }
    }

    fn sequence(&self) -> Option<u64> {
        self.sequence
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.ask(Task::Stop)
    }

    fn tare(&mut self) -> Option<&mut dyn Tare> {
        match self.has_tare {
            true => Some(self),
            false => None,
        }
    }
}

impl Tare for Mailbox {
    fn zero(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.ask(Task::Zero(deadline))
    }
}

impl Reader {
    /// Reads `force` from start to stop, shows every reading to `supervisor`, and executes tasks between readings. Ends when the mailbox is dropped.
    pub(super) fn serve(
        self,
        force: &mut dyn ForceTransducer,
        supervisor: &SharedSupervisor,
        viewer: Option<&dyn Viewer>,
    ) {
        let mut is_started = false;
        loop {
            let request = match is_started {
                true => self.requests.try_recv(),
                false => self
                    .requests
                    .recv()
                    .map_err(|RecvError| TryRecvError::Disconnected),
            };
            match request {
                Ok((task, outcome)) => {
                    is_started = match task {
                        Task::Start(_) => true,
                        Task::Stop => false,
                        Task::Zero(_) => is_started,
                    };
                    // A closed channel means that the run has ended.
                    let _ = outcome.send(carry_out(task, force));
                }
                Err(TryRecvError::Empty) => self.read(force, supervisor, viewer),
                Err(TryRecvError::Disconnected) => return,
            }
        }
    }

    fn read(
        &self,
        force: &mut dyn ForceTransducer,
        supervisor: &SharedSupervisor,
        viewer: Option<&dyn Viewer>,
    ) {
        match force.read(READ_DEADLINE) {
            Ok((wrench, stamp)) => {
                let number = force.sequence();
                let observation = match number {
                    Some(number) => Observation::Numbered(wrench, stamp, number),
                    None => Observation::Force(wrench, stamp),
                };
                // The supervisor reports a trip to the run.
                let mut held = supervisor.lock();
                let _ = held.observe(&observation, MonotonicClock.now_s());
                let presses = held.zeroed(&wrench);
                drop(held);
                if let Some(viewer) = viewer {
                    viewer.force(&presses);
                }
                self.slot.put(|latest| {
                    latest.count += 1;
                    latest.reading = Some((wrench, stamp, number));
                });
            }
            // The watcher thread measures the age of the last reading.
            Err(error) if error.kind() == ErrorKind::Timeout => {}
            Err(error) => {
                let mut held = supervisor.lock();
                match error.kind() {
                    ErrorKind::OutOfRange => drop(held.saturated()),
                    _ => held.halt(),
                }
                drop(held);
                self.slot.put(|latest| latest.error = Some(error));
                std::thread::sleep(FAILED_REST);
            }
        }
    }
}

fn carry_out(task: Task, force: &mut dyn ForceTransducer) -> Result<(), DriverError> {
    match task {
        Task::Start(deadline) => force.start(deadline),
        Task::Stop => force.stop(),
        Task::Zero(deadline) => force.tare().map_or(Ok(()), |tare| tare.zero(deadline)),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU32, Ordering};

    use taceva_core::{Halt, Millimetre, Newton};
    use taceva_protocol::{MotionStage, RigLimits, Supervisor, Trip};

    use super::*;

    const KEY: DriverKey = DriverKey::fixed("test/force");

    /// A scripted transducer: one entry for each reading, then timeouts.
    struct Script(Vec<Result<f64, ErrorKind>>);

    impl ForceTransducer for Script {
        fn axes(&self) -> Axes {
            Axes::NORMAL
        }

        fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
            std::thread::sleep(Duration::from_millis(2));
            if self.0.is_empty() {
                std::thread::sleep(deadline.remaining());
                return Err(DriverError::new(ErrorKind::Timeout, &KEY, "read"));
            }
            match self.0.remove(0) {
                Ok(force_n) => {
                    let mut wrench = Wrench::default();
                    wrench.force[2] = Newton(force_n);
                    Ok((wrench, Stamp::at(MonotonicClock.now())))
                }
                Err(kind) => Err(DriverError::new(kind, &KEY, "read")),
            }
        }
    }

    #[derive(Default)]
    struct Halts(AtomicU32);

    impl Halt for Halts {
        fn halt(&self) -> Result<(), DriverError> {
            self.0.fetch_add(1, Ordering::SeqCst);
            Ok(())
        }
    }

    /// Result of `act` with a transducer that follows `script`, and the number of halts.
    fn reading<T>(
        script: Vec<Result<f64, ErrorKind>>,
        act: impl FnOnce(&mut Mailbox, &SharedSupervisor) -> T,
    ) -> (T, u32) {
        let limits = RigLimits {
            depth_max: Millimetre(1.0),
            normal_max: Newton(2.0),
            shear_max: Newton(2.0),
            saturation: None,
            speed_max_mm_s: 20.0,
            overshoot: taceva_protocol::Overshoot {
                segment_mm: 0.015,
                healthy_mm: 0.0155,
                frozen_mm: 0.1205,
            },
            simulated: false,
            signals: taceva_protocol::Signals::default(),
        };
        let halts = Arc::new(Halts::default());
        let mut supervisor = Supervisor::new(limits, halts.clone());
        supervisor.watch(MotionStage::Search, MonotonicClock.now_s());
        let supervisor = SharedSupervisor::new(supervisor);
        let mut force = Script(script);
        let (mailbox, reader) = Mailbox::of(&mut force, KEY);
        let seen = std::thread::scope(|scope| {
            scope.spawn(|| reader.serve(&mut force, &supervisor, None));
            let mut mailbox = mailbox;
            mailbox.start(Deadline::PASSED).expect("started");
            act(&mut mailbox, &supervisor)
        });
        (seen, halts.0.load(Ordering::SeqCst))
    }

    const SECOND: Deadline = Deadline::after(Duration::from_secs(1));

    #[test]
    fn a_reading_is_taken_out_once_and_the_newest_first() {
        let script = vec![Ok(0.1), Ok(0.2), Ok(0.3)];
        let ((first, newest, nothing), halts) = reading(script, |mailbox, _| {
            let force_n = |mailbox: &mut Mailbox, deadline| {
                let read = mailbox.read(deadline);
                read.map(|(wrench, _)| wrench.force[2].0)
                    .map_err(|error| error.kind())
            };
            let first = force_n(mailbox, SECOND);
            std::thread::sleep(Duration::from_millis(100));
            let newest = force_n(mailbox, SECOND);
            (first, newest, force_n(mailbox, Deadline::PASSED))
        });
        assert_eq!((first, newest), (Ok(0.1), Ok(0.3)));
        assert_eq!((nothing, halts), (Err(ErrorKind::Timeout), 0));
    }

    #[test]
    fn a_limit_is_seen_by_the_thread_that_reads_though_nobody_asks() {
        let (tripped, halts) = reading(vec![Ok(0.1), Ok(2.5)], |_, supervisor| {
            std::thread::sleep(Duration::from_millis(100));
            supervisor.lock().tripped()
        });
        assert!(
            matches!(tripped, Some(Trip::NormalForce { .. })),
            "{tripped:?}"
        );
        assert_eq!(halts, 1);
    }

    #[test]
    fn a_transducer_that_fails_halts_and_its_error_is_found_by_who_reads_next() {
        for (kind, is_trip) in [
            (ErrorKind::OutOfRange, true),
            (ErrorKind::Disconnected, false),
        ] {
            let ((found, tripped), halts) = reading(vec![Err(kind)], |mailbox, supervisor| {
                let found = mailbox.read(SECOND).map_err(|error| error.kind());
                (found.map(drop), supervisor.lock().tripped())
            });
            assert_eq!((found, tripped.is_some()), (Err(kind), is_trip));
            assert_eq!(halts, 1);
        }
    }
}
