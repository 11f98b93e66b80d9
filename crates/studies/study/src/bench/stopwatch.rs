//! Times of several candidates, measured in turns, so that a disturbance of the machine affects all candidates.

use std::time::{Duration, Instant};

use serde::Serialize;

/// Best and median of several times.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Shortest time, which disturbances of the machine affect least.
    pub best: f64,
    /// Median time.
    pub median: f64,
}

impl Spread {
    /// Best and median of `values`; `None` if `values` is empty.
    pub fn of(values: &[f64]) -> Option<Spread> {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        Some(Spread {
            best: *sorted.first()?,
            median: sorted[sorted.len() / 2],
        })
    }

    /// Both times multiplied by `factor`.
    #[must_use]
    pub fn times(self, factor: f64) -> Spread {
        Spread {
            best: self.best * factor,
            median: self.median * factor,
        }
    }
}

/// Times of every candidate in every round, in s.
#[derive(Clone, Debug)]
pub struct Stopwatch {
    wall: Vec<Vec<f64>>,
    thread: Vec<Vec<f64>>,
}

impl Stopwatch {
    /// Runs all candidates once without timing them. Then times each of them once in each of `rounds` rounds.
    ///
    /// `run` receives the index of a candidate. After each candidate, `go_on` returns true to continue. If it returns false, the race ends and keeps
    /// the measured times.
    pub fn race(
        candidates: usize,
        rounds: usize,
        mut run: impl FnMut(usize),
        mut go_on: impl FnMut() -> bool,
    ) -> Stopwatch {
        let mut watch = Stopwatch {
            wall: vec![Vec::new(); candidates],
            thread: vec![Vec::new(); candidates],
        };
        for round in 0..=rounds {
            for candidate in 0..candidates {
                let (wall, thread) = timed(|| run(candidate));
                if round > 0 {
                    watch.wall[candidate].push(wall.as_secs_f64());
                    watch.thread[candidate].extend(thread.map(|time| time.as_secs_f64()));
                }
                if !go_on() {
                    return watch;
                }
            }
        }
        watch
    }

    /// Best and median wall time of `candidate`, in s; `None` if it was never timed.
    pub fn wall(&self, candidate: usize) -> Option<Spread> {
        Spread::of(&self.wall[candidate])
    }

    /// Best and median processor time of the calling thread for `candidate`, in s; `None` if the system does not report it.
    pub fn thread(&self, candidate: usize) -> Option<Spread> {
        Spread::of(&self.thread[candidate])
    }
}

fn timed(run: impl FnOnce()) -> (Duration, Option<Duration>) {
    let (start, computed) = (Instant::now(), thread_time());
    run();
    let wall = start.elapsed();
    let thread = thread_time().zip(computed);
    (wall, thread.and_then(|(end, start)| end.checked_sub(start)))
}

/// Processor time that all threads of this process have used; `None` if the system does not report it.
pub(super) fn process_time() -> Option<Duration> {
    clock(Clock::Process)
}

/// Processor time that the calling thread has used; `None` if the system does not report it.
fn thread_time() -> Option<Duration> {
    clock(Clock::Thread)
}

/// Scope of a processor time: the process or one thread.
#[derive(Clone, Copy)]
enum Clock {
    Process,
    Thread,
}

#[cfg(unix)]
fn clock(clock: Clock) -> Option<Duration> {
    use rustix::time::{ClockId, clock_gettime};
    let time = clock_gettime(match clock {
        Clock::Process => ClockId::ProcessCPUTime,
        Clock::Thread => ClockId::ThreadCPUTime,
    });
    let seconds = u64::try_from(time.tv_sec).ok()?;
    let nanoseconds = u32::try_from(time.tv_nsec).ok()?;
    Some(Duration::new(seconds, nanoseconds))
}

/// Returns `None`, because this system does not report processor time.
#[cfg(not(unix))]
fn clock(_: Clock) -> Option<Duration> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_candidate_is_timed_in_every_round() {
        let mut order = Vec::new();
        let watch = Stopwatch::race(2, 3, |candidate| order.push(candidate), || true);
        assert_eq!(order, [0, 1, 0, 1, 0, 1, 0, 1]);
        assert_eq!((watch.wall[0].len(), watch.wall[1].len()), (3, 3));
    }

    #[test]
    fn what_was_measured_before_a_stop_stays() {
        let mut left = 3;
        let watch = Stopwatch::race(
            2,
            15,
            |_| {},
            || {
                left -= 1;
                left > 0
            },
        );
        assert_eq!((watch.wall(0).is_some(), watch.wall(1)), (true, None));
    }

    #[test]
    fn the_median_is_the_upper_one_of_two() {
        let spread = Spread::of(&[3.0, 1.0, 2.0, 4.0]);
        let expected = Spread {
            best: 1.0,
            median: 3.0,
        };
        assert_eq!((spread, Spread::of(&[])), (Some(expected), None));
    }
}
