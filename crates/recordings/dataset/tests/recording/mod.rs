//! Tests that a recording survives the end of its process and reports its samples.

mod killed;
mod packs;
mod reduced;
mod refused;
mod resumed;

use taceva_core::{
    Channel, Channels, Clock, Frame, FrameInfo, GratingKind, Nanometre, Phase, PixelFormat,
    Readings, Sample, Stamp,
};
use taceva_dataset::{Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};

fn spec() -> RecordingSpec {
    let sensor = SensorFacts::new("bench")
        .with_serial("1")
        .with_gel("2")
        .with_opaque(false);
    let facts = RecordingFacts::new(Source::Simulated, Clock::Monotonic, sensor);
    RecordingSpec::new(
        facts,
        Channels::new([Channel::PZ, Channel::FZ]).expect("distinct"),
    )
}

fn frame(seed: u8) -> Frame {
    let info = FrameInfo {
        width: 4,
        height: 2,
        format: PixelFormat::Rgb8,
    };
    Frame::new(info, (0..24).map(|byte| byte ^ seed).collect()).expect("24 bytes")
}

fn sample(number: u8) -> Sample {
    Sample::new(format!("s{number}"))
        .with_point_id(format!("p{}", number % 2))
        .with_unit_id("1".to_owned())
        .with_scene_id("dark".to_owned())
        .with_depth_step(3)
        .with_repeat(u32::from(number))
        .with_phase(Phase::Unload)
        .with_kind(GratingKind::Line)
        .with_spacing(Nanometre(350_000))
        .with_stamp(Stamp {
            valid_s: f64::from(number) / 3.0,
            received_s: None,
        })
        .with_frame(frame(number))
        .with_truth(Readings::new(vec![Some(f64::from(number) / 7.0), None]))
}

#[test]
fn what_was_recorded_is_read_back_bit_for_bit() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let mut recorder = Recorder::create(&path, &spec()).expect("created");
    for number in 1..=3 {
        let sequence = recorder.append(&sample(number)).expect("recorded");
        assert_eq!(sequence, u64::from(number));
    }
    recorder.append_reference(&frame(99)).expect("recorded");
    let header = recorder.close().expect("closed");
    assert!(!path.join("journal").exists());
    let dataset = Dataset::open(&path).expect("opens");
    assert_eq!(dataset.digest(), header.digest);
    assert_eq!(dataset.reference().expect("decodes"), Some(frame(99)));
    for number in 1..=3_u8 {
        let row = usize::from(number) - 1;
        let decoded = dataset.frame(row).expect("decodes");
        let fields = dataset.table().fields();
        let read = dataset.table().sample(row, fields, decoded);
        let expected = sample(number)
            .with_intensity(frame(number).mean_luma())
            .with_frame_digest(read.frame_digest.clone());
        assert_eq!(read, expected);
        let digest = read.frame_digest.expect("a frame has a digest");
        assert!(digest.starts_with("sha256:"), "{digest}");
    }
}
