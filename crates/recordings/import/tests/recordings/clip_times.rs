//! Tests of clips of a variable rate as tables. Frames must have the times of the container, not multiples of a period.

use std::num::NonZeroUsize;
use std::process::Command;

use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::{Decoders, ImportMap, ImportPlan};
use taceva_needs::{Need, skip};

use super::{ffmpeg, folder};

const MAP: &str = r#"map_version = 2
table = { file = "clip.mkv", format = "clip" }
[frame]
video = "clip.mkv"
channel_order = "rgb"
reference = "unknown"
[columns]
Fz = { from = "ft.fz", unit = "N" }
[time]
column = "t"
unit = "s"
clock = "monotonic"
[[join]]
name = "ft"
table = "force.csv"
time = { column = "t", unit = "s" }
pick = "linear"
tolerance_ms = 100
lag_ms = 0
[sensor]
model = "drawn gel"
serial = "unknown"
gel = "unknown"
opaque = "unknown"
"#;

#[test]
fn frames_of_a_matroska_clip_of_a_variable_rate_come_at_its_stamps() {
    if let Err(error) = ffmpeg() {
        return skip(Need::Ffmpeg, error);
    }
    let lab = tempfile::tempdir().expect("a folder");
    // Each step between frames is longer than the previous one.
    let written = Command::new("ffmpeg")
        .args(["-v", "error", "-i"])
        .arg(folder("mkv-ffv1").join("clip.mkv"))
        .args(["-vf", "setpts=PTS*(1+0.02*N)", "-fps_mode", "passthrough"])
        .args(["-enc_time_base", "1:1000", "-c:v", "ffv1"])
        .arg(lab.path().join("clip.mkv"))
        .status();
    assert!(written.expect("run").success());
    let rows = (0..40).map(|row| format!("{0:.2},{0:.2}\n", f64::from(row) * 0.05));
    let log = format!("t,fz\n{}", rows.collect::<String>());
    std::fs::write(lab.path().join("force.csv"), log).expect("written");

    let map = ImportMap::parse("map.toml".as_ref(), MAP).expect("a map");
    let problem = ImportPlan::new(lab.path(), &map).expect_err("no decoder");
    assert!(problem.to_string().contains("ffmpeg"), "{problem}");
    let decoders = Decoders {
        ffmpeg: Some("ffmpeg".into()),
        ..Decoders::default()
    };
    let plan = ImportPlan::with_decoders(lab.path(), &map, &decoders);
    let plan = plan.unwrap_or_else(|problem| panic!("{problem}"));
    let target = lab.path().join("dataset");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    let dataset = Dataset::open(&target).expect("a dataset");
    let truth = dataset.table().truth(0);
    assert_eq!(truth.len(), 24);
    for frame in 0..24_u32 {
        // Stamps of Matroska are whole milliseconds.
        let expected = f64::from(frame) / 30.0 * (1.0 + 0.02 * f64::from(frame));
        let row = usize::try_from(frame).expect("small");
        let found = truth.get(row).expect("a force");
        assert!(
            (found - expected).abs() < 3e-3,
            "frame {frame}: {found} for {expected}"
        );
    }
}
