//! A dataset that is exported and imported again is the same: ids, labels to the last bit, pixels.

use std::num::NonZeroUsize;
use std::path::Path;

use taceva_core::{
    Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Progress, Readings, Sample,
    SilentProgress,
};
use taceva_dataset::{
    Dataset, DatasetError, ImportMap, ImportPlan, Recorder, RecordingFacts, RecordingSpec,
    SensorFacts, Source, export_hugging_face,
};

const SAMPLES: u8 = 230;

/// A recording of more samples than a row group holds, whose frames after the first are kept as differences.
fn recorded(path: &Path) -> Dataset {
    let facts = RecordingFacts::new(Source::Simulated, Clock::Unknown, SensorFacts::new("gel"));
    let channels = Channels::new([Channel::FX, Channel::FZ]).expect("distinct");
    let mut recorder = Recorder::create(path, &RecordingSpec::new(facts, channels)).expect("new");
    let info = FrameInfo {
        width: 4,
        height: 3,
        format: PixelFormat::Rgb8,
    };
    for number in 0..SAMPLES {
        let pixels = (0..36).map(|pixel: u8| pixel.wrapping_mul(7).wrapping_add(number / 3));
        let force = Some(f64::from(number) / 7.0).filter(|_| number % 5 != 0);
        let sample = Sample::new(format!("s{number}"))
            .with_point_id(format!("p{}", number / 10))
            .with_truth(Readings::new(vec![force, Some(-0.1 * f64::from(number))]))
            .with_frame(Frame::new(info, pixels.collect()).expect("whole"));
        recorder.append(&sample).expect("recorded");
    }
    recorder.close().expect("closed");
    Dataset::open(path).expect("a dataset")
}

const MAP: &str = r#"
map_version = 2
source = "simulated"
table = "data/*.parquet"
[frame]
bytes = "image.bytes"
channel_order = "rgb"
reference = "unknown"
[columns]
Fx = { from = "Fx", unit = "N" }
Fz = { from = "Fz", unit = "N" }
[ids]
sample = "sample"
point_id = "point_id"
[time]
clock = "unknown"
[sensor]
model = "gel"
serial = "unknown"
gel = "unknown"
opaque = "unknown"
"#;

#[test]
fn what_is_exported_for_hugging_face_comes_back_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = recorded(&folder.path().join("recorded"));
    let exported = folder.path().join("exported");
    export_hugging_face(&dataset, &exported, &SilentProgress).expect("exported");
    let card = std::fs::read_to_string(exported.join("README.md")).expect("there");
    assert!(
        card.contains("Source: Simulated") && card.contains("| Fz | N |"),
        "{card}"
    );
    let map = ImportMap::parse("map.toml".as_ref(), MAP).expect("a map");
    let plan = ImportPlan::new(&exported, &map).expect("planned");
    let unmentioned = &plan.summary().unmentioned_columns;
    assert!(!unmentioned.contains("image.bytes"), "{unmentioned:?}");
    let target = folder.path().join("again");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    let again = Dataset::open(&target).expect("a dataset");
    for name in ["sample", "point_id", "Fx", "Fz"] {
        assert_eq!(
            again.table().as_text(name),
            dataset.table().as_text(name),
            "{name}"
        );
    }
    for row in [0, 1, 99, 100, 229] {
        assert_eq!(
            again.frame(row).expect("read"),
            dataset.frame(row).expect("read"),
            "{row}"
        );
    }
    // The same dataset is the same file.
    let twice = folder.path().join("twice");
    export_hugging_face(&dataset, &twice, &SilentProgress).expect("exported");
    let file = "data/train-00000-of-00001.parquet";
    assert_eq!(
        std::fs::read(exported.join(file)).expect("read"),
        std::fs::read(twice.join(file)).expect("read")
    );
}

/// Asks to stop at once.
#[derive(Debug)]
struct Stopped;

impl Progress for Stopped {
    fn begin(&self, _: &str, _: Option<u64>) {}
    fn advance(&self, _: u64) {}
    fn end(&self) {}
    fn is_cancelled(&self) -> bool {
        true
    }
}

#[test]
fn an_export_that_is_stopped_or_has_no_free_place_leaves_nothing_new() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = recorded(&folder.path().join("recorded"));
    let exported = folder.path().join("exported");
    let stopped = export_hugging_face(&dataset, &exported, &Stopped);
    assert!(matches!(stopped, Err(DatasetError::Cancelled)));
    assert_eq!(std::fs::read_dir(folder.path()).expect("there").count(), 1);
    std::fs::create_dir(&exported).expect("made");
    let taken = export_hugging_face(&dataset, &exported, &SilentProgress);
    assert!(matches!(taken, Err(DatasetError::TargetExists { .. })));
}
