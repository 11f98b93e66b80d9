//! Faults of pictures, scored with a fitted model.

mod options;
mod taxels;

use std::fs;
#[cfg(target_os = "linux")]
use std::path::Path;
#[cfg(target_os = "linux")]
use std::process::Command;

#[cfg(target_os = "linux")]
use taceva_needs::{Need, skip};

use crate::support::Bench;

/// Test folder with the recordings `seen` and `unseen`, and a model fitted on `seen`.
fn bench() -> Bench {
    let bench = Bench::new();
    bench.record_with_noise("seen", 24, 0);
    bench.record_with_noise("unseen", 24, 3);
    bench.ok("fit seen --model ridge --set size=8x8 --out m.taceva -q");
    bench
}

const STRESS: &str = "stress unseen --model m.taceva --faults defocus,stale_frames --severity 1,4";

#[test]
fn json_has_the_published_form_and_says_that_nothing_was_measured() {
    let bench = bench();
    let report = bench.json(STRESS);
    crate::schema::check("stress", &report);
    assert_eq!(report["list"]["name"], "defocus,stale_frames");
    let said = report["not_measured"].as_str().expect("drawn pictures");
    assert!(said.contains("synthetic"), "{said}");
    // The drawn recording has no reference frame.
    assert_eq!(report["untouched"], "least load");
    assert!(report["unnoticed"].is_null());
    let whole = bench.json("stress unseen --model m.taceva --by parameter");
    crate::schema::check("stress", &whole);
    assert_eq!(whole["list"]["name"], "gel-12/1");
    assert_eq!(whole["faults"].as_array().map(Vec::len), Some(12));
}

#[test]
fn the_table_has_a_row_for_each_severity_and_states_where_skill_ends() {
    let bench = bench();
    let words = STRESS.replace("1,4", "1,4 --by parameter");
    for format in ["text", "md"] {
        let said = bench.ok(&format!("{words} --format {format} -q"));
        let rows = said.lines().filter(|line| line.contains("defocus "));
        assert!(rows.count() >= 2, "{said}");
        assert!(said.contains("skill ends at severity"), "{said}");
        assert!(
            said.contains("mean degradation D over severity 1, 4:"),
            "{said}"
        );
        // The drawn recording has no untouched picture.
        assert!(
            said.contains("removes is unknown: no untouched picture"),
            "{said}"
        );
        assert!(said.contains("Nothing here was measured"), "{said}");
    }
    let csv = bench.ok(&format!("{words} --format csv -q"));
    assert!(csv.starts_with("fault,severity,parameter,stimulus,untouched,channel,quantity,value"));
    let rows = csv.lines().skip(1);
    assert!(rows.clone().all(|row| row.ends_with(",synthetic")), "{csv}");
    assert!(
        rows.clone().any(|row| row.starts_with("defocus,4,0.016,")),
        "{csv}"
    );
    for quantity in ["breaks_at", "check", "note"] {
        let named = format!(",{quantity},");
        assert!(rows.clone().any(|row| row.contains(&named)), "{csv}");
    }
    let stale = rows.clone().filter(|row| row.contains(",stale,"));
    assert!(stale.count() > 0, "{csv}");
}

#[test]
fn the_end_of_skill_is_bounded_by_the_tested_severities_alone() {
    let bench = bench();
    let said = bench
        .ok("stress unseen --model m.taceva --faults stale_frames --severity 1 --by parameter -q");
    assert!(!said.contains("never"), "{said}");
    bench.ok("fit seen --model baseline --out constant.taceva -q");
    let said = bench
        .ok("stress unseen --model constant.taceva --faults dust --severity 2 --by parameter -q");
    assert!(said.contains("no skill even without the fault"), "{said}");
    let remedy = "of a map names a picture without contact.";
    assert!(said.contains(remedy), "{said}");
}

#[test]
fn csv_names_severities_that_are_not_possible_and_draws_of_places() {
    let bench = bench();
    let csv = bench.ok("stress unseen --model m.taceva --faults defocus,dust --format csv -q");
    assert!(csv.contains(",unreached,"), "{csv}");
    assert!(csv.contains("one draw of places"), "{csv}");
}

#[test]
fn several_draws_of_places_are_stated_with_their_spread() {
    let bench = bench();
    let words = "stress unseen --model m.taceva --faults tear,defocus --severity 3 --by parameter";
    let report = bench.json(&format!("{words} --draws 3"));
    crate::schema::check("stress", &report);
    assert_eq!(report["draws"], 3);
    let spread = |fault: usize| &report["faults"][fault]["severities"][0]["stale"]["Fz"]["spread"];
    assert!(spread(0).is_null(), "blur has no places");
    assert_eq!(spread(1).as_array().map(Vec::len), Some(2));
    let said = bench.ok(&format!("{words} --draws 3 -q"));
    assert!(said.contains("3 draws of places"), "{said}");
    assert!(said.contains("single draws of severity 3: Fz "), "{said}");
    let csv = bench.ok(&format!("{words} --draws 3 --format csv -q"));
    assert!(csv.contains(",greatest_of_draws,"), "{csv}");
    assert_eq!(bench.run(&format!("{words} --draws 0")).code, 2);
}

#[test]
fn a_figure_shows_the_growth_by_fault_and_severity() {
    let bench = bench();
    let words = format!("{STRESS} --by parameter --svg faults.svg");
    bench.ok(&format!("{words} -q"));
    let svg = fs::read_to_string(bench.path("faults.svg")).expect("written");
    assert!(svg.contains("defocus, severity 4: "), "{svg}");
    assert!(!svg.contains("defocus, severity 3: "), "not tested");
    bench.refused(&words, 3, "faults.svg exists already; --force replaces it");
}

#[test]
fn a_page_of_its_own_has_the_section_on_faults() {
    let bench = bench();
    let words = format!("{STRESS} --by parameter --html faults.html");
    let said = bench.ok(&format!("{words} -q"));
    assert!(said.contains("skill ends at severity"), "{said}");
    let page = fs::read_to_string(bench.path("faults.html")).expect("written");
    for words in [
        "<h2 id=\"h-faults\">Faults</h2>",
        "drawn: errors with faults",
        "defocus, severity 4: ",
        "mean degradation over all faults: ",
        "Nothing here was measured",
    ] {
        assert!(page.contains(words), "{words} in {page}");
    }
    bench.refused(&words, 3, "faults.html exists already; --force replaces it");
}

#[test]
fn a_result_is_written_to_a_file_once() {
    let bench = bench();
    let words = format!("{STRESS} --format json --out stress.json");
    bench.ok(&format!("{words} -q"));
    let text = fs::read_to_string(bench.path("stress.json")).expect("written");
    assert!(text.contains("taceva.stress/1"), "{text}");
    bench.refused(&words, 3, "stress.json exists already; --force replaces it");
}

#[test]
fn explain_names_faults_and_pictures_and_the_origin() {
    let said = bench().ok(&format!("{STRESS} --explain"));
    assert!(said.contains("60 frames of the part `all`"), "{said}");
    assert!(said.contains("fault    defocus: the lens"), "{said}");
    assert!(said.contains("synthetic"), "{said}");
}

#[test]
fn the_help_lists_all_faults_and_only_parts_that_are_accepted() {
    let said = Bench::new().ok("stress --help");
    let faults = taceva_stress::FAULTS.into_iter();
    let others = faults.chain(taceva_stress::RECORDING_FAULTS);
    let others = others.chain(taceva_stress::TAXEL_FAULTS);
    for fault in others.chain(taceva_stress::TIME_FAULTS) {
        let named = format!("  {} ", fault.id);
        assert!(said.contains(&named), "{named}: {said}");
    }
    assert!(said.contains("Unseen samples of the recording"), "{said}");
    assert!(!said.contains("validation"), "{said}");
}

#[test]
fn wrong_faults_severities_models_and_seen_samples_are_refused_by_name() {
    let bench = bench();
    let stress = "stress unseen --model m.taceva";
    bench.refused(
        &format!("{stress} --faults defocsu"),
        2,
        "fault `defocsu`: unknown, did you mean `defocus`?",
    );
    for severity in ["0", "6", "high"] {
        let expected = format!("severity `{severity}`: expected numbers from 1 to 5");
        bench.refused(&format!("{stress} --severity {severity}"), 2, &expected);
    }
    bench.refused(
        "stress unseen --model ridge",
        2,
        "--model ridge: no such file",
    );
    bench.refused(
        "stress seen --model m.taceva --part all",
        2,
        "part `all`: the model was fitted on these samples",
    );
    bench.ok("fit seen --model ridge --set size=8x8 --split all --out whole.taceva -q");
    for part in ["", " --part test"] {
        bench.refused(
            &format!("stress seen --model whole.taceva{part}"),
            2,
            "fitted on every sample of this recording, so its errors without a fault are too small; stress it on another recording",
        );
    }
    bench.refused("stress nowhere --model m.taceva", 3, "nowhere");
}

#[test]
fn a_fault_of_a_gel_is_refused_with_the_line_of_a_scene_that_tests_it() {
    bench().refused(
        "stress unseen --model m.taceva --faults tear,temperature",
        2,
        "fault `temperature`: only the simulated bench has this fault of the gel; write in a scene with a simulated sensor: stress = { faults = [\"temperature\"] }",
    );
}

#[test]
fn a_fault_of_a_plugin_that_is_not_installed_or_has_a_name_of_the_program_is_refused() {
    let bench = bench();
    let stress = "stress unseen --model m.taceva";
    bench.refused(
        &format!("{stress} --faults tear,org.example.fogged-lens/fog"),
        2,
        "--faults `org.example.fogged-lens/fog`: no plugin has this estimator",
    );
    for key in ["org.example.lens/dust", "org.example.gel/temperature"] {
        let expected = format!("`{key}`: another fault is called");
        bench.refused(&format!("{stress} --faults {key}"), 2, &expected);
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_fault_of_a_plugin_is_tested_by_its_key_beside_the_others() {
    let bench = bench();
    bench.make_example("estimator", "fogged-lens");
    let stress = "stress unseen --model m.taceva --by parameter --plugin-dir fogged-lens";
    let words = format!("{stress} --faults dust,org.example.fogged-lens/fog --severity 1,4");
    let report = bench.json(&words);
    crate::schema::check("stress", &report);
    assert_eq!(report["list"]["name"], "dust,fog");
    let severities = &report["faults"][1]["severities"];
    let stimulus = |at: usize| severities[at]["stimulus"].as_f64().expect("a number");
    assert!(0.0 < stimulus(0) && stimulus(0) < stimulus(1), "{report}");
    let said = bench.ok(&format!("{words} --explain"));
    assert!(
        said.contains("fog: a fault of the plugin org.example.fogged-lens/fog"),
        "{said}"
    );
    // Alone, it is the only fault.
    let alone = bench.json(&format!(
        "{stress} --faults org.example.fogged-lens/fog --severity 1"
    ));
    assert_eq!(alone["list"]["name"], "fog");
}

/// Builds the C example in the folder `fog` with the commands of its README, with `from` in its source replaced by `to`. False without a C compiler.
#[cfg(target_os = "linux")]
fn builds_in_c(bench: &Bench, from: &str, to: &str) -> bool {
    if let Err(error) = Command::new("cc").arg("--version").output() {
        skip(Need::CCompiler, format!("`cc`: {error}"));
        return false;
    }
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/plugins/fogged-lens-c");
    let read = |file: &str| fs::read_to_string(example.join(file)).expect(file);
    let source = read("fog.c");
    assert!(source.contains(from), "{source}");
    bench.write("fog/fog.c", &source.replace(from, to));
    bench.write("fog/plugin.toml", &read("plugin.toml"));
    let page = read("README.md");
    let commands = page.split("```").nth(1).expect("commands").trim();
    let built = bench.shell(&format!("cd fog && {}", commands.replace('\n', " && ")));
    assert_eq!(built.code, 0, "{}{}", built.out, built.err);
    true
}

#[test]
#[cfg(target_os = "linux")]
fn a_fault_of_a_plugin_in_c_is_built_and_tested_as_its_page_says() {
    let bench = bench();
    if !builds_in_c(&bench, "", "") {
        return;
    }
    let report = bench.json(
        "stress unseen --model m.taceva --faults org.example.fogged-lens-c/fog --severity 1,4 --by parameter --plugin-dir fog",
    );
    assert_eq!(report["list"]["name"], "fog");
    let severities = &report["faults"][0]["severities"];
    let stimulus = |at: usize| severities[at]["stimulus"].as_f64().expect("a number");
    assert!(0.0 < stimulus(0) && stimulus(0) < stimulus(1), "{report}");
}

#[test]
#[cfg(target_os = "linux")]
fn a_plugin_that_returns_nan_fails_by_name_the_other_faults_go_on_and_the_exit_code_is_4() {
    let bench = bench();
    let of_pixel = "mean + it->left * (features[at] - mean)";
    if !builds_in_c(&bench, of_pixel, "it->left * (mean - mean) / (mean - mean)") {
        return;
    }
    let ran = bench.run(
        "stress unseen --model m.taceva --faults dust,org.example.fogged-lens-c/fog --severity 1,4 --by parameter --plugin-dir fog --format json --out s.json",
    );
    assert_eq!(ran.code, 4, "{}", ran.err);
    assert!(ran.err.contains("fault fog failed: "), "{}", ran.err);
    let text = fs::read_to_string(bench.path("s.json")).expect("complete");
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    crate::schema::check("stress", &report);
    assert_eq!(report["faults"].as_array().map(Vec::len), Some(1));
    assert_eq!(report["faults"][0]["id"], "dust");
    assert_eq!(report["failed"][0]["fault"], "fog");
}

#[test]
fn a_choice_for_a_rugged_sensor_reads_results_with_faults_and_names_untested_sensors() {
    let bench = bench();
    bench.ok(
        "stress unseen --model m.taceva --faults dust --by parameter --format json --out s.json -q",
    );
    bench.ok("evaluate unseen --with m.taceva --format json --out e.json -q");
    let untested = bench.json("choose --need rugged --results e.json");
    assert_eq!(untested["unknown"].as_array().map(Vec::len), Some(1));
    for words in [
        "choose --need rugged --results s.json",
        "choose --need rugged --results e.json --results s.json",
    ] {
        let choice = bench.json(words);
        let lists = ["ranked", "open", "dropped", "barred", "unplaced", "apart"];
        let counts = lists.map(|list| choice[list].as_array().map_or(0, Vec::len));
        assert_eq!(counts.iter().sum::<usize>(), 1, "{words}: {choice}");
        assert_eq!(
            choice["unknown"].as_array().map(Vec::len),
            Some(0),
            "{choice}"
        );
    }
}
