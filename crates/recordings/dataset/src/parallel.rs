//! Parallel work with ordered results and bounded memory.

use std::num::NonZeroUsize;
use std::sync::mpsc::{channel, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// Number of results that a worker may compute ahead of the calling thread.
const AHEAD: usize = 4;

/// Number of cores of this machine.
pub fn all_cores() -> NonZeroUsize {
    thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)
}

/// Calls `work` on `0..count` from `jobs` threads, and `take` with each result in order on the calling thread.
///
/// Worker `k` computes items `k`, `k + jobs`, … and returns them through its own bounded queue, so no sorting is needed. The first error in order is returned,
/// for any number of threads. If fewer than `jobs` threads start, these do all the work; if none starts, the calling thread does.
pub fn ordered_map<T: Send, E>(
    count: usize,
    jobs: NonZeroUsize,
    work: impl Fn(usize) -> T + Sync,
    mut take: impl FnMut(usize, T) -> Result<(), E>,
) -> Result<(), E> {
    let jobs = jobs.get().min(count);
    if jobs <= 1 {
        return (0..count).try_for_each(|item| take(item, work(item)));
    }
    let work = &work;
    thread::scope(|scope| {
        let started = (0..jobs).map_while(|worker| {
            let (sender, receiver) = sync_channel(AHEAD);
            let (workers, known) = channel::<usize>();
            let thread = thread::Builder::new().spawn_scoped(scope, move || {
                let Ok(workers) = known.recv() else { return };
                // A closed queue means that the receiver stopped and needs no more results.
                let _ = (worker..count)
                    .step_by(workers)
                    .try_for_each(|item| sender.send(work(item)));
            });
            thread.ok().map(|_| (workers, receiver))
        });
        let started: Vec<_> = started.collect();
        let jobs = started.len();
        if jobs == 0 {
            return (0..count).try_for_each(|item| take(item, work(item)));
        }
        let queues = started.into_iter().map(|(workers, receiver)| {
            // Threads that wait for the number of workers still run.
            let _ = workers.send(jobs);
            receiver
        });
        let queues: Vec<_> = queues.collect();
        (0..count).try_for_each(|item| match queues[item % jobs].recv() {
            Ok(result) => take(item, result),
            // The worker panicked; leaving the scope propagates its panic.
            Err(_) => Ok(()),
        })
    })
}

/// Calls `work` on each part in a separate thread, or in the calling thread if no thread can be started. Results have the order of the parts.
pub fn each_part<P: Send, T: Send>(parts: Vec<P>, work: impl Fn(P) -> T + Sync) -> Vec<T> {
    let work = &work;
    let parts: Vec<_> = parts
        .into_iter()
        .map(|part| Mutex::new(Some(part)))
        .collect();
    let done = |part: &Mutex<Option<P>>| {
        let part = part.lock().unwrap_or_else(PoisonError::into_inner).take();
        work(part.expect("one thread a part"))
    };
    let done = &done;
    thread::scope(|scope| {
        let running: Vec<_> = parts
            .iter()
            .skip(1)
            .map(|part| thread::Builder::new().spawn_scoped(scope, move || done(part)))
            .collect();
        let first: Vec<T> = parts.first().map(done).into_iter().collect();
        let rest = parts.iter().skip(1).zip(running);
        let rest = rest.map(|(part, thread)| match thread {
            Ok(thread) => thread
                .join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
            Err(_) => done(part),
        });
        first.into_iter().chain(rest).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn jobs(count: usize) -> NonZeroUsize {
        NonZeroUsize::new(count).expect("at least one")
    }

    #[test]
    fn results_arrive_in_order_for_any_number_of_threads() {
        for threads in [1, 2, 3, 8, 40] {
            let mut seen = Vec::new();
            let done: Result<(), ()> = ordered_map(
                37,
                jobs(threads),
                |item| item * item,
                |item, square| {
                    seen.push((item, square));
                    Ok(())
                },
            );
            assert_eq!(done, Ok(()));
            assert_eq!(seen, (0..37).map(|i| (i, i * i)).collect::<Vec<_>>());
        }
    }

    #[test]
    fn the_first_error_in_order_wins_for_any_number_of_threads() {
        for threads in [1, 2, 5] {
            let result = ordered_map(
                100,
                jobs(threads),
                |item| item,
                |_, item| {
                    if item % 30 == 29 { Err(item) } else { Ok(()) }
                },
            );
            assert_eq!(result, Err(29));
        }
    }

    #[test]
    fn nothing_to_do_is_done() {
        assert_eq!(ordered_map(0, jobs(2), |_| (), |_, ()| Err(())), Ok(()));
        assert_eq!(each_part(Vec::<u8>::new(), |part| part), Vec::<u8>::new());
    }

    #[test]
    #[should_panic(expected = "a scoped thread panicked")]
    fn a_panic_of_the_work_is_not_swallowed() {
        let _: Result<(), ()> = ordered_map(4, jobs(2), |item| assert_ne!(item, 3), |_, ()| Ok(()));
    }
}
