//! Processor time of Rust calls behind the Python package, for comparison with `benches/peers/python_update.py`.
//!
//! ```text
//! call_times update ROWS        # milliseconds of `update` of ROWS × 6 ready columns, metrics of accuracy and the skill
//! call_times frames RECORDING   # milliseconds in which `map_frames` decodes all frames of a recording into one buffer, on one thread
//! ```
//!
//! Prints five lines, each with the time of one call.

#![expect(clippy::print_stdout, reason = "its result")]

use std::error::Error;
use std::num::NonZeroUsize;
use std::path::Path;

use taceva_core::random::mix;
use taceva_core::{Batch, Channel, Channels, Column, FieldSet, SilentProgress};
use taceva_dataset::{Dataset, Pass};
use taceva_evaluate::with_skill;
use taceva_metrics::{Evaluator, MetricPlan, catalogue};

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        ["update", rows] => update(rows.parse()?),
        ["frames", path] => frames(&Dataset::open(Path::new(path))?),
        _ => Err("expected `update ROWS` or `frames RECORDING`".into()),
    }
}

/// Column of `rows` pseudo-random numbers from 0 to 1; each depends only on the seed and its row.
fn drawn(seed: u64, rows: u64) -> Column {
    let bits = |row| u32::try_from(mix((seed << 40) | row) >> 32).unwrap_or(0);
    let number = |row| f64::from(bits(row)) / 4_294_967_296.0;
    Column::full((0..rows).map(number).collect())
}

fn update(rows: u64) -> Result<(), Box<dyn Error>> {
    let channels = Channels::new(Channel::SIX)?;
    // Includes the skill, as the package does.
    let wanted = with_skill(catalogue::select(["accuracy"])?);
    let plan = MetricPlan::new(&wanted, channels.clone(), FieldSet::PAIRS);
    let columns = |first| (first..first + 6).map(|seed| drawn(seed, rows)).collect();
    let batch = Batch::from_columns(channels, columns(0), columns(6), None);
    timed(20, || Ok(Evaluator::new(&plan).update(&batch)?))
}

fn frames(dataset: &Dataset) -> Result<(), Box<dyn Error>> {
    let rows = dataset.all_rows();
    timed(1, || {
        let mut bytes: Vec<u8> = Vec::new();
        let pass = Pass::new(&rows, NonZeroUsize::MIN, &SilentProgress);
        let take = |_, frame: taceva_core::Frame| {
            bytes.extend_from_slice(frame.bytes());
            Ok(())
        };
        Ok(dataset.map_frames(pass, |_, frame| frame, take)?)
    })
}

fn timed(calls: u32, call: impl Fn() -> Result<(), Box<dyn Error>>) -> Result<(), Box<dyn Error>> {
    for _ in 0..5 {
        let before = processor_ms()?;
        for _ in 0..calls {
            call()?;
        }
        println!("{:.3}", (processor_ms()? - before) / f64::from(calls));
    }
    Ok(())
}

/// Processor time in ms of all threads of this process, including ended threads, in ticks of 10 ms.
fn processor_ms() -> Result<f64, Box<dyn Error>> {
    let text = std::fs::read_to_string("/proc/self/stat")?;
    // After the program name, which may contain blanks, user and system time are the 12th and 13th fields.
    let (_, behind) = text.rsplit_once(')').ok_or("no name")?;
    let fields: Vec<&str> = behind.split_whitespace().collect();
    let ticks = |at: usize| -> Result<f64, Box<dyn Error>> {
        Ok(fields.get(at).ok_or("no time")?.parse()?)
    };
    Ok(10.0 * (ticks(11)? + ticks(12)?))
}
