//! Times every summation kernel on columns read from a file, and prints one JSON object.
//!
//! usage: kernel_times COLUMNS CHANNELS [REPEATS]
//!
//! COLUMNS: little-endian binary64, first the references and then the estimates of each channel in turn, all of equal length. Times are in
//! nanoseconds per pair: best and median of the thread's processor time, then of the wall clock. Each round runs every kernel once, so all
//! kernels run under the same load. The last kernel runs half of the channels on a second thread, so only its wall-clock time is meaningful.

#![expect(clippy::print_stdout, reason = "an example shows its result")]

use std::hint::black_box;
use std::time::Instant;

use rustix::time::{ClockId, clock_gettime};
use taceva_metrics::bench::{Kernel, stream_sum};
use taceva_metrics::{Isa, Paired};

type Error = Box<dyn std::error::Error>;

fn main() -> Result<(), Error> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, channels, repeats @ ..] = &arguments[..] else {
        return Err("usage: kernel_times COLUMNS CHANNELS [REPEATS]".into());
    };
    let repeats = repeats.first().map_or(Ok(15), |repeats| repeats.parse())?;
    let columns = read(file, channels.parse()?)?;
    let pairs: usize = columns.iter().map(|columns| columns.estimate.len()).sum();

    let mut ways: Vec<(String, Box<dyn Fn()>)> = vec![];
    let mut way = |name: String, run: fn(Kernel, Paired<&[f64]>) -> Option<f64>, kernel| {
        let columns = &columns;
        let run = move || {
            for columns in columns {
                black_box(run(kernel, black_box(columns.as_slices())));
            }
        };
        ways.push((name, Box::new(run)));
    };
    way(
        "floor".to_owned(),
        |_, pairs| Some(stream_sum(pairs)),
        Kernel::Naive,
    );
    for kernel in Kernel::available() {
        way(kernel.name(), |kernel, pairs| kernel.run(pairs).mae, kernel);
        if kernel.is_exact() || kernel == Kernel::Naive {
            way(format!("{} mae", kernel.name()), Kernel::run_mae, kernel);
        }
    }

    let fastest = *Isa::available().first().ok_or("no instruction set")?;
    let half = columns.len() / 2;
    let columns = &columns;
    let on_two_threads = move || {
        let sum = |columns: &[Paired<Vec<f64>>]| {
            for columns in columns {
                black_box(Kernel::Exact(fastest).run(black_box(columns.as_slices())));
            }
        };
        std::thread::scope(|scope| {
            scope.spawn(move || sum(&columns[..half]));
            sum(&columns[half..]);
        });
    };
    ways.push((
        format!("exact {fastest}, 2 threads"),
        Box::new(on_two_threads),
    ));

    let mut times = vec![[Vec::new(), Vec::new()]; ways.len()];
    for _ in 0..repeats {
        for ((_, run), [busy, wall]) in ways.iter().zip(&mut times) {
            let (start, start_busy) = (Instant::now(), thread_seconds());
            run();
            busy.push(thread_seconds() - start_busy);
            wall.push(start.elapsed().as_secs_f64());
        }
    }
    let lines = ways.iter().zip(times).map(|((name, _), clocks)| {
        let [busy, wall] = clocks.map(|seconds| best_and_median(seconds, pairs));
        format!(
            "  \"{name}\": [{}, {}, {}, {}]",
            busy[0], busy[1], wall[0], wall[1]
        )
    });
    println!("{{\n{}\n}}", lines.collect::<Vec<_>>().join(",\n"));
    Ok(())
}

/// Best and median time, ns per pair, with four decimals.
fn best_and_median(mut seconds: Vec<f64>, pairs: usize) -> [String; 2] {
    seconds.sort_by(f64::total_cmp);
    let pairs = pairs as f64;
    [0, seconds.len() / 2].map(|at| format!("{:.4}", seconds[at] * 1e9 / pairs))
}

/// Processor time of this thread, s.
fn thread_seconds() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

/// Reads the columns of each channel.
fn read(file: &str, channels: usize) -> Result<Vec<Paired<Vec<f64>>>, Error> {
    let bytes = std::fs::read(file)?;
    let rows = bytes.len() / 16 / channels.max(1);
    if channels == 0 || rows == 0 || rows * channels * 16 != bytes.len() {
        let length = bytes.len();
        return Err(format!(
            "{file}: {length} bytes, expected 16 for each row of {channels} channels"
        )
        .into());
    }
    let column = |index: usize| {
        let bytes = &bytes[index * rows * 8..(index + 1) * rows * 8];
        let values = bytes
            .chunks_exact(8)
            .map(|value| value.try_into().map(f64::from_le_bytes));
        values.collect::<Result<Vec<f64>, _>>()
    };
    (0..channels)
        .map(|channel| {
            Ok(Paired {
                reference: column(2 * channel)?,
                estimate: column(2 * channel + 1)?,
            })
        })
        .collect()
}
