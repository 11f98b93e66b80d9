//! Decodes every frame of a dataset and prints the time taken: `decode DATASET [JOBS]`.
#![expect(clippy::print_stdout, reason = "an example talks to a person")]

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use taceva_core::SilentProgress;
use taceva_dataset::{Dataset, Pass};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let folder = arguments.first().ok_or("usage: decode DATASET [JOBS]")?;
    let jobs = match arguments.get(1) {
        Some(jobs) => jobs.parse()?,
        None => std::thread::available_parallelism()?,
    };
    let dataset = Dataset::open(Path::new(folder))?;
    let rows = dataset.all_rows();
    let pass = Pass::new(&rows, jobs, &SilentProgress);
    let start = Instant::now();
    let mut sum = 0;
    let brightness = |_, frame: taceva_core::Frame| {
        frame
            .bytes()
            .iter()
            .map(|byte| u64::from(*byte))
            .sum::<u64>()
    };
    dataset.map_frames(pass, brightness, |_, frame_sum| {
        sum += frame_sum;
        Ok(())
    })?;
    let elapsed = start.elapsed();
    println!(
        "{} frames in {elapsed:.1?}, sum of all bytes {sum}",
        rows.len()
    );
    Ok(())
}
