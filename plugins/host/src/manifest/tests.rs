//! Valid and invalid manifests.

use taceva_core::{ArgKind, ArgValue, DriverKind, Facts, Presence};

use super::*;

const HEAD: &str = r#"manifest_version = 1
id = "org.example.hand"
name = "a hand"
version = "1.2.3"
license = "MIT"
abi = { major = 1, minor = 0 }
"#;

const LIBRARY: &str = "[library]\nlinux-x86_64 = { path = \"libhand.so\" }\n";

const PROVIDES: &str = r#"
[[provides]]
kind = "sensor"
key = "palm"
title = "palm"
source = "simulated"
frame = { width = 4, height = 3, format = "gray8" }
rate_hz = 30
gel = { opaque = false, markers = true, thickness_mm = 3.5 }
camera = { width = 640, height = 480 }
field_of_view_mm2 = 120.5
scenes = ["dark", "room"]
footprint = { shape = "disc", radius_mm = 17.0, depth_max_mm = 3.5 }
limits = { Pz_max_mm = 3.0, Fz_max_N = 8.0 }
usb = [{ vendor = 0x2833, product = 0x0209 }]

[[provides.args]]
key = "unit"
type = "whole"
range = [0, 9]
default = 0
help = "which one"

[[provides.args]]
key = "exposure"
type = "number"
unit = "ms"
range = [0.1, 33]
default = 8

[[provides.args]]
key = "table"
type = "path"
optional = true

[[provides.args]]
key = "pace"
type = "choice"
choices = ["virtual", "real"]
default = "virtual"

[[provides]]
kind = "robot"
key = "arm"
title = "arm"
source = "real"
workspace = { least_mm = [-10, -10, -5], greatest_mm = [10, 10, 5] }
limits = { speed_max_mm_s = 20 }
repeatability_mm = 0.01
pose_noise_mm = 0.02
deceleration_mm_s2 = 500
stop_ms = 30
latency_ms = 1
guarded_motion = true

[[provides]]
kind = "force"
key = "wrist"
title = "wrist"
source = "real"
axes = ["Fx", "Fy", "Fz"]
rate_hz = 500
limits = { Fz_max_N = 50 }
noise_N = 0.02
resolution_N = 0.005
latency_ms = 4
tare = true

[[provides]]
kind = "lighting"
key = "lamp"
title = "lamp"
source = "real"
scenes = ["dark", "room"]

[[provides]]
kind = "changer"
key = "carousel"
title = "carousel"
source = "real"
holds = ["sphere of radius 4 mm", "line grating of 1.5 mm"]

[[provides]]
kind = "estimator"
key = "nearest"
title = "nearest neighbour"
"#;

fn whole() -> String {
    format!("{HEAD}{LIBRARY}{PROVIDES}")
}

fn refused(text: &str) -> String {
    Manifest::parse(text).expect_err(text).to_string()
}

/// Replaces `old` with `new` in a valid manifest, and returns the error of parsing the result.
fn with(old: &str, new: &str) -> String {
    let text = whole();
    assert!(text.contains(old), "{old}");
    refused(&text.replacen(old, new, 1))
}

#[test]
fn every_fact_of_every_kind_has_a_key() {
    let manifest = Manifest::parse(&whole()).expect("good");
    let kinds: Vec<DriverKind> = manifest.drivers().map(Descriptor::kind).collect();
    assert_eq!(kinds, DriverKind::ALL);
    let [sensor, robot, force, _, changer] = manifest.drivers().collect::<Vec<_>>()[..] else {
        panic!("five drivers");
    };
    let held = &changer.changer().expect("a changer").holds;
    assert_eq!(held[1], "line grating of 1.5 mm");
    let facts = sensor.sensor().expect("a sensor");
    assert_eq!(facts.frame.expect("frames").to_string(), "4×3 gray8");
    assert_eq!((facts.opaque, facts.markers), (Some(false), Some(true)));
    assert_eq!(facts.depth_limit().map(|depth| depth.0), Some(3.0));
    assert_eq!(facts.camera, Some([640, 480]));
    let [unit, exposure, table, pace] = sensor.arguments() else {
        panic!("four arguments");
    };
    assert_eq!(unit.kind, ArgKind::Whole { least: 0, most: 9 });
    assert_eq!(exposure.presence, Presence::Default(ArgValue::Number(8.0)));
    assert_eq!(table.presence, Presence::Optional);
    assert!(matches!(pace.kind, ArgKind::Choice { .. }));
    let robot = robot.robot().expect("a robot");
    let top = robot.workspace.expect("a box").greatest.z;
    assert_eq!(top, taceva_core::Millimetre(5.0));
    let signals = [robot.deceleration_mm_s2, robot.stop_ms, robot.latency_ms];
    assert_eq!(signals, [500.0, 30.0, 1.0].map(Some));
    assert_eq!(robot.pose_noise, Some(taceva_core::Millimetre(0.02)));
    let Facts::Force(force) = force.facts() else {
        panic!("a force transducer");
    };
    assert_eq!(
        (force.axes.to_string().as_str(), force.tare),
        ("Fx Fy Fz", true)
    );
    let signals = [force.noise, force.resolution].map(|force| force.map(|force| force.0));
    assert_eq!(
        (signals, force.latency_ms),
        ([Some(0.02), Some(0.005)], Some(4.0))
    );
    let estimator = manifest.estimators().next().expect("one");
    assert_eq!(estimator.key.as_str(), "org.example.hand/nearest");
}

#[test]
fn a_table_alone_says_what_it_says_in_the_manifest() {
    let manifest = Manifest::parse(&whole()).expect("good");
    let table = PROVIDES
        .trim_start()
        .strip_prefix("[[provides]]\n")
        .and_then(|text| text.split("[[provides]]").next())
        .expect("the first table")
        .replace("[[provides.args]]", "[[args]]");
    let said = Provided::parse(&table, &manifest.id).expect("good");
    assert_eq!(Some(&said), manifest.provides.first());
}

#[test]
fn an_unknown_key_names_its_line_and_the_nearest() {
    assert_eq!(
        with("opaque = false", "opaqe = false"),
        "line 17, column 9: `opaqe`: unknown key, did you mean `opaque`? known here: opaque, markers, thickness_mm"
    );
    assert!(with("license", "licence").contains("`licence`: unknown key, did you mean `license`?"));
    assert!(with("type = \"whole\"", "tpye = \"whole\"").contains("did you mean `type`?"));
}

#[test]
fn a_wrong_type_names_its_line() {
    let message = with("rate_hz = 30", "rate_hz = \"fast\"");
    assert!(
        message.starts_with("line 16, column 11: invalid type"),
        "{message}"
    );
    assert!(with("width = 4", "width = -4").starts_with("line 15"));
    assert!(with("\"gray8\"", "\"gray\"").contains("unknown variant"));
}

#[test]
fn a_path_that_leaves_the_folder_is_refused() {
    for path in ["../libhand.so", "/usr/lib/libhand.so", ""] {
        let message = with("libhand.so", path);
        assert!(
            message.starts_with("line 8, column 25: `path`"),
            "{message}"
        );
    }
}

#[test]
fn a_key_claimed_twice_is_refused() {
    let message = with("\"arm\"", "\"palm\"");
    assert!(
        message.ends_with("`key`: two tables have the key `palm`"),
        "{message}"
    );
}

#[test]
fn a_newer_manifest_says_which_version_is_read_whatever_else_it_says() {
    let text = whole().replace(
        "manifest_version = 1",
        "manifest_version = 2\nfuture = true",
    );
    assert_eq!(
        refused(&text),
        "line 1, column 20: `manifest_version`: 2, but this TacEva reads 1"
    );
}

#[test]
fn whatever_cannot_be_meant_is_refused_where_it_stands() {
    for (old, new, expected) in [
        ("org.example.hand", "hand", "`id`"),
        ("name = \"a hand\"", "name = \"\\u001b[2J\"", "`name`"),
        ("linux-x86_64", "linux-x64", "did you mean `linux-x86_64`?"),
        (
            "{ path = \"libhand.so\" }",
            "{ path = \"libhand.so\", sha256 = \"00\" }",
            "64 hexadecimal",
        ),
        ("key = \"palm\"", "key = \"a/b\"", "`key`"),
        ("source = \"simulated\"\n", "", "`source` is missing"),
        (
            "tare = true",
            "guarded_motion = true",
            "not a fact of a force",
        ),
        ("repeatability_mm", "rate_hz", "not a fact of a robot"),
        ("stop_ms = 30", "noise_N = 30", "not a fact of a robot"),
        ("stop_ms = 30", "stop_ms = -1", "0 or more"),
        ("resolution_N = 0.005", "resolution_N = 0", "above 0"),
        ("tare = true", "stop_ms = 3", "not a fact of a force"),
        (
            "speed_max_mm_s = 20",
            "Pz_max_mm = 2",
            "not a fact of a robot",
        ),
        ("speed_max_mm_s = 20", "speed_max_mm_s = 0", "above 0"),
        ("\"Fx\", \"Fy\"", "\"Fx\", \"Fx\"", "at most once"),
        (
            "Pz_max_mm = 3.0",
            "Pz_max_mm = 4.0",
            "depth of the footprint, 3.5 mm",
        ),
        ("radius_mm = 17.0", "half_x_mm = 17.0", "a disc has"),
        ("opaque = false", "opaque = true", "the gel is opaque"),
        ("default = 0\n", "default = 10\n", "the default of"),
        ("range = [0, 9]", "range = [0.5, 9]", "two whole numbers"),
        (
            "type = \"path\"",
            "type = \"path\"\nrange = [0, 1]",
            "not a number",
        ),
        (
            "choices = [\"virtual\", \"real\"]\n",
            "",
            "expected `choices",
        ),
        (
            "optional = true",
            "optional = true\ndefault = \"x\"",
            "give only one of them",
        ),
        (
            "default = 8\n",
            "default = \"8\"\n",
            "found string, expected a number",
        ),
        ("key = \"pace\"", "key = \"unit\"", "declared twice"),
        ("abi =", "needs = [\"usb\", \"usb\"]\nabi =", "listed twice"),
        ("abi =", "needs = [\"net\"]\nabi =", "`needs`"),
        (
            "abi =",
            "needs = [\"tcp:{nowhere}:1\"]\nabi =",
            "no driver has these arguments",
        ),
    ] {
        let message = with(old, new);
        assert!(message.contains(expected), "{new}: {message}");
        assert!(message.starts_with("line "), "{message}");
    }
    assert!(refused(&format!("{HEAD}[library]\n{PROVIDES}")).contains("no platform"));
    assert!(refused(&format!("{HEAD}provides = []\n{LIBRARY}")).contains("expected 1 to 256"));
    assert!(refused(&" ".repeat(BYTES_MAX + 1)).contains("at most 1048576"));
}

#[test]
fn text_that_is_cut_or_changed_anywhere_is_read_or_refused_and_never_more() {
    let whole = whole();
    for end in (0..whole.len()).step_by(7) {
        let _ = Manifest::parse(&whole[..end]);
    }
    let bytes = whole.as_bytes();
    let mut state = 1_u64;
    let mut accepted = 0;
    for _ in 0..3_000 {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        let place = usize::try_from(state >> 33).expect("31 bits") % bytes.len();
        let mut changed = bytes.to_vec();
        changed[place] = (state >> 25).to_le_bytes()[0] & 0x7f;
        let text = String::from_utf8(changed).expect("ASCII");
        match Manifest::parse(&text) {
            Ok(_) => accepted += 1,
            Err(error) => assert!(!error.to_string().contains(char::is_control), "{error}"),
        }
    }
    assert!(accepted > 100, "titles and numbers may change: {accepted}");
}
