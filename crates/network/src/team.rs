//! Division of one picture among threads of the pool. Parts are too short to wake a thread for each part.
//!
//! An idle thread of the pool sleeps after about ten microseconds and takes twenty or more to wake (see `examples/waking.rs`). A layer takes about a hundred
//! microseconds. Helper threads therefore spin while pictures are predicted, for a limited time. A thread that waits for a part also spins, and meanwhile runs
//! other parts.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use rayon::Yield;

/// Maximum number of threads for one picture. A layer has too little work for more threads.
const MOST: usize = 8;

/// Number of failed searches for work after which a thread may sleep. The searches take several times the duration of a layer.
const PATIENCE: u32 = 3000;

/// Number of failed searches after which a thread yields the processor to other programs.
const LOOKS: u32 = 64;

/// Number of parts into which each of `images` pictures is divided, so that every thread has work.
pub(crate) fn parts(images: usize) -> usize {
    let threads = rayon::current_num_threads().min(MOST);
    if (1..threads).contains(&images) {
        threads.div_ceil(images)
    } else {
        1
    }
}

/// Calls `work` on each of `parts`. The first part runs on this thread, the others on any free thread.
pub(crate) fn divide<P: Send>(parts: Vec<P>, work: impl Fn(P) + Sync) {
    let mut parts = parts.into_iter();
    let Some(own) = parts.next() else { return };
    let left = AtomicUsize::new(parts.len());
    let (work, left) = (&work, &left);
    // The scope ends after its parts, even if one panics.
    rayon::in_place_scope(|scope| {
        for part in parts {
            scope.spawn(move |_| {
                work(part);
                left.fetch_sub(1, Ordering::Release);
            });
        }
        work(own);
        look_for_work(|| left.load(Ordering::Acquire) == 0);
    });
}

/// Guard that keeps helper threads spinning until it is dropped, or until the threads are idle for too long.
#[must_use]
pub(crate) struct Awake {
    is_over: Arc<AtomicBool>,
}

impl Awake {
    /// Wakes the helper threads, and returns their guard.
    pub(crate) fn keep() -> Awake {
        let is_over = Arc::new(AtomicBool::new(false));
        let begun = Arc::new(AtomicUsize::new(0));
        let home = rayon::current_thread_index();
        let others = rayon::current_num_threads().min(MOST) - 1;
        for _ in 0..others {
            let (is_over, begun) = (Arc::clone(&is_over), Arc::clone(&begun));
            rayon::spawn(move || {
                begun.fetch_add(1, Ordering::Relaxed);
                // This thread picked up a helper's job, but has its own work.
                if rayon::current_thread_index() == home {
                    return;
                }
                // Waits until all helpers have begun; otherwise the first helper would take the jobs of the others.
                for _ in 0..PATIENCE {
                    if begun.load(Ordering::Relaxed) >= others {
                        break;
                    }
                    std::hint::spin_loop();
                }
                look_for_work(|| is_over.load(Ordering::Acquire));
            });
        }
        Awake { is_over }
    }
}

impl Drop for Awake {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Release);
    }
}

/// Runs available work until `is_over` returns true, or until the limit of failed searches. Without this limit, threads that wait for each other's work would
/// wait forever.
fn look_for_work(is_over: impl Fn() -> bool) {
    let mut in_vain = 0;
    while in_vain < PATIENCE && !is_over() {
        if rayon::yield_now() == Some(Yield::Executed) {
            in_vain = 0;
            continue;
        }
        in_vain += 1;
        if in_vain.is_multiple_of(LOOKS) {
            std::thread::yield_now();
        }
        std::hint::spin_loop();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_threads<R: Send>(threads: usize, work: impl FnOnce() -> R + Send) -> R {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads").install(work)
    }

    #[test]
    fn every_part_is_done_once_on_any_number_of_threads_and_outside_a_pool() {
        let all = || {
            let _awake = Awake::keep();
            let mut done = vec![0_u32; 37];
            for _ in 0..200 {
                divide(done.iter_mut().collect(), |place: &mut u32| *place += 1);
            }
            done
        };
        for threads in [1, 2, 3, 9] {
            assert_eq!(on_threads(threads, all), [200; 37], "{threads} threads");
        }
        assert_eq!(all(), [200; 37]);
        divide(Vec::new(), |(): ()| unreachable!("no part"));
    }

    #[test]
    fn several_teams_in_one_pool_all_come_to_an_end() {
        let total = AtomicUsize::new(0);
        on_threads(3, || {
            rayon::scope(|scope| {
                for _ in 0..12 {
                    scope.spawn(|_| {
                        let _awake = Awake::keep();
                        for _ in 0..50 {
                            divide(vec![1, 2, 3], |part| {
                                total.fetch_add(part, Ordering::Relaxed);
                            });
                        }
                    });
                }
            });
        });
        assert_eq!(total.into_inner(), 12 * 50 * 6);
    }

    #[test]
    fn a_part_that_panics_is_a_panic_of_the_whole_and_not_a_wait() {
        let outcome = std::panic::catch_unwind(|| {
            on_threads(2, || {
                divide(vec![0, 1, 2, 3], |part| assert!(part != 2, "part 2"));
            });
        });
        assert!(outcome.is_err());
    }

    #[test]
    fn pictures_are_divided_only_where_they_are_fewer_than_threads() {
        on_threads(4, || {
            assert_eq!([1, 2, 3, 4, 5].map(parts), [4, 2, 2, 1, 1]);
        });
        on_threads(1, || assert_eq!([1, 2].map(parts), [1, 1]));
        on_threads(20, || assert_eq!([1, 8].map(parts), [MOST, 1]));
    }
}
