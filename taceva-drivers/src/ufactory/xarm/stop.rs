//! Stopping the arm from any thread: a latch on this side, and a connection of its own to the controller that is kept alive.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, TryLockError};
use std::thread::JoinHandle;
use std::time::Duration;

use taceva_core::{DriverError, ErrorKind, Halt};

use super::KEY;
use super::command::{Command, TargetState};
use super::exchange::{Exchange, ExchangeError, UNANSWERED, Writer};
use super::firmware::Firmware;

/// How long the controller may take to confirm a stop, before it is sent by the other connection too.
const CONFIRMATION: Duration = Duration::from_millis(40);
/// How often the connection is tried while nothing is to be stopped, and how long its answer may take.
const TRIAL_EVERY: Duration = Duration::from_millis(500);
/// How often one that does not answer is tried: until it does, the arm is not moved.
const RETRIAL_EVERY: Duration = Duration::from_millis(50);
const TRIAL_PATIENCE: Duration = Duration::from_millis(20);

/// The means to stop one arm, shared by the robot, its handles and the thread that keeps the connection alive.
#[derive(Debug)]
pub(super) struct Stop {
    is_halted: AtomicBool,
    /// Set once the robot is dropped: there is nothing left to stop.
    is_gone: AtomicBool,
    /// Whether the connection answered when it was tried last.
    is_alive: AtomicBool,
    line: Mutex<Exchange>,
    /// What writes on that connection while somebody waits for an answer on it.
    writer: Mutex<Writer>,
    /// The connection by which the arm is moved, for the case that the other one fails.
    spare: Writer,
    place: Place,
    /// Wakes the thread that keeps the connection alive, so that it ends.
    bell: (Mutex<()>, Condvar),
}

/// Where the controller is.
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

    /// Lets moves be accepted again on this side.
    pub(super) fn release(&self) {
        self.is_halted.store(false, Ordering::Release);
    }

    /// Whether the arm can be stopped by the connection that is there for it.
    pub(super) fn is_alive(&self) -> bool {
        self.is_alive.load(Ordering::Acquire)
    }

    /// Sends the controller the command to stop and to forget what waits, by whichever connection carries it.
    pub(super) fn stop(&self) -> Result<(), ExchangeError> {
        let command = Command::SetState(TargetState::Stopped);
        let unanswered = |writer: &Writer| writer.send(command, self.place.firmware, UNANSWERED);
        let line = match self.line.try_lock() {
            Ok(line) => Some(line),
            Err(TryLockError::Poisoned(poisoned)) => Some(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => None,
        };
        // Twice stopped is once stopped, and an answer is not waited for by a second way.
        let Some(mut line) = line else {
            // The connection is being tried, and its answer may not come: a stop waits for nobody.
            let direct = unanswered(&lock(&self.writer));
            let spare = unanswered(&self.spare);
            return Ok(direct.or(spare)?);
        };
        match line.ask(command, CONFIRMATION) {
            Ok(_) => Ok(()),
            Err(error) => unanswered(&self.spare).map_err(|_| error),
        }
    }

    /// Tries the connection, and makes it anew if it does not answer.
    fn keep(&self) {
        // Whoever stops the arm has the connection to himself.
        let Ok(mut line) = self.line.try_lock() else {
            return;
        };
        let answered = line.ask(Command::GetState, TRIAL_PATIENCE);
        drop(line);
        let is_alive = match answered {
            Ok(_) => true,
            // A busy network is late now and then; it is tried again before it counts as gone.
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
            *lock(&self.line) = anew;
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

/// The thread that keeps the connection alive; it ends with the robot.
#[derive(Debug)]
pub(super) struct Keeper {
    stop: Arc<Stop>,
    thread: Option<JoinHandle<()>>,
}

impl Keeper {
    /// The means to stop the arm at `place`, over `line`, which has answered.
    pub(super) fn start(line: Exchange, spare: Writer, place: Place) -> std::io::Result<Keeper> {
        let stop = Arc::new(Stop {
            is_halted: AtomicBool::new(false),
            is_gone: AtomicBool::new(false),
            is_alive: AtomicBool::new(true),
            writer: Mutex::new(line.writer()),
            line: Mutex::new(line),
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
