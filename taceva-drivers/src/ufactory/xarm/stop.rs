//! Stopping the arm from any thread: a latch on this side, and a connection of its own to the controller that is kept alive.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, TryLockError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

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
/// So long after a connection was given up, what was sent on it and not answered counts as lost. A run asks for the end of a halt for longer.
const LOST_AFTER: Duration = Duration::from_secs(2);
/// How often it is looked whether the connection answers again.
const GLANCE: Duration = Duration::from_millis(5);

/// The means to stop one arm, shared by the robot, its handles and the thread that keeps the connection alive.
#[derive(Debug)]
pub(super) struct Stop {
    is_halted: AtomicBool,
    /// Set once the robot is dropped: there is nothing left to stop.
    is_gone: AtomicBool,
    /// Whether the connection answered when it was tried last.
    is_alive: AtomicBool,
    line: Mutex<Exchange>,
    /// Connections that were given up: a stop may still be under way on them.
    given_up: Mutex<Vec<GivenUp>>,
    /// What writes on that connection while somebody waits for an answer on it.
    writer: Mutex<Writer>,
    /// The connection by which the arm is moved, for the case that the other one fails.
    spare: Writer,
    place: Place,
    /// Wakes the thread that keeps the connection alive, so that it ends.
    bell: (Mutex<()>, Condvar),
}

/// A connection that did not answer, in the place of which there is another.
#[derive(Debug)]
struct GivenUp {
    line: Exchange,
    since: Instant,
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
    fn is_alive(&self) -> bool {
        self.is_alive.load(Ordering::Acquire)
    }

    /// The same, where one that does not answer is given so long to do so; an arm that is halted meanwhile is not waited for.
    pub(super) fn is_alive_within(&self, patience: Duration) -> bool {
        let began = Instant::now();
        while !self.is_alive() && !self.is_halted() && began.elapsed() < patience {
            std::thread::sleep(GLANCE);
        }
        self.is_alive()
    }

    /// Waits until the controller has obeyed every stop that was sent to it. It answers each connection in order and none before another: a stop
    /// that is late on one would end what is begun on another after the halt.
    ///
    /// # Errors
    /// [`ExchangeError::Silent`] if it does not say so within `patience`: then nothing may begin.
    pub(super) fn is_obeyed(&self, patience: Duration) -> Result<(), ExchangeError> {
        // One that is gone carries nothing any more; that the arm is not moved without it is seen to elsewhere.
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
