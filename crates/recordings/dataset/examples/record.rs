//! Records synthetic samples: `record FOLDER COUNT`. Prints `ACK n` once sample `n` is durable.
//!
//! The process may be killed at any moment. The next run continues the recording.
#![expect(
    clippy::print_stdout,
    reason = "the parent process reads the acknowledgements"
)]

use std::error::Error;
use std::io::Write;
use std::path::Path;

use taceva_core::{
    Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample, Stamp,
};
use taceva_dataset::{
    Dataset, DatasetError, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source,
};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, count] = arguments.as_slice() else {
        return Err("usage: record FOLDER COUNT".into());
    };
    let (folder, count) = (Path::new(folder), count.parse::<u16>()?);
    let mut recorder = match Recorder::open(folder, &spec()?) {
        Err(DatasetError::TargetExists { .. }) => {
            println!("CLOSED {}", Dataset::open(folder)?.digest());
            return Ok(());
        }
        recorder => recorder?,
    };
    println!("RESUMED {}", recorder.table().rows());
    for number in 1..=count {
        let sample = sample(number)?;
        if !recorder.has(&sample.id) {
            let sequence = recorder.append(&sample)?;
            println!("ACK {sequence}");
            std::io::stdout().flush()?;
        }
    }
    println!("CLOSED {}", recorder.close()?.digest);
    Ok(())
}

fn spec() -> Result<RecordingSpec, Box<dyn Error>> {
    let sensor = SensorFacts::new("made up")
        .with_serial("1")
        .with_gel("1")
        .with_opaque(true);
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Monotonic, sensor);
    Ok(RecordingSpec::new(
        facts,
        Channels::new([Channel::PZ, Channel::FZ])?,
    ))
}

/// Sample `number`, which is the same in each run.
fn sample(number: u16) -> Result<Sample, Box<dyn Error>> {
    let info = FrameInfo {
        width: 16,
        height: 12,
        format: PixelFormat::Gray8,
    };
    let pixels = (0..192_u16).map(|pixel| pixel.wrapping_mul(number).to_le_bytes()[0]);
    let depth = f64::from(number) / 100.0;
    Ok(Sample::new(format!("press {number}"))
        .with_point_id(format!("point {}", number % 7))
        .with_stamp(Stamp {
            valid_s: f64::from(number),
            received_s: None,
        })
        .with_frame(Frame::new(info, pixels.collect())?)
        .with_truth(Readings::from_values([depth, 2.0 * depth])))
}
