//! Records the frame without contact, a sample, and a second frame without contact: `two_references FOLDER`. Prints `ACK n` once the n-th record is durable.
#![expect(clippy::print_stdout, reason = "the power-cut test reads the output")]

use std::error::Error;
use std::path::Path;

use taceva_core::{Channel, Channels, Clock, Readings, Sample};
use taceva_dataset::{Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
use taceva_tests::recorded::reference;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args()
        .nth(1)
        .ok_or("usage: two_references FOLDER")?;
    let sensor = SensorFacts::new("made up")
        .with_serial("1")
        .with_gel("1")
        .with_opaque(true);
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, sensor);
    let spec = RecordingSpec::new(facts, Channels::new([Channel::FZ])?);
    let mut recorder = Recorder::create(Path::new(&folder), &spec)?;
    recorder.append_reference(&reference(1))?;
    println!("ACK 1");
    recorder.append(
        &Sample::new("press")
            .with_frame(reference(0))
            .with_truth(Readings::from_values([1.0])),
    )?;
    println!("ACK 2");
    recorder.append_reference(&reference(2))?;
    println!("ACK 3");
    Ok(())
}
