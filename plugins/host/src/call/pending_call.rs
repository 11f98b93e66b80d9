//! Which call a plugin is in, so that a check which is ended can say where it hung.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Whether anybody looks; calls are noted only then.
static IS_WATCHED: AtomicBool = AtomicBool::new(false);
static CALLS: Mutex<Calls> = Mutex::new(Calls {
    next: 0,
    under_way: BTreeMap::new(),
});

struct Calls {
    next: u64,
    /// By their number: what is done, in words that follow "did not", and since when.
    under_way: BTreeMap<u64, (&'static str, Instant)>,
}

fn calls() -> MutexGuard<'static, Calls> {
    // Every change is made at once, whatever happened to another thread.
    CALLS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A call that is under way until this is dropped.
#[derive(Debug)]
pub struct UnderWay(Option<u64>);

/// Notes a call, if anybody looks.
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

/// From when on a call counts as one that may hang.
const LONG: Duration = Duration::from_millis(400);
/// How often it is looked.
const PAUSE: Duration = Duration::from_millis(100);

/// Tells from now on, on a thread of its own, which call lasts long, as soon as that is another: the one that began last, or "" where none does.
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
    // Without it a check that hangs is ended as well, and says less.
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
