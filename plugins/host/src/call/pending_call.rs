//! Records pending plugin calls, so that an aborted check can name the hanging call.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// True once [`watch`] runs. Otherwise calls are not recorded.
static IS_WATCHED: AtomicBool = AtomicBool::new(false);
static CALLS: Mutex<Calls> = Mutex::new(Calls {
    next: 0,
    under_way: BTreeMap::new(),
});

struct Calls {
    next: u64,
    /// Operation and start time, by call number. The operation is a verb phrase that follows "did not".
    under_way: BTreeMap<u64, (&'static str, Instant)>,
}

fn calls() -> MutexGuard<'static, Calls> {
    // Each change is a single operation, so a panic of another thread leaves the state consistent.
    CALLS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Call that is pending until this guard is dropped.
#[derive(Debug)]
pub struct UnderWay(Option<u64>);

/// Records a call if pending calls are watched.
pub fn begin(doing: &'static str) -> UnderWay {
    if !IS_WATCHED.load(Ordering::Relaxed) {
        return UnderWay(None);
    }
    let mut calls = calls();
    let number = calls.next;
    calls.next += 1;
    calls.under_way.insert(number, (doing, Instant::now()));
    UnderWay(Some(number))
}

impl Drop for UnderWay {
    fn drop(&mut self) {
        if let Some(number) = self.0 {
            calls().under_way.remove(&number);
        }
    }
}

/// Duration after which a call is reported.
const LONG: Duration = Duration::from_millis(400);
/// Polling interval.
const PAUSE: Duration = Duration::from_millis(100);

/// Starts a thread that reports the newest call pending for longer than [`LONG`]. Calls `tell` whenever the reported call changes, with "" if no call is
/// pending.
pub(crate) fn watch(tell: impl Fn(&'static str) + Send + 'static) {
    IS_WATCHED.store(true, Ordering::Relaxed);
    let look = move || {
        let mut said = None;
        loop {
            std::thread::sleep(PAUSE);
            let long = longest(Instant::now());
            if long.map(|(number, _)| number) != said {
                said = long.map(|(number, _)| number);
                tell(long.map_or("", |(_, doing)| doing));
            }
        }
    };
    // If the thread cannot start, a hanging check is still aborted, but its error does not name the call.
    let _ = std::thread::Builder::new()
        .name("taceva-calls".to_owned())
        .spawn(look);
}

fn longest(now: Instant) -> Option<(u64, &'static str)> {
    let calls = calls();
    let mut newest_first = calls.under_way.iter().rev();
    let long = newest_first.find(|(_, (_, since))| now.saturating_duration_since(*since) >= LONG);
    long.map(|(number, (doing, _))| (*number, *doing))
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use super::*;

    #[test]
    fn the_innermost_call_that_lasts_is_named_and_that_none_does_any_more() {
        drop(begin("nobody looks yet"));
        let (sender, receiver) = channel();
        watch(move |doing| {
            // The test may have ended.
            let _ = sender.send(doing);
        });
        let outer = begin("load");
        let inner = begin("read the force");
        let heard = || receiver.recv_timeout(Duration::from_secs(20));
        assert_eq!(heard(), Ok("read the force"));
        drop(inner);
        assert_eq!(heard(), Ok("load"));
        drop(outer);
        assert_eq!(heard(), Ok(""));
    }
}
