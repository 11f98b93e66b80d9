//! Threads that models compute with, also where the system starts few or none.

use std::num::NonZeroUsize;
use std::sync::mpsc::channel;
use std::thread;

/// Prepares the threads that models compute with: as many as the system starts, of at most one a core.
///
/// Returns how many of `wanted` threads the system starts beside the calling one; containers may allow few or none. Where there are too few for
/// each core, models share those, and where there are none the calling thread computes alone. Without this call a model panics there.
///
/// ```
/// use std::num::NonZeroUsize;
/// assert!(taceva_models::prepare_threads(NonZeroUsize::MIN) <= 1);
/// ```
pub fn prepare_threads(wanted: NonZeroUsize) -> usize {
    let cores = thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let most = wanted.max(cores).get();
    let there = startable(most);
    if there < cores.get() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(there.max(1));
        let pool = match there {
            0 => pool.use_current_thread(),
            _ => pool,
        };
        // One that is there already stays.
        let _ = pool.build_global();
    }
    there.min(wanted.get())
}

/// Number of threads that the system starts beside this one, at most `most`.
fn startable(most: usize) -> usize {
    thread::scope(|scope| {
        let started = (0..most).map_while(|_| {
            let (over, waits) = channel::<()>();
            let thread = thread::Builder::new().spawn_scoped(scope, move || waits.recv());
            thread.ok().map(|_| over)
        });
        // All at once, as work has them.
        let started: Vec<_> = started.collect();
        started.len()
    })
}
