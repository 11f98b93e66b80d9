//! Pending calls and fate of a child, shared by its keeper and its callers.

use std::collections::{BTreeMap, VecDeque};
use std::io;
use std::os::fd::OwnedFd;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use rustix::event::{EventfdFlags, eventfd};

use super::exit_status::Fate;
use super::plain::plain;

/// Maximum length of the stored output of the child, bytes. Only its last part is kept.
pub(super) const PRINTED_MAX: usize = 4096;

/// State shared by the keeper and the callers.
#[derive(Debug)]
pub(crate) struct Watch {
    state: Mutex<State>,
    ended: Condvar,
    /// Event file that wakes the keeper thread.
    pub(super) wake: OwnedFd,
}

#[derive(Debug, Default)]
struct State {
    calls: BTreeMap<u64, Expiry>,
    next_call: u64,
    /// Time of the keeper's next check; `None` if it waits for an event.
    looks_at: Option<Instant>,
    /// Reason to kill the child; `None` if there is none.
    sentence: Option<Fate>,
    /// True once the child was ordered to end.
    is_ending: bool,
    fate: Option<Fate>,
    printed: VecDeque<u8>,
    /// Total time in which callers waited for calls.
    called: Duration,
}

#[derive(Debug)]
struct Expiry {
    begun: Instant,
    at: Instant,
    after: Duration,
    doing: String,
}

/// Identifier of a pending call.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CallId(u64);

impl Watch {
    pub(super) fn new() -> io::Result<Watch> {
        Ok(Watch {
            state: Mutex::default(),
            ended: Condvar::new(),
            wake: eventfd(0, EventfdFlags::CLOEXEC | EventfdFlags::NONBLOCK)?,
        })
    }

    /// Records a call that must be answered within `after`.
    pub(crate) fn begin(&self, doing: &str, after: Duration) -> CallId {
        let mut state = self.state();
        let id = state.next_call;
        state.next_call += 1;
        // A deadline that overflows the clock is replaced by one in a hundred years.
        let now = Instant::now();
        let at = now
            .checked_add(after)
            .unwrap_or(now + Duration::from_secs(3_153_600_000));
        let doing = doing.to_owned();
        let expiry = Expiry {
            begun: now,
            at,
            after,
            doing,
        };
        state.calls.insert(id, expiry);
        self.look_at(&mut state, at);
        CallId(id)
    }

    /// Records that a call was answered.
    pub(crate) fn end(&self, call: CallId) {
        let mut state = self.state();
        if let Some(call) = state.calls.remove(&call.0) {
            state.called += call.begun.elapsed();
        }
    }

    /// Total time in which callers waited for calls.
    pub(super) fn called(&self) -> Duration {
        self.state().called
    }

    /// Shortens the timeout of a call to `after`, if the call is pending and has more time left.
    pub(crate) fn hasten(&self, call: CallId, after: Duration) {
        let mut state = self.state();
        let at = Instant::now() + after;
        if let Some(expiry) = state.calls.get_mut(&call.0).filter(|call| call.at > at) {
            expiry.at = at;
            expiry.after = after;
            expiry.doing = format!("end its call to {} after an interrupt", expiry.doing);
            self.look_at(&mut state, at);
        }
    }

    /// Requests the end of the child for `reason`, unless there is an earlier reason.
    pub(crate) fn condemn(&self, reason: Fate) {
        let mut state = self.state();
        state.sentence.get_or_insert(reason);
        self.look_at(&mut state, Instant::now());
    }

    /// Records that the child was ordered to end, so that its exit is not a failure.
    pub(crate) fn expect_end(&self) {
        self.state().is_ending = true;
    }

    /// Fate of the child; `None` while it runs.
    pub(crate) fn fate(&self) -> Option<Fate> {
        self.state().fate.clone()
    }

    /// Waits for the end of a child that closed its sockets, and returns the reason. Kills the child if it still runs after 250 ms.
    pub(crate) fn final_fate(&self) -> Fate {
        let closing = Duration::from_millis(250);
        let (state, _) = self
            .ended
            .wait_timeout_while(self.state(), closing, |state| state.fate.is_none())
            .unwrap_or_else(PoisonError::into_inner);
        if let Some(fate) = &state.fate {
            return fate.clone();
        }
        drop(state);
        // The child still runs but closed its socket.
        self.condemn(Fate::Breach {
            what: "it closed the connection to its host".to_owned(),
        });
        let state = self
            .ended
            .wait_while(self.state(), |state| state.fate.is_none())
            .unwrap_or_else(PoisonError::into_inner);
        state.fate.clone().unwrap_or(Fate::Closed)
    }

    /// Last output of the child, with control characters escaped.
    pub(crate) fn printed(&self) -> String {
        let bytes: Vec<u8> = self.state().printed.iter().copied().collect();
        plain(&String::from_utf8_lossy(&bytes))
    }

    fn look_at(&self, state: &mut State, at: Instant) {
        if state.looks_at.is_none_or(|looks_at| at < looks_at) {
            state.looks_at = Some(at);
            // A full counter wakes the keeper too.
            let _ = rustix::io::write(&self.wake, &1_u64.to_ne_bytes());
        }
    }

    /// Locks the state. Every change completes before any panic is possible, so the state behind a poisoned lock is consistent.
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the time that the keeper should wait, `None` for no limit. The error is the reason to kill the child.
    pub(super) fn look(&self) -> Result<Option<Duration>, Fate> {
        let mut state = self.state();
        let now = Instant::now();
        if state.sentence.is_none() {
            let late = state.calls.values().find(|call| call.at <= now);
            let late = late.map(|call| Fate::Late {
                doing: call.doing.clone(),
                after: call.after,
            });
            state.sentence = late;
        }
        if let Some(reason) = state.sentence.clone() {
            return Err(reason);
        }
        // Without pending calls, the next check stays, so a stream of short calls does not wake the keeper each time.
        let next = state.calls.values().map(|call| call.at).min();
        state.looks_at = next.or(state.looks_at.filter(|at| *at > now));
        Ok(state.looks_at.map(|at| at.saturating_duration_since(now)))
    }

    /// Appends output of the child and drops the oldest bytes beyond [`PRINTED_MAX`].
    pub(super) fn printed_more(&self, bytes: &[u8]) {
        let mut state = self.state();
        state.printed.extend(bytes);
        let surplus = state.printed.len().saturating_sub(PRINTED_MAX);
        state.printed.drain(..surplus);
    }

    /// Records the child's fate and wakes all waiting threads.
    pub(super) fn ended(&self, fate: Fate) {
        let mut state = self.state();
        let fate = state.sentence.take().unwrap_or(fate);
        let is_asked_for = state.is_ending && fate == Fate::Exited { code: 0 };
        state.fate = Some(if is_asked_for { Fate::Closed } else { fate });
        drop(state);
        self.ended.notify_all();
    }
}
