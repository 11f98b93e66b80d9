//! Tests of invalid scene texts.

use taceva_core::DriverKind;
use taceva_protocol::{BuiltinScene, Scene, Study};

use super::{GOOD, message, with};

#[test]
fn every_builtin_scene_reads_and_says_so_in_its_name() {
    for builtin in BuiltinScene::ALL {
        let scene = builtin.scene().expect("compiled in");
        assert_eq!(scene.name, builtin.name());
        assert_eq!(scene.studies.len(), 4);
        assert_eq!(BuiltinScene::from_name(builtin.name()), Some(builtin));
    }
    let paper = BuiltinScene::Paper.scene().expect("compiled in");
    assert_eq!(paper.protocol.calibration.points.value, 800);
    assert_eq!(
        paper.studies[0]
            .limits
            .normal_max_n
            .map(|limit| limit.value),
        Some(0.7)
    );
}

#[test]
fn an_unknown_key_names_its_line_and_the_nearest_key() {
    let error = with("[limits]\nPz_max = 1.0");
    assert_eq!(
        error,
        "s.toml, line 10: `Pz_max`: unknown key, did you mean `Pz_max_mm`?; known here: Pz_max_mm, Fz_max_N, Fxy_max_N, speed_max_mm_s"
    );
    let error = with("[protocol.callibration]\npoints = 1");
    assert!(
        error.starts_with(
            "s.toml, line 9: `callibration`: unknown key, did you mean `calibration`?"
        ),
        "{error}"
    );
    let error = message(&GOOD.replace("driver = \"sim/robot\"", "drvier = \"sim/robot\""));
    assert!(
        error.starts_with("s.toml, line 6: `drvier`: unknown key, did you mean `driver`?"),
        "{error}"
    );
}

#[test]
fn text_that_is_no_toml_names_its_line() {
    assert!(with("[limits").starts_with("s.toml, line 9: "));
    assert!(with("name = 3").contains("line 9"));
    assert!(message("").contains("the key `scene_version` is missing"));
}

#[test]
fn a_value_of_another_type_names_its_line_and_what_was_expected() {
    let error = with("[protocol.calibration]\npoints = \"many\"");
    assert!(
        error.starts_with("s.toml, line 10: ") && error.contains("expected u32"),
        "{error}"
    );
    let error = with("[protocol.calibration]\npoints = -1");
    assert!(error.starts_with("s.toml, line 10: "), "{error}");
    assert_eq!(
        message(&format!("metrics = [\"mae\"]\n{GOOD}")),
        "s.toml, line 1: invalid type: sequence, expected a table such as `metrics = { want = [\"mae\"] }`"
    );
}

#[test]
fn gratings_are_classified_by_what_there_is() {
    let error = with("[protocol.gratings]\nclassified_by = \"cnm\"");
    assert!(
        error.starts_with("s.toml, line 10: ")
            && error.contains("expected one of `spectrum`, `linfa/logistic`, `cnn`, `cnn-length`"),
        "{error}"
    );
}

#[test]
fn depths_count_from_the_first_contact_or_from_the_surface() {
    let error = with("[protocol.contact]\ndepth_from = \"step\"");
    assert!(
        error.starts_with("s.toml, line 10: ") && error.contains("expected `contact` or `surface`"),
        "{error}"
    );
}

#[test]
fn a_scene_of_another_version_is_refused() {
    let error = message(&GOOD.replace("scene_version = 1", "scene_version = 2"));
    assert_eq!(
        error,
        "s.toml, line 1: scene version 2 is not supported, expected 1"
    );
}

#[test]
fn a_text_larger_than_any_scene_is_refused_unread() {
    let error = message(&"#".repeat(2 << 20));
    assert_eq!(
        error,
        "s.toml: the scene has 2097152 bytes, expected at most 1048576"
    );
}

#[test]
fn zero_points_are_refused_with_their_line() {
    for (table, key) in [
        ("calibration", "points"),
        ("spatial", "points"),
        ("gratings", "presses"),
        ("lighting", "points"),
        ("repeatability", "points"),
        ("hysteresis", "points"),
        ("surface", "points"),
    ] {
        let error = with(&format!("[protocol.{table}]\n{key} = 0"));
        let expected =
            format!("s.toml, line 10: `{key}` is 0, expected a whole number from 1 to 1000000");
        assert_eq!(error, expected);
    }
    assert!(with("[protocol.calibration]\nindentations = 0").contains("from 1 to 1000"));
    assert!(with("[protocol.repeatability]\ntrials = 1").contains("from 2 to"));
    assert!(with("[protocol.idle]\nframes = 1").contains("from 2 to"));
}

#[test]
fn a_size_of_frames_that_is_none_is_refused_with_its_line_and_what_was_expected() {
    for written in [
        "\"\"",
        "\"64\"",
        "64",
        "-64",
        "\"64x\"",
        "\"x48\"",
        "\"0x48\"",
        "\"64x0\"",
        "\"-64x48\"",
        "\"+64x48\"",
        "\"64.5x48\"",
        "\"64x48x3\"",
        "\"64 x 48\"",
        "\"16385x48\"",
        "\"99999999999999999999x48\"",
        "\"manyxmany\"",
    ] {
        let error = with(&format!("[recording]\nframes = {written}"));
        let found = written.trim_matches('"');
        let expected = format!(
            "s.toml, line 10: `frames` is `{found}`, expected WIDTHxHEIGHT in pixels, each a whole number from 1 to 16384, such as \"64x48\""
        );
        assert_eq!(error, expected);
    }
    let error = with("[recording]\nframes = true");
    assert!(
        error.starts_with("s.toml, line 10: ")
            && error.contains("expected a size such as `frames = \"64x48\"`"),
        "{error}"
    );
    let error = with("[recording]\nframe = \"64x48\"");
    assert!(
        error.starts_with("s.toml, line 10: `frame`: unknown key, did you mean `frames`?"),
        "{error}"
    );
}

#[test]
fn a_study_keeps_frames_at_its_own_size_or_else_at_that_of_its_scene() {
    let text = "scene_version = 1\nname = \"two\"\nrobot = { driver = \"sim/robot\" }\n\
                force = { driver = \"sim/force-transducer\" }\nrecording = { frames = \"64x48\" }\n\
                [[study]]\nname = \"a\"\nsensor = { driver = \"sim/gelsight\" }\n\
                [[study]]\nname = \"b\"\nsensor = { driver = \"sim/gelsight\" }\nrecording = { frames = \"32x24\" }\n";
    let scene = Scene::parse("s.toml", text).expect("reads");
    let kept = |study: &Study| study.frames.map(|frames| frames.value.to_string());
    let sizes: Vec<Option<String>> = scene.studies.iter().map(kept).collect();
    assert_eq!(sizes, ["64x48", "32x24"].map(|size| Some(size.to_owned())));
    let scene = Scene::parse("s.toml", GOOD).expect("reads");
    assert_eq!(kept(&scene.studies[0]), None);
}

#[test]
fn a_size_of_frames_for_a_study_of_a_recording_is_refused() {
    let error = message(
        "scene_version = 1\nname = \"s\"\n[[study]]\nname = \"a\"\nsensor = { dataset = \"old\" }\n\
         recording = { frames = \"32x24\" }\n",
    );
    assert_eq!(
        error,
        "s.toml, line 6: `frames` cannot apply to the recording `old`, whose frames are already stored: use `driver`, or remove `frames`"
    );
}

#[test]
fn a_number_that_is_none_is_refused_with_its_line() {
    for number in ["nan", "inf", "-1.0", "0.0", "1e9"] {
        let error = with(&format!("[limits]\nFz_max_N = {number}"));
        assert!(
            error.starts_with("s.toml, line 10: `Fz_max_N` is "),
            "{error}"
        );
    }
    assert!(with("[protocol.contact]\nspeed_mm_s = 50.0").contains("up to 5"));
}

#[test]
fn gratings_that_are_not_in_the_catalogue_are_refused() {
    for (line, found) in [
        ("from_mm = 0.1", "0.1"),
        ("to_mm = 2.0", "2"),
        ("from_mm = 0.26", "0.26"),
    ] {
        let error = with(&format!("[protocol.gratings]\n{line}"));
        let expected = format!(
            "s.toml, line 10: gratings of {found} mm are not in the catalogue: 0.25 mm to 1.75 mm in steps of 0.05 mm, lines and dots"
        );
        assert_eq!(error, expected);
    }
    assert!(with("[protocol.gratings]\nstep_mm = 0.03").contains("the step between boards"));
    assert!(with("[protocol.gratings]\nkinds = []").contains("`kinds` is empty"));
    assert!(
        with("[protocol.gratings]\nkinds = [\"line\", \"line\"]").contains("names a kind twice")
    );
    assert!(
        with("[protocol.gratings]\nfrom_mm = 1.0\nto_mm = 0.5")
            .contains("expected `from_mm` at most")
    );
}

#[test]
fn an_unknown_metric_is_answered_with_the_nearest() {
    let error = with("[metrics]\nwant = [\"accuracy\", \"smap\"]");
    assert!(
        error.starts_with("s.toml, line 10: `smap`: unknown metric, did you mean `smape`?"),
        "{error}"
    );
    assert!(with("[metrics]\nwant = []").contains("remove it to compute all"));
}

#[test]
fn an_unknown_report_format_is_answered_with_what_there_is() {
    let error = with("[report]\nformats = [\"htm\"]");
    assert!(
        error.contains("unknown report format, did you mean `html`?"),
        "{error}"
    );
    let error = with("[report]\nlike = \"tacev\"");
    assert!(
        error.contains("unknown value of `like`, did you mean `taceva`?"),
        "{error}"
    );
    let error = with("[report]\nkeep = [\"model\"]");
    assert!(
        error.contains("unknown file to keep, did you mean `models`?"),
        "{error}"
    );
}

#[test]
fn faults_of_a_scene_have_ascending_severities_and_some_draws() {
    for (written, expected) in [
        ("severities = [1, 6]", "`severities` is 6"),
        (
            "severities = [3, 1]",
            "severity 1 after 3, expected ascending",
        ),
        ("severities = [\"high\"]", "line 10"),
        ("severities = []", "remove it to test all severities"),
        ("faults = []", "remove it to test all faults"),
        ("seeds = 0", "`seeds` is 0"),
        ("fault = [\"tear\"]", "did you mean `faults`?"),
    ] {
        let error = with(&format!("[stress]\n{written}"));
        assert!(error.contains(expected), "{written}: {error}");
    }
}

#[test]
fn faults_of_plugins_have_distinct_names_and_a_table_that_tests_them() {
    let fault = "[[fault]]\nname = \"fog\"\nplugin = \"org.example/fog\"\n";
    assert!(with(fault).contains("[[fault]] without [stress]"));
    let twice = with(&format!("{fault}{fault}[stress]\n"));
    assert!(twice.contains("two faults are called `fog`"), "{twice}");
}

#[test]
fn an_unknown_driver_is_answered_with_the_nearest_of_its_kind() {
    let scene =
        Scene::parse("s.toml", &GOOD.replace("sim/robot", "sim/robto:speed=2")).expect("reads");
    let known = [
        (DriverKind::Sensor, "sim/gelsight"),
        (DriverKind::Robot, "sim/robot"),
        (DriverKind::Force, "sim/force-transducer"),
    ];
    let error = scene
        .check_drivers(&known)
        .expect_err("unknown")
        .to_string();
    assert_eq!(
        error,
        "s.toml, line 6: `sim/robto`: unknown driver of a robot, did you mean `sim/robot`?; known: sim/robot"
    );
    let scene = Scene::parse("s.toml", GOOD).expect("reads");
    scene.check_drivers(&known).expect("all known");
}

#[test]
fn a_scene_without_a_sensor_is_refused() {
    let error = message("scene_version = 1\nname = \"x\"\n");
    assert_eq!(
        error,
        "s.toml, line 2: `x` has no sensor: expected [sensor] with `driver` or `dataset`"
    );
    let error = message("scene_version = 1\nname = \"x\"\n[sensor]\nopaque = true\n");
    assert_eq!(
        error,
        "s.toml, line 3: [sensor] has neither `driver` nor `dataset`"
    );
}

#[test]
fn a_driver_and_a_dataset_exclude_each_other() {
    let error = message(&GOOD.replace("[robot]", "dataset = \"old\"\n[robot]"));
    assert_eq!(
        error,
        "s.toml, line 5: [sensor] has `driver` and `dataset`: expected one of them"
    );
    let error = with("[model]\nname = \"ridge\"\nfile = \"m\"");
    assert!(error.contains("[model] has `name` and `file`"), "{error}");
}

#[test]
fn names_that_could_not_be_printed_or_filed_are_refused() {
    for name in ["", " x", "a/b", "..", "\\u001b[31m"] {
        let error = message(&GOOD.replace("my gel", name));
        assert!(
            error.contains("is not valid as a name of a scene"),
            "{error}"
        );
        assert!(
            !error.contains('\u{1b}'),
            "control characters are shown, not printed"
        );
    }
}

#[test]
fn two_studies_of_one_name_are_refused() {
    let error = with("[[study]]\nname = \"a\"\n[[study]]\nname = \"a\"");
    let expected = "s.toml, line 12: `a` is the name of two studies: give each its own name";
    assert_eq!(error, expected);
}

#[test]
fn a_study_may_not_loosen_the_limits_of_its_scene() {
    let error =
        with("[limits]\nPz_max_mm = 0.5\n[[study]]\nname = \"a\"\nlimits = { Pz_max_mm = 0.6 }");
    let expected = "s.toml, line 13: `Pz_max_mm` is 0.6, but [limits] of the scene allows at most 0.5: limits may only be tightened";
    assert_eq!(error, expected);
}

#[test]
fn a_footprint_that_is_none_is_refused() {
    for (footprint, problem) in [
        (
            "{ shape = \"disc\", half_x_mm = 1.0 }",
            "a disc has `radius_mm`",
        ),
        (
            "{ shape = \"rect\", radius_mm = 1.0 }",
            "a rect has `half_x_mm`",
        ),
        (
            "{ shape = \"disc\", radius_mm = -1.0 }",
            "expected a length above 0",
        ),
    ] {
        let text = GOOD.replace("[robot]", &format!("footprint = {footprint}\n[robot]"));
        let error = message(&text);
        assert!(
            error.starts_with("s.toml, line 5: ") && error.contains(problem),
            "{error}"
        );
    }
}

#[test]
fn every_example_scene_reads() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../examples/scenes");
    let mut read = 0;
    for entry in std::fs::read_dir(folder).expect("the folder of examples") {
        let path = entry.expect("an entry").path();
        let text = std::fs::read_to_string(&path).expect("a text");
        let scene = Scene::parse(&path.to_string_lossy(), &text);
        assert!(scene.is_ok(), "{}", scene.expect_err("refused"));
        read += 1;
    }
    assert!(read >= 4, "{read} examples");
}
