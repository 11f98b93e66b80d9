//! Cost of dividing work between two threads of a pool: microseconds from the request until both empty halves are done.
//!
//! `cargo run --release -p taceva-network --example waking [-- REPEATS]`. The other thread polls for work before it
//! sleeps, so the cost depends on the pause since its last work. In a network, this pause is the difference in time between both halves of a layer.
//! Each row has one pause, the median and ninth decile of the cost, and the processor time of all threads without the pause.

#![expect(
    clippy::print_stdout,
    reason = "a program that prints its measurements"
)]

use std::hint::black_box;
use std::time::{Duration, Instant};

use rustix::time::{ClockId, clock_gettime};

fn main() {
    let repeats = std::env::args().nth(1);
    let repeats = repeats.map_or(2000, |word| word.parse().expect("a number"));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build();
    let pool = pool.expect("two threads");
    for pause in [0, 2, 10, 50, 200, 1000] {
        let pause = Duration::from_micros(pause);
        pool.install(|| report("halves, within the pool", pause, repeats, halves));
    }
    for pause in [0, 200, 1000] {
        let pause = Duration::from_micros(pause);
        report("into the pool and back", pause, repeats, || {
            pool.install(|| black_box(()));
        });
    }
}

/// Divides an empty task between this thread and another thread. Returns after the other thread has begun its half.
fn halves() {
    let begun = std::sync::atomic::AtomicBool::new(false);
    let order = std::sync::atomic::Ordering::Release;
    rayon::join(
        || {
            while !begun.load(std::sync::atomic::Ordering::Acquire) {
                std::hint::spin_loop();
            }
        },
        || begun.store(true, order),
    );
}

fn report(what: &str, pause: Duration, repeats: usize, work: impl Fn()) {
    let (start, start_busy) = (Instant::now(), processor_seconds());
    let mut took: Vec<f64> = Vec::with_capacity(repeats);
    let mut paused = 0.0;
    for _ in 0..repeats {
        let before = Instant::now();
        while before.elapsed() < pause {
            std::hint::spin_loop();
        }
        paused += before.elapsed().as_secs_f64();
        let before = Instant::now();
        work();
        took.push(before.elapsed().as_secs_f64() * 1e6);
    }
    let busy = processor_seconds() - start_busy;
    took.sort_by(f64::total_cmp);
    println!(
        "{what}, {:4} µs after the last: median {:6.1} µs, ninth decile {:6.1}; processor time {:6.1} µs each ({:.1} s in all)",
        pause.as_micros(),
        took[repeats / 2],
        took[repeats * 9 / 10],
        (busy - paused) / repeats as f64 * 1e6,
        start.elapsed().as_secs_f64()
    );
}

fn processor_seconds() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}
