//! `capture --model` and `preview --model`: predictions over the picture, at the terminal and beside the recording,
//! labelled as predictions everywhere.

use std::time::Duration;

use taceva_core::random::SplitMix64;
use taceva_core::{Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample};
use taceva_dataset::{
    Dataset, Digest, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source,
};

use super::broken::{camera, changing_camera};
use crate::support::Bench;
use crate::support::emulated::{Emulated, Running};
use crate::waiting::page::Page;

/// Writes a recording of noise, in which the first pixel of a frame determines the force.
fn write_recording(bench: &Bench, name: &str, info: FrameInfo, rows: u32) {
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("gel"));
    let channels = Channels::new([Channel::FZ, Channel::PX]).expect("two");
    let spec = RecordingSpec::new(facts, channels);
    let mut recorder = Recorder::create(&bench.path(name), &spec).expect("begun");
    let mut random = SplitMix64::new(7);
    for row in 0..rows {
        let bytes = info.byte_len().expect("small");
        let pixels: Vec<u8> = (0..bytes)
            .map(|_| 60 + random.next_u64().to_le_bytes()[0] % 20)
            .collect();
        let force = f64::from(pixels[0]) / 100.0;
        let frame = Frame::new(info, pixels).expect("whole");
        let sample = Sample::new(format!("row-{row}"))
            .with_point_id(format!("point-{row}"))
            .with_truth(Readings::from_values([force, 0.1 * f64::from(row)]))
            .with_frame(frame);
        recorder.append(&sample).expect("recorded");
    }
    recorder.close().expect("closed");
}

/// Fits a model on `rows` frames of the format `info`, and writes it to NAME.taceva.
fn fit_for(bench: &Bench, name: &str, info: FrameInfo, rows: u32) {
    write_recording(bench, name, info, rows);
    bench.ok(&format!(
        "fit {name} --model ridge --set size=4x3 --split all --no-cache --out {name}.taceva -q"
    ));
}

/// Captures two frames of a sensor, and returns their size and format.
fn info_of(bench: &Bench, sensor: &str, name: &str) -> FrameInfo {
    bench.ok(&format!("capture {name} --sensor {sensor} --frames 2 -q"));
    let dataset = Dataset::open(&bench.path(name)).expect("whole");
    dataset.frame(0).expect("read").expect("a frame").info()
}

#[test]
fn a_model_of_hand_presses_predicts_what_the_transducer_measures_on_a_page_and_beside_the_recording()
 {
    let emulated = Emulated::new();
    let bench = Bench::new();
    bench.write("hand.toml", &emulated.rig());
    let mut robot = emulated.robot();
    let mut presses = |depths_mm: &[f64]| {
        for (number, depth_mm) in depths_mm.iter().enumerate() {
            let place = f64::from(u8::try_from(number).expect("few")) * 0.6 - 1.5;
            emulated.press(&mut robot, [place, 0.5 * place], *depth_mm, || {
                std::thread::sleep(Duration::from_millis(350));
            });
        }
    };
    let running = Running::start(&bench, "capture presses --rig hand.toml --for 120s");
    running.until_it_says("press; Ctrl-C");
    presses(&[0.3, 0.5, 0.4, 0.6, 0.35, 0.55]);
    running.interrupt();
    running.ended();
    bench.ok("fit presses --model ridge --set size=8x6 --split all --no-cache --out m.taceva -q");
    let digest = Digest::of(&std::fs::read(bench.path("m.taceva")).expect("a model"));

    let words = "capture more --rig hand.toml --model m.taceva --for 120s";
    let running = Running::start(&bench, words);
    let page = Page::of(&running);
    running.until_it_says("press; Ctrl-C");
    let said = String::from_utf8_lossy(&page.until("/frames", b"\r\nX-Taceva-Prediction: {"))
        .into_owned()
        + &String::from_utf8_lossy(&page.until("/events", b"\"predicted_by\":\"ridge sha256:"));
    assert!(said.contains("image/jpeg"), "{said}");
    presses(&[0.45, 0.5]);
    running.interrupt();
    let ran = running.ended();
    for words in [
        "predicted, not measured, by ridge sha256:",
        "predictions by ridge sha256:",
        "frames seen",
        "dropped for newer frames",
        "of their stamps",
        "were unlike the training pictures",
        "more/predictions.csv: predictions by ridge sha256:",
    ] {
        assert!(ran.err.contains(words), "`{words}` in {}", ran.err);
    }

    let dataset = Dataset::open(&bench.path("more")).expect("whole");
    dataset.verify_frames().expect("as it was written");
    let header = dataset.header();
    let predictions = header.predictions.as_ref().expect("predictions");
    assert_eq!(
        (predictions.by.as_str(), predictions.model),
        ("ridge", digest)
    );
    let names: Vec<&str> = header.channels.iter().map(Channel::name).collect();
    assert_eq!(
        names,
        ["Fx", "Fy", "Fz"],
        "labels are those of the transducer"
    );
    let mut reader = csv::Reader::from_path(bench.path("more/predictions.csv")).expect("a table");
    let head = reader.headers().expect("names").clone();
    assert_eq!(
        head.iter().collect::<Vec<_>>(),
        ["sample", "t_s", "distance", "Fx", "Fy", "Fz"]
    );
    let table = dataset.table();
    let fz = table.channels().position("Fz").expect("measured");
    let mut errors_n = Vec::new();
    let mut rows = 0;
    for record in reader.records() {
        let record = record.expect("a line");
        let row = table
            .samples()
            .iter()
            .position(|sample| *sample == record[0]);
        let row = row.expect("a recorded frame");
        rows += 1;
        assert_eq!(
            table.t_s()[row],
            record[1].parse().ok(),
            "of the frame itself"
        );
        let predicted: f64 = record[5].parse().expect("a number");
        if let Some(measured) = table.truth(fz).get(row).filter(|measured| *measured > 0.3) {
            errors_n.push((predicted - measured).abs());
        }
    }
    assert_eq!(rows, predictions.rows);
    errors_n.sort_unstable_by(f64::total_cmp);
    let median = errors_n[errors_n.len() / 2];
    assert!(
        errors_n.len() > 5 && median < 0.3,
        "{median} N of {}",
        errors_n.len()
    );
    // Changed predictions no longer belong to the recording.
    std::fs::write(bench.path("more/predictions.csv"), "sample\n").expect("written");
    assert!(dataset.verify_frames().is_err());

    let running = Running::start(&bench, "preview --rig hand.toml --model m.taceva");
    let page = Page::of(&running);
    page.until("/frames", b"X-Taceva-Prediction: {");
    page.until("/events", b"\"predicted\":{\"seen\":");
    std::thread::sleep(Duration::from_millis(500));
    page.stop();
    let ran = running.ended();
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(
        ran.err.contains(" sent to a browser, 95 % within "),
        "{}",
        ran.err
    );
    assert!(ran.err.contains("predicted, not measured"), "{}", ran.err);
}

#[test]
fn every_frame_of_a_simulated_sensor_is_predicted_and_what_is_unlike_the_training_lies_outside() {
    let bench = Bench::new();
    let sensor = "sim/gelsight:seed=3";
    let info = info_of(&bench, sensor, "look");
    fit_for(&bench, "noise", info, 40);
    let ran = bench.run(&format!(
        "capture seen --sensor {sensor} --frames 12 --model noise.taceva"
    ));
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(
        ran.err.contains("0 dropped for newer frames"),
        "{}",
        ran.err
    );
    let dataset = Dataset::open(&bench.path("seen")).expect("whole");
    let header = dataset.header();
    assert_eq!(header.predictions.as_ref().expect("some").rows, 12);
    assert!(header.channels.is_empty(), "a prediction is no label");
    assert!(
        ran.err
            .contains("(100.0 %) were unlike the training pictures"),
        "{}",
        ran.err
    );
    let text = std::fs::read_to_string(bench.path("seen/predictions.csv")).expect("a table");
    assert!(
        text.starts_with("sample,t_s,distance,Px,Fz\nframe-000001,"),
        "{text}"
    );
    let header = std::fs::read_to_string(bench.path("seen/dataset.toml")).expect("a header");
    assert!(
        header.contains("[predictions]\nby = \"ridge\"\nmodel = \"sha256:"),
        "{header}"
    );
}

#[test]
fn a_model_of_few_samples_says_that_it_does_not_know_what_it_has_seen() {
    let bench = Bench::new();
    let sensor = "sim/gelsight:seed=3";
    let info = info_of(&bench, sensor, "look");
    fit_for(&bench, "few", info, 12);
    let ran = bench.run(&format!(
        "capture seen --sensor {sensor} --frames 3 --model few.taceva"
    ));
    assert_eq!(ran.code, 0, "{}", ran.err);
    for words in ["has no record of its training pictures", "is unknown"] {
        assert!(ran.err.contains(words), "{}", ran.err);
    }
    let text = std::fs::read_to_string(bench.path("seen/predictions.csv")).expect("a table");
    let row = text.lines().nth(1).expect("a row");
    assert_eq!(row.split(',').nth(2), Some(""), "no distance: {row}");
}

#[test]
fn what_is_no_model_of_such_frames_is_refused_before_anything_is_made() {
    let bench = Bench::new();
    let sensor = "sim/gelsight:seed=3";
    let info = info_of(&bench, sensor, "look");
    let smaller = FrameInfo {
        width: 32,
        height: 24,
        format: PixelFormat::Gray8,
    };
    fit_for(&bench, "small", smaller, 30);
    write_recording(&bench, "like", info, 30);
    bench.ok("fit like --model baseline --split all --no-cache --out baseline.taceva -q");
    bench.write("text.taceva", "Fz = 1\n");
    let both = format!("fitted on frames of {smaller}, but the camera gives {info}");
    for (model, said) in [
        ("small.taceva", both.as_str()),
        ("baseline.taceva", "predicts a constant"),
        ("text.taceva", "text.taceva"),
        ("none.taceva", "cannot read model none.taceva"),
        ("look", "not a regular file"),
    ] {
        for command in ["capture out", "preview"] {
            bench.refused(
                &format!("{command} --sensor {sensor} --model {model}"),
                3,
                said,
            );
            assert!(!bench.path("out").exists(), "{command} {model}");
        }
    }
    bench.refused(
        "capture out --sensor sim/gelsight --port 8000",
        2,
        "--model",
    );
    bench.refused("capture out --close --model small.taceva", 2, "--model");
}

#[test]
fn a_camera_that_changes_its_size_or_goes_ends_a_preview_by_name_and_what_was_seen_is_summed_up() {
    let bench = Bench::new();
    let address = changing_camera(60);
    let sensor = format!("camera/mjpeg:url=http://{address}/");
    let info = info_of(&bench, &sensor, "look");
    fit_for(&bench, "model", info, 30);
    let ran = bench.run(&format!("preview --sensor {sensor} --model model.taceva"));
    assert_eq!(ran.code, 4, "{}", ran.err);
    for words in [
        "changed to frames of 48×24",
        "predictions by ridge",
        "frames seen",
    ] {
        assert!(ran.err.contains(words), "`{words}` in {}", ran.err);
    }
    let emulated = Emulated::new();
    let sensor = emulated.sensor();
    let info = info_of(&bench, &sensor, "gel");
    fit_for(&bench, "gone", info, 30);
    let words = format!("preview --sensor {sensor} --model gone.taceva");
    let running = Running::start(&bench, &words);
    let page = Page::of(&running);
    page.until("/frames", b"X-Taceva-Prediction: {");
    emulated.without_camera();
    let ran = running.ended();
    assert_eq!(ran.code, 4, "{}", ran.err);
    for words in ["camera/mjpeg", "predictions by ridge", "sent to a browser"] {
        assert!(ran.err.contains(words), "`{words}` in {}", ran.err);
    }
}

#[test]
fn of_a_camera_slower_than_the_model_no_frame_is_dropped() {
    let bench = Bench::new();
    let address = camera(Duration::from_millis(200), |_| 32);
    let sensor = format!("camera/mjpeg:url=http://{address}/");
    let info = info_of(&bench, &sensor, "look");
    fit_for(&bench, "model", info, 30);
    let words = format!("capture slow --sensor {sensor} --frames 10 --model model.taceva");
    let ran = bench.run(&words);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(
        ran.err.contains("0 dropped for newer frames"),
        "{}",
        ran.err
    );
    let dataset = Dataset::open(&bench.path("slow")).expect("whole");
    let predictions = dataset.header().predictions.as_ref().expect("some");
    assert_eq!(predictions.rows, 10);
}
