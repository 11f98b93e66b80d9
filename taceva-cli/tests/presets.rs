//! Names for a model with settings, and the model that is left open.

mod support;

use support::Bench;

#[test]
fn a_preset_is_fitted_and_reported_as_its_model_with_its_settings() {
    let bench = Bench::new();
    bench.record("data", 64);
    let short = "--set epochs=1 --set batch=4 --metrics mae";
    let found = bench.json(&format!(
        "evaluate data --model fast --set jitter=0 {short}"
    ));
    let model = &found["provenance"]["model"];
    assert_eq!(model["name"], "cnn", "{model}");
    for (key, value) in [
        ("jitter", "0"),
        ("local_mean", "3"),
        ("size", "64x48"),
        ("features", "64×48 gray"),
    ] {
        assert_eq!(model["settings"][key], value, "{model}");
    }
    // By its model and its settings the same comes out.
    let spelt = "--set size=64x48 --set local_mean=3 --set jitter=0";
    let same = bench.json(&format!("evaluate data --model cnn {spelt} {short}"));
    assert_eq!(found, same);
    let said = bench.ok("fit data --model fast --set epochs=1 --set batch=4 --out m.safetensors");
    assert!(
        said.contains("settings batch=4 epochs=1 jitter=2 local_mean=3 size=64x48"),
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
fn a_model_left_open_says_what_was_tried_and_what_a_network_would_have_taken() {
    let bench = Bench::new();
    bench.record("data", 128);
    let found = bench.json("evaluate data --model auto --set budget_s=0.5 --metrics mae");
    let notes = found["provenance"]["notes"].as_array().expect("a list");
    let mut notes = notes.iter().filter_map(|note| note.as_str());
    let note = notes.find(|note| note.starts_with("auto took "));
    let note = note.expect("it says how");
    assert!(note.contains("; not tried: "), "{note}");
    assert!(note.contains("of budget_s=0.5 are left"), "{note}");
    bench.refused(
        "evaluate data --model auto --set budget_s=-3",
        2,
        "expected a number from 0 to 1e6",
    );
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
