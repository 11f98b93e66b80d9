//! Benchmark of frame decoding: `cargo bench -p taceva-dataset`.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use divan::Bencher;
use taceva_core::{Channels, Clock};
use taceva_core::{Frame, FrameInfo, PixelFormat, Sample, SilentProgress};
use taceva_dataset::{Dataset, Pass, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};

fn main() {
    divan::main();
}

/// Recording of 64 smooth frames of 640×480 pixels, with noise in the lowest bits.
fn recording() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("recording");
    let sensor = SensorFacts::new("bench").with_serial("1").with_gel("1");
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, sensor);
    let spec = RecordingSpec::new(facts, Channels::default());
    let mut recorder = Recorder::create(&path, &spec).expect("created");
    let info = FrameInfo {
        width: 640,
        height: 480,
        format: PixelFormat::Gray8,
    };
    let mut state = 7_u32;
    for number in 0..64_u32 {
        let pixels = (0..640 * 480_u32).map(|pixel| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            ((pixel % 640) / 8 + pixel / 640 / 8 + number + (state >> 30)).to_le_bytes()[0]
        });
        let sample = Sample::new(number.to_string())
            .with_frame(Frame::new(info, pixels.collect()).expect("of that size"));
        recorder.append(&sample).expect("recorded");
    }
    recorder.close().expect("closed");
    (folder, path)
}

#[divan::bench(args = [1, 2], sample_count = 10)]
fn decode_64_frames(bencher: Bencher<'_, '_>, jobs: usize) {
    let (_folder, path) = recording();
    let dataset = Dataset::open(&path).expect("opens");
    let rows = dataset.all_rows();
    let pass = Pass::new(
        &rows,
        NonZeroUsize::new(jobs).expect("at least one"),
        &SilentProgress,
    );
    bencher.bench(|| {
        let mut bytes = 0;
        dataset
            .map_frames(
                pass,
                |_, frame| frame.bytes().len(),
                |_, length| {
                    bytes += length;
                    Ok(())
                },
            )
            .expect("decodes");
        bytes
    });
}
