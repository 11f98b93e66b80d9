//! A force transducer with its own reader thread, and a mailbox that stores its last reading.

use std::sync::mpsc::{Receiver, RecvError, Sender, TryRecvError, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use taceva_core::{
    Axes, Deadline, DriverError, DriverKey, ErrorKind, ForceTransducer, Progress, Stamp, Tare,
    Wrench,
};
use taceva_drivers::{MonotonicClock, plugin_remedy};
use taceva_protocol::{Event, Observation, SharedSupervisor};

use super::halts;
use super::punctuality::Punctuality;
use super::turn::TurnTimer;
use crate::viewer::Viewer;

/// Deadline for each reading. A reading that misses it is retried.
const READ_DEADLINE: Deadline = Deadline::after(Duration::from_millis(20));
/// Delay before a failing transducer is retried.
const FAILED_REST: Duration = Duration::from_millis(5);
/// Time without readings after which the transducer counts as lost while the operator is asked a question.
const SILENCE: Duration = Duration::from_secs(1);

/// Last reading of the transducer.
#[derive(Default)]
struct Latest {
    /// Number of received readings.
    count: u64,
    reading: Option<(Wrench, Stamp, Option<u64>)>,
    error: Option<DriverError>,
}

/// Slot for the last reading, shared between threads.
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

/// Tasks for the thread that owns the transducer.
enum Task {
    Start(Deadline),
    Stop,
    Zero(Deadline),
}

/// A task, and the channel that receives its outcome.
type Request = (Task, Sender<Result<(), DriverError>>);

/// Transducer for a run. `read` returns the newest reading of the reader thread.
pub(super) struct Mailbox {
    slot: Arc<Slot>,
    requests: Sender<Request>,
    driver: DriverKey,
    axes: Axes,
    has_tare: bool,
    /// Number of received readings when `read` was last called.
    taken: u64,
    sequence: Option<u64>,
}

/// Reader of the transducer, to run on its own thread.
pub(super) struct Reader {
    slot: Arc<Slot>,
    requests: Receiver<Request>,
    /// Time of the last reading.
    heard: Instant,
    /// True if the last turn of the reader thread ended during a motion.
    was_under_way: bool,
}

/// Receivers of every reading, and of the loss of the force.
#[derive(Clone, Copy)]
pub(super) struct Listeners<'a> {
    pub(super) supervisor: &'a SharedSupervisor,
    pub(super) punctuality: &'a Punctuality<'a>,
    pub(super) viewer: Option<&'a dyn Viewer>,
    pub(super) progress: &'a dyn Progress,
}

impl Listeners<'_> {
    /// Informs the operator and the viewer that the force is lost.
    fn lose(&self, error: &DriverError) {
        let remedy = plugin_remedy(error)
            .unwrap_or_else(|| "check cable and power of the transducer".to_owned());
        let words = format!(
            "the force is lost: {error}. The robot stays halted. Stop, {remedy}, and continue with `--resume`"
        );
        self.progress.remark(&words);
        if let Some(viewer) = self.viewer {
            viewer.event(&Event::ForceLost(words));
        }
    }
}

impl Mailbox {
    /// Creates the mailbox and the reader of `force`.
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
        let reader = Reader {
            slot,
            requests: received,
            heard: Instant::now(),
            was_under_way: false,
        };
        (mailbox, reader)
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

    /// Newest reading. Each reading is returned only once.
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
        if self.has_tare { Some(self) } else { None }
    }
}

impl Tare for Mailbox {
    fn zero(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.ask(Task::Zero(deadline))
    }
}

impl Reader {
    /// Reads `force` from start to stop, passes every reading to `listeners`, and executes tasks between readings. Ends when the mailbox is dropped.
    pub(super) fn serve(mut self, force: &mut dyn ForceTransducer, listeners: Listeners<'_>) {
        let mut is_started = false;
        halts::prepare_this_thread();
        let mut timer = TurnTimer::of_this_thread();
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
                    self.heard = Instant::now();
                    // The time of a task is not part of a turn.
                    timer.restart();
                }
                Err(TryRecvError::Empty) => {
                    timer.begin(Duration::ZERO);
                    self.read(force, listeners);
                    let turn = timer.end();
                    let is_under_way = listeners.supervisor.lock().is_under_way();
                    if is_under_way || self.was_under_way {
                        listeners.punctuality.turn("force", &turn);
                    }
                    self.was_under_way = is_under_way;
                }
                Err(TryRecvError::Disconnected) => return,
            }
        }
    }

    fn read(&mut self, force: &mut dyn ForceTransducer, listeners: Listeners<'_>) {
        let Listeners {
            supervisor, viewer, ..
        } = listeners;
        match force.read(READ_DEADLINE) {
            Ok((wrench, stamp)) => {
                self.heard = Instant::now();
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
            Err(error) if error.kind() == ErrorKind::Timeout => {
                let mut held = supervisor.lock();
                let is_lost = held.is_asking() && self.heard.elapsed() > SILENCE;
                let is_news = is_lost && held.lose_force();
                drop(held);
                if is_news {
                    listeners.lose(&error);
                }
            }
            Err(error) => {
                let mut held = supervisor.lock();
                let is_news = match error.kind() {
                    ErrorKind::OutOfRange => {
                        held.saturated();
                        false
                    }
                    _ => held.lose_force(),
                };
                drop(held);
                if is_news {
                    listeners.lose(&error);
                }
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
mod tests;
