//! Thread pool that models compute with, also on systems that allow only a few threads.

use std::num::NonZeroUsize;
use std::sync::mpsc::channel;
use std::thread;

/// Prepares the global thread pool that models compute with. The pool has at most one thread per core.
///
/// Returns the number of threads that the system can start in addition to the calling thread, at most `wanted`. Containers may allow few or none.
/// With fewer threads than cores, models share these threads. Without threads, the calling thread computes alone. Models panic on a system without
/// threads if this function was not called.
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
        // Keeps an existing pool.
        let _ = pool.build_global();
    }
    there.min(wanted.get())
}

/// Number of threads that the system can start in addition to the calling thread, at most `most`.
fn startable(most: usize) -> usize {
    thread::scope(|scope| {
        let started = (0..most).map_while(|_| {
            let (over, waits) = channel::<()>();
            let thread = thread::Builder::new().spawn_scoped(scope, move || waits.recv());
            thread.ok().map(|_| over)
        });
        // Starts all at once, as in actual work.
        let started: Vec<_> = started.collect();
        started.len()
    })
}
