//! Compares the cost of recording a stream with writing and hashing the same bytes: `stream_cost RECORDING FOLDER [ROUNDS]`.
//!
//! RECORDING was made by `taceva capture` from a camera that sends files; FOLDER is a new folder on the measured disk. The frames are recorded again as by a
//! capture, 8 at a time and without pauses. For comparison the same bytes are written to one file and hashed frame by frame: synced after every 8 frames, and
//! synced only at the end. Decoding is not timed, because a capture decodes while the camera exposes the next frame. The shortest time of ROUNDS rounds
//! (default 3) is printed.
#![expect(clippy::print_stdout, reason = "an example talks to a person")]

use std::error::Error;
use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::time::{Duration, Instant};

use taceva_core::Clock;
use taceva_dataset::{
    Dataset, Digest, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source, StreamFacts,
    Streamed,
};

/// Number of frames synced at once, as in a capture.
const TOGETHER: usize = 8;

/// Times taken by the steps of a recording.
#[derive(Debug)]
struct Recorded {
    /// Time to check that each file is complete.
    checked: Duration,
    /// Time to append all frames.
    appended: Duration,
    /// Time to create and close the recording.
    around: Duration,
}

impl Recorded {
    fn sum(&self) -> Duration {
        self.checked + self.appended + self.around
    }
}

/// Shortest time of each method.
#[derive(Debug)]
struct Least {
    recorded: Recorded,
    durable: Duration,
    buffered: Duration,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [recording, folder, rounds @ ..] = arguments.as_slice() else {
        return Err("usage: stream_cost RECORDING FOLDER [ROUNDS]".into());
    };
    let rounds = rounds.first().map_or(Ok(3), |rounds| rounds.parse())?;
    let dataset = Dataset::open(Path::new(recording))?;
    let folder = Path::new(folder);
    std::fs::create_dir(folder)?;
    let mut all = Vec::new();
    let mut bytes = 0;
    for round in 0..rounds {
        let place = folder.join(round.to_string());
        std::fs::create_dir(&place)?;
        let recorded = recorded(&dataset, &place)?;
        let (durable, length) = written(&dataset, &place, TOGETHER)?;
        let (buffered, _) = written(&dataset, &place, usize::MAX)?;
        all.push((recorded, durable, buffered));
        bytes = length;
        std::fs::remove_dir_all(&place)?;
    }
    std::fs::remove_dir(folder)?;
    let durable = all.iter().map(|(_, durable, _)| *durable).min();
    let buffered = all.iter().map(|(_, _, buffered)| *buffered).min();
    let recorded = all.into_iter().map(|(recorded, _, _)| recorded);
    let recorded = recorded.min_by_key(Recorded::sum);
    if let (Some(recorded), Some(durable), Some(buffered)) = (recorded, durable, buffered) {
        let least = Least {
            recorded,
            durable,
            buffered,
        };
        print(&least, dataset.table().rows(), bytes);
    }
    Ok(())
}

fn print(least: &Least, frames: usize, bytes: usize) {
    let recorded = &least.recorded;
    let ratio = |of: Duration| of.as_secs_f64() / least.durable.as_secs_f64();
    println!("{frames} frames, {:.1} MB", bytes as f64 * 1e-6);
    println!("| | s | of writing and hashing |");
    println!("|---|---|---|");
    for (what, took) in [
        ("written and hashed, durable every 8 frames", least.durable),
        ("written and hashed, durable at the end", least.buffered),
        ("recorded and closed", recorded.sum()),
        ("of which checking files", recorded.checked),
        ("of which appending", recorded.appended),
        ("of which creating and closing", recorded.around),
    ] {
        println!(
            "| {what} | {:.3} | {:.2} |",
            took.as_secs_f64(),
            ratio(took)
        );
    }
}

/// Original file of the frame of a row, as the camera sent it.
fn sent(dataset: &Dataset, row: usize) -> Result<Vec<u8>, Box<dyn Error>> {
    let entry = dataset.table().frames()[row].as_ref();
    Ok(dataset.frame_bytes(entry.ok_or("a sample without a frame")?)?)
}

/// Records the frames of `dataset` again, as a capture does, and closes the recording.
fn recorded(dataset: &Dataset, place: &Path) -> Result<Recorded, Box<dyn Error>> {
    let sensor = SensorFacts::new("a camera")
        .with_serial("1")
        .with_gel("1")
        .with_opaque(true);
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Monotonic, sensor);
    let spec = RecordingSpec::new(facts, dataset.table().channels().clone());
    let rows = dataset.all_rows();
    let (mut checked, mut appended) = (Duration::ZERO, Duration::ZERO);
    let began = Instant::now();
    let mut recorder = Recorder::create(&place.join("recorded"), &spec)?;
    let created = began.elapsed();
    for together in rows.chunks(TOGETHER) {
        let mut read = Vec::with_capacity(together.len());
        for row in together {
            let frame = dataset.frame(*row)?;
            let sample = dataset
                .table()
                .sample(*row, dataset.table().fields(), frame);
            read.push((Streamed::new(sample), sent(dataset, *row)?));
        }
        let began = Instant::now();
        let streamed: Result<Vec<Streamed>, String> = read
            .into_iter()
            .map(|(streamed, sent)| streamed.with_sent(sent))
            .collect();
        checked += began.elapsed();
        let began = Instant::now();
        recorder.append_stream(&streamed?, StreamFacts::new(true))?;
        appended += began.elapsed();
    }
    let began = Instant::now();
    recorder.close()?;
    Ok(Recorded {
        checked,
        appended,
        around: created + began.elapsed(),
    })
}

/// Writes and hashes the same bytes, with a sync after every `together` frames. Returns the time and the number of bytes.
fn written(
    dataset: &Dataset,
    place: &Path,
    together: usize,
) -> Result<(Duration, usize), Box<dyn Error>> {
    let mut file = File::create(place.join("written"))?;
    let (mut took, mut length) = (Duration::ZERO, 0);
    for rows in dataset.all_rows().chunks(together) {
        let read: Result<Vec<Vec<u8>>, _> = rows.iter().map(|row| sent(dataset, *row)).collect();
        let read = read?;
        let began = Instant::now();
        for bytes in &read {
            length += bytes.len();
            std::hint::black_box(Digest::of(bytes));
            file.write_all(bytes)?;
        }
        file.sync_data()?;
        took += began.elapsed();
    }
    Ok((took, length))
}
