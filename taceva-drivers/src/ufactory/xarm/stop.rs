//! Halt of the arm from any thread: a latch in the driver, and a separate, monitored connection to the controller.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, TryLockError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use taceva_core::{DriverError, ErrorKind, Halt};

use super::KEY;
use super::command::{Command, TargetState};
use super::exchange::{Exchange, ExchangeError, UNANSWERED, Writer};
use super::firmware::Firmware;

/// Timeout for the confirmation of a stop. Afterwards the stop is also sent over the connection for motions.
const CONFIRMATION: Duration = Duration::from_millis(40);
/// Interval between tests of the stop connection while it answers.
const TRIAL_EVERY: Duration = Duration::from_millis(500);
/// Interval between tests of the stop connection while it does not answer. During this time no motion begins.
const RETRIAL_EVERY: Duration = Duration::from_millis(50);
const TRIAL_PATIENCE: Duration = Duration::from_millis(20);
/// Time after which an unanswered stop on an abandoned connection counts as lost. A run tries for longer than this to end a halt.
const LOST_AFTER: Duration = Duration::from_secs(2);
/// Polling interval while a motion waits for the stop connection.
const GLANCE: Duration = Duration::from_millis(5);

/// Halt of one arm, shared by the robot, its handles and the thread that monitors the connection.
#[derive(Debug)]
pub(super) struct Stop {
    is_halted: AtomicBool,
    /// True after the robot is dropped. A halt then does nothing.
    is_gone: AtomicBool,
    /// True if the stop connection answered its last test.
    is_alive: AtomicBool,
    line: Mutex<Exchange>,
    /// Abandoned stop connections, whose last stop may still be pending.
    given_up: Mutex<Vec<GivenUp>>,
    /// Writing half of the stop connection, for use while another caller waits for an answer.
    writer: Mutex<Writer>,
    /// Writing half of the connection for motions, used if the stop connection fails.
    spare: Writer,
    place: Place,
    /// Signal that ends the monitoring thread while it sleeps.
    bell: (Mutex<()>, Condvar),
}

/// Stop connection that did not answer and was replaced.
#[derive(Debug)]
struct GivenUp {
    line: Exchange,
    since: Instant,
}

/// Address and firmware of the controller.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub(super) host: String,
    pub(super) port: u16,
    pub(super) firmware: Firmware,
}

impl Stop {
    pub(super) fn is_halted(&self) -> bool {
        self.is_halted.load(Ordering::Acquire)
    }

    /// Releases the latch, so that the driver accepts moves again.
    pub(super) fn release(&self) {
        self.is_halted.store(false, Ordering::Release);
    }

    /// True if the stop connection answers.
    fn is_alive(&self) -> bool {
        self.is_alive.load(Ordering::Acquire)
    }

    /// Waits up to `patience` until the stop connection answers, and returns true if it does. Returns early if the arm is halted.
    pub(super) fn is_alive_within(&self, patience: Duration) -> bool {
        let began = Instant::now();
        while !self.is_alive() && !self.is_halted() && began.elapsed() < patience {
            std::thread::sleep(GLANCE);
        }
        self.is_alive()
    }

    /// Waits until the controller has executed every stop that was sent. The controller processes each connection independently, so a late stop could
    /// end a motion that begins after the halt.
    ///
    /// # Errors
    /// [`ExchangeError::Silent`] without an answer within `patience`. Then no motion may begin.
    pub(super) fn is_obeyed(&self, patience: Duration) -> Result<(), ExchangeError> {
        // A closed connection has no pending commands. Other checks prevent motion without it.
        let answered = |line: &mut Exchange| match line.ask(Command::GetState, patience) {
            Err(error @ ExchangeError::Silent { .. }) => Err(error),
            _ => Ok(()),
        };
        answered(&mut lock(&self.line))?;
        let mut given_up = lock(&self.given_up);
        while let Some(GivenUp { line, since }) = given_up.last_mut() {
            match answered(line) {
                Err(error) if since.elapsed() < LOST_AFTER => return Err(error),
                _ => drop(given_up.pop()),
            }
        }
        Ok(())
    }

    /// Sends the command to stop and to clear the queue. If the stop connection is busy or silent, also uses the connection for motions.
    pub(super) fn stop(&self) -> Result<(), ExchangeError> {
        let command = Command::SetState(TargetState::Stopped);
        let unanswered = |writer: &Writer| writer.send(command, self.place.firmware, UNANSWERED);
        let line = match self.line.try_lock() {
            Ok(line) => Some(line),
            Err(TryLockError::Poisoned(poisoned)) => Some(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => None,
        };
        // A second stop is harmless. The second connection waits for no answer.
        let Some(mut line) = line else {
            // The connection is being tested and may not answer. A stop must not wait for that.
            let direct = unanswered(&lock(&self.writer));
            let spare = unanswered(&self.spare);
            return Ok(direct.or(spare)?);
        };
        match line.ask(command, CONFIRMATION) {
            Ok(_) => Ok(()),
            Err(error) => unanswered(&self.spare).map_err(|_| error),
        }
    }

    /// Tests the stop connection, and replaces it if it does not answer.
    fn keep(&self) {
        // A stop in progress owns the connection.
        let Ok(mut line) = self.line.try_lock() else {
            return;
        };
        let answered = line.ask(Command::GetState, TRIAL_PATIENCE);
        drop(line);
        let is_alive = match answered {
            Ok(_) => true,
            // A busy network can delay an answer, so test again.
            Err(ExchangeError::Silent { .. }) if self.is_alive() => {
                let again = self.line.try_lock();
                again.map_or(true, |mut line| {
                    line.ask(Command::GetState, 5 * TRIAL_PATIENCE).is_ok()
                })
            }
            Err(_) => false,
        };
        if !is_alive {
            self.is_alive.store(false, Ordering::Release);
            let Place {
                host,
                port,
                firmware,
            } = &self.place;
            let Ok(mut anew) = Exchange::open(host, *port, *firmware) else {
                return;
            };
            if anew.ask(Command::GetState, 5 * TRIAL_PATIENCE).is_err() {
                return;
            }
            *lock(&self.writer) = anew.writer();
            let line = std::mem::replace(&mut *lock(&self.line), anew);
            let since = Instant::now();
            let mut given_up = lock(&self.given_up);
            given_up.retain(|earlier| earlier.since.elapsed() < LOST_AFTER);
            given_up.push(GivenUp { line, since });
        }
        self.is_alive.store(true, Ordering::Release);
    }
}

fn lock<T>(held: &Mutex<T>) -> MutexGuard<'_, T> {
    held.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Halt for Stop {
    fn halt(&self) -> Result<(), DriverError> {
        self.is_halted.store(true, Ordering::Release);
        if self.is_gone.load(Ordering::Acquire) {
            return Ok(());
        }
        self.stop().map_err(|error| {
            DriverError::new(ErrorKind::Disconnected, &KEY, "stop the arm").because(error)
        })
    }
}

/// Thread that monitors the stop connection. The thread ends when the robot is dropped.
#[derive(Debug)]
pub(super) struct Keeper {
    stop: Arc<Stop>,
    thread: Option<JoinHandle<()>>,
}

impl Keeper {
    /// Starts to monitor `line`, a working connection to the controller at `place`.
    pub(super) fn start(line: Exchange, spare: Writer, place: Place) -> std::io::Result<Keeper> {
        let stop = Arc::new(Stop {
            is_halted: AtomicBool::new(false),
            is_gone: AtomicBool::new(false),
            is_alive: AtomicBool::new(true),
            writer: Mutex::new(line.writer()),
            line: Mutex::new(line),
            given_up: Mutex::default(),
            spare,
            place,
            bell: Default::default(),
        });
        let kept = Arc::clone(&stop);
        let thread = std::thread::Builder::new()
            .name("xarm stop".to_owned())
            .spawn(move || {
                let (lock, bell) = &kept.bell;
                let mut guard = lock.lock().unwrap_or_else(PoisonError::into_inner);
                while !kept.is_gone.load(Ordering::Acquire) {
                    let pause = match kept.is_alive() {
                        true => TRIAL_EVERY,
                        false => RETRIAL_EVERY,
                    };
                    let waited = bell.wait_timeout(guard, pause);
                    drop(waited);
                    if !kept.is_gone.load(Ordering::Acquire) {
                        kept.keep();
                    }
                    guard = lock.lock().unwrap_or_else(PoisonError::into_inner);
                }
            })?;
        Ok(Keeper {
            stop,
            thread: Some(thread),
        })
    }

    pub(super) fn stop(&self) -> &Arc<Stop> {
        &self.stop
    }
}

impl Drop for Keeper {
    fn drop(&mut self) {
        let (lock, bell) = &self.stop.bell;
        let guard = lock.lock().unwrap_or_else(PoisonError::into_inner);
        self.stop.is_gone.store(true, Ordering::Release);
        drop(guard);
        bell.notify_all();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
