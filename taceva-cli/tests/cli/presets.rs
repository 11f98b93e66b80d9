//! Presets, which are names for a model with its settings, and the model `auto`.

use std::fs;
use std::path::Path;

use taceva_core::{Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample};
use taceva_dataset::{Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
use taceva_models::{Model, Models};

use crate::support::Bench;

#[test]
fn a_preset_is_fitted_and_reported_as_its_model_with_its_settings() {
    let bench = Bench::new();
    bench.record("data", 64);
    let short = "--set epochs=1 --set batch=4 --metrics mae";
    let found = bench.json(&format!(
        "evaluate data --model fast --split by-point --set jitter=0 {short}"
    ));
    let model = &found["provenance"]["model"];
    assert_eq!(model["name"], "cnn", "{model}");
    for (key, value) in [
        ("jitter", "0"),
        ("appearance", "auto"),
        ("size", "up-to-80x60"),
        ("features", "64×60 gray"),
    ] {
        assert_eq!(model["settings"][key], value, "{model}");
    }
    // The model with these settings gives the same result.
    let spelt = "--set size=up-to-80x60 --set color=auto --set difference=in-color --set appearance=auto --set jitter=0";
    let same = bench.json(&format!(
        "evaluate data --model cnn --split by-point {spelt} {short}"
    ));
    assert_eq!(found, same);
    let said = bench.ok("fit data --model fast --set epochs=1 --set batch=4 --out m.safetensors");
    assert!(
        said.contains(
            "settings appearance=auto batch=4 color=auto difference=in-color epochs=1 size=up-to-80x60"
        ),
        "{said}"
    );
    bench.refused("evaluate data --model fats", 2, "did you mean `fast`?");
    bench.refused(
        "evaluate data --model fast --set strength=1",
        2,
        "`strength`: unknown key",
    );
}

#[test]
fn a_preset_sees_no_more_cells_than_frames_have_pixels_where_its_model_would_refuse_them() {
    let bench = Bench::new();
    bench.record("data", 24);
    let short = "--set epochs=1 --set batch=4 --metrics mae";
    for preset in ["fast", "default"] {
        let found = bench.json(&format!(
            "evaluate data --model {preset} --split by-point {short}"
        ));
        let settings = &found["provenance"]["model"]["settings"];
        assert_eq!(settings["features"], "24×24 gray", "{settings}");
    }
    bench.refused(&format!("evaluate data --model cnn {short}"), 3, "128×96");
}

/// Scene with a few presses of a gel with coloured lamps.
const COLORED: &str = r#"
scene_version = 1
name = "colored"
seed = 1
[sensor]
driver = "sim/magictac:reduction=8;bits=8"
[robot]
driver = "sim/robot"
[force]
driver = "sim/force-transducer"
[metrics]
want = ["accuracy"]
[protocol.calibration]
points = 12
indentations = 1
[model]
name = "fast"
set = { epochs = 1, batch = 8 }
"#;

#[test]
fn a_preset_keeps_the_colours_of_frames_less_those_without_contact_and_their_light() {
    let bench = Bench::new();
    bench.write("colored.toml", COLORED);
    bench.ok("run colored.toml --out ran");
    let recordings = fs::read_dir(bench.path("ran/recordings")).expect("a folder");
    let recording = recordings.into_iter().next().expect("one").expect("one");
    let recording = format!("ran/recordings/{}", recording.file_name().display());
    let short = "--set epochs=1 --set batch=8 --metrics mae --split by-point";
    let found = bench.json(&format!("evaluate {recording} --model fast {short}"));
    let features = |found: &serde_json::Value| {
        found["provenance"]["model"]["settings"]["features"].to_string()
    };
    let said = features(&found);
    assert!(
        said.ends_with(" rgb, difference from the reference\""),
        "{said}"
    );
    // The same settings, written out, give the same scores.
    let size = said.trim_matches('"').split(' ').next().expect("a size");
    let spelt = format!(
        "--set size={} --set color=rgb --set difference=true --set appearance=light",
        size.replace('×', "x")
    );
    let same = bench.json(&format!("evaluate {recording} --model cnn {spelt} {short}"));
    assert_eq!(found["scores"], same["scores"]);
    let gray = bench.json(&format!(
        "evaluate {recording} --model fast --set color=gray --set difference=false {short}"
    ));
    assert!(features(&gray).ends_with(" gray\""), "{}", features(&gray));
}

#[test]
fn a_model_left_open_says_what_was_tried_and_what_a_network_would_have_taken() {
    let bench = Bench::new();
    bench.record("data", 128);
    let found =
        bench.json("evaluate data --model auto --split by-point --set budget_s=0.5 --metrics mae");
    let notes = found["provenance"]["notes"].as_array().expect("a list");
    let mut notes = notes.iter().filter_map(|note| note.as_str());
    let note = notes.find(|note| note.starts_with("auto chose "));
    let note = note.expect("it says how");
    assert!(note.contains("; not tried: "), "{note}");
    assert!(note.contains("of budget_s=0.5 are left"), "{note}");
    bench.refused(
        "evaluate data --model auto --set budget_s=-3",
        2,
        "expected a number from 0 to 1e6",
    );
}

/// Frames of 128×96 pixels, the input of the small network. All other models read 32×32 gray cells of 4×3 pixels each.
const fn closer(format: PixelFormat) -> FrameInfo {
    FrameInfo {
        width: 128,
        height: 96,
        format,
    }
}

/// Values of a gray pixel. The labelled half has stripes one pixel wide, so that every cell of 4×3 pixels has the same mean in both halves.
fn striped(is_labelled: bool, x: u32) -> Vec<u32> {
    vec![match (is_labelled, x % 2) {
        (false, _) => 130,
        (true, 0) => 100,
        (true, _) => 160,
    }]
}

/// Values of a colour pixel. The labelled half has more red and blue and less green than the other half, at equal brightness.
fn colored(is_labelled: bool, _: u32) -> Vec<u32> {
    match is_labelled {
        true => vec![130 + 34, 130 - 28, 130 + 55],
        false => vec![130 - 34, 130 + 28, 130 - 55],
    }
}

/// Records pictures in which one half is labelled. `pixel` returns the values of a pixel in either half.
fn record_halves(path: &Path, info: FrameInfo, pixel: fn(bool, u32) -> Vec<u32>) {
    let sensor = SensorFacts::new("drawn").with_serial("1").with_gel("1");
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, sensor);
    let channels = Channels::new([Channel::PX]).expect("one channel");
    let mut recorder =
        Recorder::create(path, &RecordingSpec::new(facts, channels)).expect("a new recording");
    for number in 0..60_u32 {
        // The halves do not alternate.
        let is_right = number * 7 % 10 < 5;
        let mut bytes = Vec::new();
        for y in 0..info.height {
            for x in 0..info.width {
                let noise = (x * 7919 + y * 104_729 + number * 1_299_709) % 7;
                let numbers = pixel((x >= info.width / 2) == is_right, x);
                let bytes_of = |number| u8::try_from(number + noise).expect("a byte");
                bytes.extend(numbers.into_iter().map(bytes_of));
            }
        }
        let frame = Frame::new(info, bytes).expect("whole");
        let place = if is_right { 2.0 } else { -2.0 };
        let sample = Sample::new(format!("s{number:02}")).with_frame(frame);
        recorder
            .append(&sample.with_truth(Readings::from_values([place])))
            .expect("recorded");
    }
    recorder.close().expect("closed");
}

/// Fits `auto` and `default`, and checks that `auto` chose the network of `default`, the only model that sees the difference.
fn assert_auto_takes_the_default(info: FrameInfo, pixel: fn(bool, u32) -> Vec<u32>, seen: &str) {
    let bench = Bench::new();
    record_halves(&bench.path("data"), info, pixel);
    // 54 training samples, so that three folds of five fill a batch. Both fits run at once, because each trains a
    // network to its end.
    let fits = ["auto", "default"].map(|model| {
        let words = format!("fit data --model {model} --out {model}.model -q");
        let mut command = bench.command(&words);
        let fit = command.args(["--split", "random 90/5/5"]).spawn();
        fit.expect("the program starts")
    });
    for mut fit in fits {
        assert!(fit.wait().expect("ends").success());
    }
    let open = |name: &str| -> Model {
        let models = Models::builtin();
        models.open(&bench.path(name)).expect("a model")
    };
    let (auto, named) = (open("auto.model"), open("default.model"));
    let card = auto
        .card()
        .auto
        .as_ref()
        .expect("it says how it was chosen");
    assert_eq!(card.taken, "cnn", "{card}");
    assert_eq!(named.card().auto, None);
    // The chosen model equals the named one, to the last bit.
    assert_eq!(auto.card().model, named.card().model);
    assert_eq!(auto.card().features.to_string(), seen);
    assert_eq!(auto.card().features, named.card().features);
    assert_eq!(auto.regressor(), named.regressor());
    // The other models saw nothing, so the network had its own input during the choice too.
    let others = card.tried.iter().filter(|trial| trial.model != "cnn");
    let network = card.best().expect("tried");
    for other in others {
        assert!(other.error > 3.0 * network.error, "{card}");
    }
}

#[test]
fn a_network_that_a_model_left_open_takes_sees_the_finer_features_it_would_by_name() {
    assert_auto_takes_the_default(closer(PixelFormat::Gray8), striped, "128×96 gray");
}

#[test]
fn a_network_that_a_model_left_open_takes_sees_the_colours_it_would_by_name() {
    assert_auto_takes_the_default(closer(PixelFormat::Rgb8), colored, "128×96 rgb");
}

#[test]
fn the_help_of_models_says_what_each_preset_is() {
    let bench = Bench::new();
    let help = bench.ok("fit --help");
    let words: Vec<&str> = help.split_whitespace().collect();
    let help = words.join(" ");
    for preset in taceva_models::PRESETS {
        let said = match preset.settings {
            [] => format!("{}: {} as it is", preset.name, preset.model),
            _ => preset.to_string().replacen(" size", " with size", 1),
        };
        assert!(help.contains(&said), "{said}: {help}");
    }
}
