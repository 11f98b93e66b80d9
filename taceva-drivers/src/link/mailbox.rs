//! Mailbox in which a reader thread posts the newest reading of a device for waiting callers.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use taceva_core::{DriverError, DriverKey, ErrorKind, Interrupt};

/// Newest item of a reader thread, and the reason if the thread has ended. Older items are dropped, so that a late caller receives the current item.
#[derive(Debug)]
pub(crate) struct Mailbox<T> {
    inside: Mutex<Inside<T>>,
    changed: Condvar,
}

#[derive(Debug)]
struct Inside<T> {
    newest: Option<Seen<T>>,
    posted: u64,
    ended: Option<Ending>,
    /// True while a caller waits. If `is_interrupted` is set, this caller returns.
    is_waiting: bool,
    is_interrupted: bool,
}

/// Received item with its number, counted from 1 in its mailbox, and its arrival time on the monotonic clock.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen<T> {
    pub(crate) what: T,
    pub(crate) number: u64,
    pub(crate) at: Duration,
}

/// Reason why a reader thread ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Ending {
    pub(crate) kind: ErrorKind,
    pub(crate) why: String,
}

/// Reason why no newer item arrived.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum NoNews {
    /// The timeout expired.
    Silent,
    /// The wait was interrupted.
    Interrupted,
    /// The reader thread has ended.
    Ended(Ending),
}

impl NoNews {
    /// Converts the reason into an error of `driver` in the operation `doing`. `silence` returns the text for a timeout.
    pub(crate) fn while_waiting(
        self,
        driver: &DriverKey,
        doing: &'static str,
        silence: impl FnOnce() -> String,
    ) -> DriverError {
        let (kind, why) = match self {
            NoNews::Silent => (ErrorKind::Timeout, silence()),
            NoNews::Interrupted => (ErrorKind::Interrupted, "it was interrupted".to_owned()),
            NoNews::Ended(ending) => (ending.kind, ending.why),
        };
        DriverError::new(kind, driver, doing).because(why)
    }
}

impl<T> Default for Mailbox<T> {
    fn default() -> Mailbox<T> {
        Mailbox {
            inside: Mutex::new(Inside {
                newest: None,
                posted: 0,
                ended: None,
                is_waiting: false,
                is_interrupted: false,
            }),
            changed: Condvar::new(),
        }
    }
}

impl<T: Clone> Mailbox<T> {
    /// Posts the last of `count` items that arrived together at time `at`. Earlier items are outdated.
    pub(crate) fn post_last(&self, count: u64, what: T, at: Duration) {
        let mut inside = self.inside();
        inside.posted += count;
        let number = inside.posted;
        inside.newest = Some(Seen { what, number, at });
        drop(inside);
        self.changed.notify_all();
    }

    /// Records the reason why the reader thread ended. Only the first reason is kept.
    pub(crate) fn end(&self, ending: Ending) {
        self.inside().ended.get_or_insert(ending);
        self.changed.notify_all();
    }

    /// True once the mailbox has ended.
    #[cfg(any(feature = "camera", feature = "netft"))]
    pub(crate) fn has_ended(&self) -> bool {
        self.inside().ended.is_some()
    }

    /// Reopens the mailbox for a new link and drops the last item.
    #[cfg(any(feature = "camera", feature = "netft"))]
    pub(crate) fn begin_again(&self) {
        let mut inside = self.inside();
        (inside.ended, inside.newest) = (None, None);
    }

    /// Newest item; `None` before the first item and after the end.
    #[cfg(any(feature = "netft", feature = "sri", feature = "ur", feature = "xarm"))]
    pub(crate) fn newest(&self) -> Option<Seen<T>> {
        let inside = self.inside();
        inside.newest.clone().filter(|_| inside.ended.is_none())
    }

    /// Total number of received items.
    #[cfg(any(
        feature = "camera",
        feature = "gcode",
        feature = "hid",
        feature = "netft",
        feature = "sri"
    ))]
    pub(crate) fn posted(&self) -> u64 {
        self.inside().posted
    }

    /// Waits up to `patience` for an item newer than number `after`.
    ///
    /// # Errors
    /// [`NoNews`] on a timeout, on an interrupt, or if the reader thread has ended.
    pub(crate) fn next(&self, after: u64, patience: Duration) -> Result<Seen<T>, NoNews> {
        let began = Instant::now();
        let mut inside = self.inside();
        inside.is_waiting = true;
        let found = loop {
            if let Some(ending) = &inside.ended {
                break Err(NoNews::Ended(ending.clone()));
            }
            if std::mem::take(&mut inside.is_interrupted) {
                break Err(NoNews::Interrupted);
            }
            if let Some(seen) = inside.newest.as_ref().filter(|seen| seen.number > after) {
                break Ok(seen.clone());
            }
            let left = patience.saturating_sub(began.elapsed());
            if left.is_zero() {
                break Err(NoNews::Silent);
            }
            let waited = self.changed.wait_timeout(inside, left);
            inside = waited.unwrap_or_else(PoisonError::into_inner).0;
        };
        (inside.is_waiting, inside.is_interrupted) = (false, false);
        found
    }

    fn inside(&self) -> MutexGuard<'_, Inside<T>> {
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T: Clone + Send> Interrupt for Mailbox<T> {
    fn interrupt(&self) {
        let mut inside = self.inside();
        inside.is_interrupted = inside.is_waiting;
        drop(inside);
        self.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    const SHORT: Duration = Duration::from_millis(5);
    const LONG: Duration = Duration::from_secs(20);

    #[test]
    fn who_comes_late_gets_the_newest_and_nothing_twice() {
        let mailbox = Mailbox::default();
        for what in [3, 4, 5] {
            mailbox.post_last(1, what, Duration::ZERO);
        }
        let seen = mailbox.next(0, SHORT).expect("it came");
        assert_eq!((seen.what, seen.number), (5, 3));
        assert!(matches!(mailbox.next(3, SHORT), Err(NoNews::Silent)));
    }

    #[test]
    fn an_interrupt_ends_one_call_that_waits_and_no_later_one() {
        let mailbox = Arc::new(Mailbox::<u8>::default());
        mailbox.interrupt();
        assert!(matches!(mailbox.next(0, SHORT), Err(NoNews::Silent)));
        let waiting = Arc::clone(&mailbox);
        let call = std::thread::spawn(move || waiting.next(0, LONG));
        while !call.is_finished() {
            mailbox.interrupt();
            std::thread::yield_now();
        }
        assert!(matches!(call.join(), Ok(Err(NoNews::Interrupted))));
        assert!(matches!(mailbox.next(0, SHORT), Err(NoNews::Silent)));
    }

    #[test]
    fn once_it_is_over_nothing_old_is_taken_for_new() {
        let mailbox = Mailbox::default();
        mailbox.post_last(1, 1, Duration::ZERO);
        let ending = Ending {
            kind: ErrorKind::Disconnected,
            why: "unplugged".to_owned(),
        };
        mailbox.end(ending.clone());
        assert_eq!(
            mailbox.next(0, LONG).expect_err("over"),
            NoNews::Ended(ending)
        );
    }
}
