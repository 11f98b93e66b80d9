//! Faults of taxels and of times.

use std::fmt::Write as _;
use std::fs;

use taceva_core::{
    Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample, SignalInfo, Signals,
    Unit, single,
};
use taceva_dataset::{Recorder, RecordingFacts, RecordingSpec, SensorFacts, SignalsSpec, Source};

use crate::support::Bench;

const MAP: &str = r#"
map_version = 2
source = "synthetic"
table = "skin.csv"
[columns]
Fz = { from = "fz", unit = "N" }
[time]
clock = "monotonic"
column = "t"
unit = "s"
[signals]
from = "c0..3"
unit = "uT"
places = [2, 2]
channels = ["p"]
order = "place-first"
rest = "0..9"
[sensor]
model = "drawn skin"
serial = "unknown"
gel = "unknown"
opaque = true
"#;

/// Imports the recording `name`: a stream at 50 Hz of four taxels whose values rise with a force.
fn import(bench: &Bench, name: &str, seed: u32) {
    let mut state = seed;
    let mut draw = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / 16_777_216.0
    };
    let mut text = "t,fz,c0,c1,c2,c3\n".to_owned();
    for row in 0..200 {
        let drawn = 5.0 * draw();
        let force = if row < 10 { 0.0 } else { drawn };
        write!(text, "{},{force}", f64::from(row) * 0.02).expect("text");
        for gain in [100.0, 60.0, 30.0, 10.0] {
            write!(text, ",{}", 500.0 + gain * force + 4.0 * draw()).expect("text");
        }
        text.push('\n');
    }
    bench.write(&format!("{name}-lab/skin.csv"), &text);
    bench.write(&format!("{name}-lab/map.toml"), MAP);
    bench.ok(&format!(
        "import {name}-lab --map {name}-lab/map.toml --out {name} -q"
    ));
}

/// Test folder with the recordings `seen` and `unseen`, and a model fitted on `seen`.
fn bench() -> Bench {
    let bench = Bench::new();
    import(&bench, "seen", 7);
    import(&bench, "unseen", 8);
    bench.ok("fit seen --model ridge --set difference=true --out skin.taceva -q");
    bench
}

#[test]
fn a_model_of_signals_is_tested_with_faults_of_taxels_unless_others_are_named() {
    let bench = bench();
    let report = bench.json("stress unseen --model skin.taceva");
    crate::schema::check("stress", &report);
    assert_eq!(report["list"]["name"], "taxel-3/1");
    assert_eq!(report["by"], "parameter");
    assert_eq!(report["input"], "signals");
    assert_eq!(report["contact_unit"], "uT");
    assert_eq!(report["provenance"]["frames_decoded"], 0);
    let gain = &report["faults"][1]["severities"][4];
    assert!(
        gain["stimulus"].as_f64().expect("a number") > 0.0,
        "{report}"
    );
    assert!(gain["fresh"]["Fz"].is_object(), "the model subtracts rest");
    let said = bench.ok("stress unseen --model skin.taceva -q");
    assert!(said.contains("taxel_drift"), "{said}");
    assert!(said.contains("new untouched signals remove"), "{said}");
    assert!(
        said.contains("by a fault that no check of signals finds"),
        "{said}"
    );
    let plan = bench.ok("stress unseen --model skin.taceva --explain");
    assert!(plan.contains("the signals of 200 samples"), "{plan}");
    let other = bench.json("stress unseen --model skin.taceva --faults tear,force_noise");
    crate::schema::check("stress", &other);
    assert_eq!(other["list"]["name"], "force_noise");
    assert_eq!(other["skipped"][0]["fault"], "tear");
}

#[test]
fn left_out_rows_state_metrics_of_time_in_every_format() {
    let bench = bench();
    let words = "stress unseen --model skin.taceva --faults dropped_frames,taxel_gain";
    let report = bench.json(words);
    crate::schema::check("stress", &report);
    let lost = &report["faults"][1];
    assert_eq!(lost["id"], "dropped_frames");
    assert_eq!(lost["times"]["frame_rate"]["unit"], "Hz");
    let dropped = &lost["severities"][3]["times"]["dropped"]["value"];
    assert!(dropped.as_f64().expect("a number") > 0.0, "{lost}");
    let said = bench.ok(&format!("{words} -q"));
    assert!(said.contains("dropped_frames: dropped "), "{said}");
    assert!(said.contains(" Hz without the fault, "), "{said}");
    let csv = bench.ok(&format!("{words} --format csv -q"));
    let rows = csv.lines().filter(|row| row.contains(",frame_rate,"));
    assert_eq!(rows.count(), 6, "{csv}");
    // A recording of single pictures has no frame rate.
    bench.record_with_noise("pictures", 24, 0);
    bench.record_with_noise("others", 24, 3);
    bench.ok("fit pictures --model ridge --set size=8x8 --out m.taceva -q");
    let skipped =
        bench.ok("stress others --model m.taceva --faults dropped_frames,jpeg --by parameter -q");
    let expected = "Skipped: dropped_frames: no metric of time: expected the times `t_s`";
    assert!(skipped.contains(expected), "{skipped}");
}

#[test]
fn requests_that_suit_no_recording_of_taxels_are_refused_by_name() {
    let bench = bench();
    let stress = "stress unseen --model skin.taceva";
    bench.refused(
        &format!("{stress} --keep-frames kept"),
        2,
        "--keep-frames kept: the model reads signals, so there is no picture to keep",
    );
    bench.refused(
        &format!("{stress} --faults taxel_dea"),
        2,
        "fault `taxel_dea`: unknown, did you mean `taxel_dead`?",
    );
    bench.record_with_noise("pictures", 24, 0);
    bench.refused(
        "stress pictures --model skin.taceva",
        2,
        "the recording has no signals, which the model reads",
    );
}

/// Records the dataset `both` of presses with pictures and signals.
fn record_both(bench: &Bench) {
    let taxels = SignalInfo::new(2, 2, 1, Unit::Microtesla).expect("a grid");
    let pixels = FrameInfo {
        width: 16,
        height: 16,
        format: PixelFormat::Gray8,
    };
    let sensor = SensorFacts::new("drawn").with_serial("1").with_gel("1");
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, sensor);
    let channels = Channels::new([Channel::FZ]).expect("one");
    let spec = SignalsSpec::new(taxels, ["p"]).expect("one name");
    let spec = RecordingSpec::new(facts, channels).with_signals(spec);
    let mut recorder = Recorder::create(&bench.path("both"), &spec).expect("new");
    for number in 0..60_u8 {
        let force = 0.4 + 0.4 * f64::from(number % 5);
        let numbers = [100.0, 60.0, 30.0, 10.0].map(|gain| {
            let flicker = f64::from(number % 7);
            single(500.0 + gain * force + flicker)
        });
        let sample = Sample::new(format!("s{number:02}"))
            .with_point_id(format!("p{}", number / 5))
            .with_frame(Frame::new(pixels, vec![number; 256]).expect("whole"))
            .with_signals(Signals::new(taxels, numbers.to_vec()).expect("whole"))
            .with_truth(Readings::from_values([force]));
        recorder.append(&sample).expect("recorded");
    }
    recorder.close().expect("closed");
}

#[test]
fn a_scene_whose_model_reads_signals_is_planned_tested_and_shown_with_faults_of_taxels() {
    let bench = Bench::new();
    record_both(&bench);
    bench.write(
        "both.toml",
        r#"scene_version = 1
name = "both"
sensor = { dataset = "both" }
metrics = { want = ["mae"] }
model = { name = "ridge", set = { input = "signals" } }
stress = { severities = [5] }
"#,
    );
    let planned = bench.run("plan both.toml");
    assert_eq!(planned.code, 0, "{}", planned.err);
    let expected =
        "3 faults of 1 severity on the samples of the test part, each read once more; no press";
    assert!(planned.err.contains(expected), "{}", planned.err);
    bench.ok("run both.toml --out r -q");
    let text = fs::read_to_string(bench.path("r/stress/1-both.json")).expect("written");
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    crate::schema::check("stress", &report);
    assert_eq!(report["input"], "signals");
    assert_eq!(report["list"]["name"], "taxel_dead,taxel_gain");
    assert_eq!(report["skipped"][0]["fault"], "taxel_drift");
    let page = fs::read_to_string(bench.path("r/report.html")).expect("a page");
    assert!(page.contains("faults of their signals."), "{page}");
    assert!(page.contains("check of signals"), "{page}");
}
