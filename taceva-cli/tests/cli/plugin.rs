//! Plugins listed, inspected and planned with; none of their code runs.

use std::fs;

use crate::support::Bench;

/// Test folder with a lamp plugin in `plugins` for each name. Their invalid libraries are never loaded.
fn with_plugins(names: &[&str]) -> Bench {
    let bench = Bench::new();
    for name in names {
        bench.write(&format!("plugins/{name}/plugin.toml"), &manifest(name));
        bench.write(&format!("plugins/{name}/lib.so"), "never opened");
    }
    bench
}

fn manifest(name: &str) -> String {
    format!(
        r#"
manifest_version = 1
id = "org.example.{name}"
name = "a lamp"
version = "1.0.0"
license = "MIT"
abi = {{ major = 1, minor = 0 }}
needs = ["usb"]
library.linux-x86_64.path = "lib.so"
library.linux-aarch64.path = "lib.so"
library.macos-aarch64.path = "lib.so"

[[provides]]
kind = "lighting"
key = "lamp"
title = "lamp"
source = "real"
scenes = ["dark", "room"]
"#
    )
}

#[test]
fn plugins_are_listed_with_what_they_provide_and_how_they_would_run() {
    let bench = with_plugins(&["b", "a"]);
    let listed = bench.json("plugin list --plugin-dir plugins");
    assert_eq!(listed["schema"], "taceva.plugins/1");
    let plugins = listed["plugins"].as_array().expect("a list");
    let ids: Vec<&str> = plugins
        .iter()
        .filter_map(|one| one["id"].as_str())
        .collect();
    assert_eq!(ids, ["org.example.a", "org.example.b"]);
    assert_eq!(plugins[0]["delivery"], "child");
    assert_eq!(plugins[0]["needs"][0], "usb");
    assert_eq!(plugins[0]["drivers"][0]["key"], "org.example.a/lamp");
    let trusted = bench.json("plugin list --plugin-dir plugins --trust org.example.b");
    assert_eq!(trusted["plugins"][1]["delivery"], "in-process");
    let out = bench.ok("plugin list --plugin-dir plugins");
    assert!(out.contains("needs usb (none is allowed)"), "{out}");
    let columns: Vec<&str> = out
        .lines()
        .next()
        .unwrap_or("")
        .split_whitespace()
        .collect();
    assert_eq!(columns, ["id", "version", "runs-in", "found-by", "name"]);
    // The isolation was tested by a child that loads nothing.
    let isolation = plugins[0]["isolation"].as_str().expect("words");
    assert!(
        isolation.starts_with("in a process of its own, files and ports closed by Landlock"),
        "{isolation}"
    );
    assert!(!isolation.contains("may reach"), "{isolation}");
    let isolation = trusted["plugins"][1]["isolation"].as_str();
    assert_eq!(
        isolation,
        Some("in this process, unconfined: trusted by `--trust`")
    );
    assert!(out.ends_with("2 plugins, 0 not used\n"), "{out}");
}

#[test]
fn what_is_not_used_is_counted_and_with_all_told_with_its_reason() {
    let bench = with_plugins(&["a"]);
    bench.write(
        "plugins/bad/plugin.toml",
        &manifest("bad").replace("title", "titel"),
    );
    bench.write("plugins/same/plugin.toml", &manifest("a"));
    bench.write("plugins/same/lib.so", "never opened");
    let out = bench.ok("plugin list --plugin-dir plugins");
    assert!(
        out.ends_with("0 plugins, 3 not used: --all prints the reasons\n"),
        "{out}"
    );
    let listed = bench.json("plugin list --all --plugin-dir plugins");
    let rejected = listed["rejected"].as_array().expect("a list");
    let kinds: Vec<&str> = rejected
        .iter()
        .filter_map(|one| one["kind"].as_str())
        .collect();
    assert_eq!(kinds, ["manifest", "duplicate", "duplicate"]);
    let reason = rejected[0]["reason"].as_str().expect("words");
    assert!(reason.contains("did you mean `title`?"), "{reason}");
}

#[test]
fn info_says_all_that_the_manifest_says_and_an_unknown_id_where_it_was_looked_for() {
    let bench = with_plugins(&["a"]);
    let out = bench.ok("plugin info org.example.a --plugin-dir plugins");
    for part in [
        "lib.so (any build of it)",
        "licence   MIT",
        "light dark room",
    ] {
        assert!(out.contains(part), "{part}: {out}");
    }
    let ran = bench.run("plugin info org.example.b --plugin-dir plugins");
    assert_eq!(ran.code, 3);
    assert!(
        ran.err.contains("did you mean `org.example.a`?"),
        "{}",
        ran.err
    );
    assert!(ran.err.contains("looked in"), "{}", ran.err);
}

#[test]
fn devices_and_doctor_know_the_drivers_of_plugins() {
    let bench = with_plugins(&["a"]);
    let devices = bench.json("devices --plugin-dir plugins");
    let drivers = devices["drivers"].as_array().expect("a list");
    let lamp = drivers
        .iter()
        .find(|one| one["key"] == "org.example.a/lamp");
    assert_eq!(lamp.expect("listed")["kind"], "lighting");
    let without = bench.json("devices");
    let drivers = without["drivers"].as_array().expect("a list");
    assert!(drivers.iter().all(|one| one["key"] != "org.example.a/lamp"));
}

const SCENE: &str = r#"
scene_version = 1
name = "lamp"

[robot]
driver = "sim/robot"

[force]
driver = "sim/force-transducer"

[lighting]
driver = "org.example.a/lamp"

[protocol.hysteresis]
points = 3

[[study]]
name = "MagicTac"
[study.sensor]
driver = "sim/magictac"
units = ["0"]
"#;

#[test]
fn a_scene_may_name_a_driver_of_a_plugin_beside_it() {
    let bench = with_plugins(&["a"]);
    bench.write("lamp.toml", SCENE);
    // The need of the plugin is not allowed, and the plan names the remedy.
    let planned = bench.run("plan lamp.toml");
    assert_eq!(planned.code, 1, "{}", planned.err);
    let line = "allow it: taceva plugin allow org.example.a usb --plugin-dir ";
    assert!(planned.err.contains(line), "{}", planned.err);
    bench.ok("plugin allow org.example.a usb --plugin-dir plugins");
    let planned = bench.run("plan lamp.toml");
    assert_eq!(planned.code, 0, "{}", planned.err);
    fs::remove_dir_all(bench.path("plugins")).expect("there");
    let planned = bench.run("plan lamp.toml");
    assert_eq!(planned.code, 3);
    assert!(
        planned.err.contains("org.example.a/lamp"),
        "{}",
        planned.err
    );
}

#[test]
fn settings_with_a_mistake_name_their_line() {
    let bench = with_plugins(&["a"]);
    bench.write(
        "user-config/taceva/config.toml",
        "[plugins]\ntrust = [\"org.example.a\"]\n",
    );
    let ran = bench.run("plugin list");
    assert_eq!(ran.code, 3);
    assert!(
        ran.err.contains("line 2, column 1: `trust`: unknown key"),
        "{}",
        ran.err
    );
    bench.write(
        "user-config/taceva/config.toml",
        "[plugins]\ntrust_in_process = [\"org.example.a\"]\n[plugins.allow]\n\"org.example.a\" = [\"usb\"]\n",
    );
    let ran = bench.run("plugin list --plugin-dir plugins");
    assert!(ran.out.contains("in process"), "{}", ran.out);
    assert!(ran.out.contains("needs usb (allowed: usb)"), "{}", ran.out);
    let why =
        "runs in this process, unconfined: trusted by `trust_in_process` in the user's settings";
    assert!(ran.out.contains(why), "{}", ran.out);
    // Without that setting the plugin is confined, and reaches what is allowed.
    bench.write(
        "user-config/taceva/config.toml",
        "[plugins.allow]\n\"org.example.a\" = [\"usb\"]\n",
    );
    let ran = bench.run("doctor --plugin-dir plugins");
    assert!(
        ran.out.contains("MiB of memory, may reach usb"),
        "{}",
        ran.out
    );
}

#[test]
fn the_robot_of_the_template_reaches_what_the_example_scenes_press() {
    let bench = Bench::new();
    bench.ok("plugin new robot my-arm");
    // The plan opens nothing.
    for library in ["libmy_arm.so", "libmy_arm.dylib", "my_arm.dll"] {
        bench.write(&format!("my-arm/target/release/{library}"), "never opened");
    }
    let scenes = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/scenes");
    for scene in ["accuracy", "compare", "lighting", "sensitivity", "wire"] {
        let text = fs::read_to_string(scenes.join(scene).with_extension("toml")).expect("there");
        let replaced = text.replace("\"sim/robot\"", "\"org.example.my-arm/my-arm\"");
        assert_ne!(text, replaced, "{scene}");
        bench.write("scene.toml", &replaced);
        bench.ok("plan scene.toml --plugin-dir my-arm");
    }
}

#[test]
fn a_new_plugin_is_also_begun_by_another_word_for_its_kind() {
    let bench = Bench::new();
    for (word, kind) in [
        ("camera", "sensor"),
        ("transducer", "force"),
        ("model", "estimator"),
    ] {
        bench.ok(&format!("plugin new {word} my-{word} --language python"));
        let manifest = bench.path(&format!("my-{word}/src/my_{word}/plugin.toml"));
        let manifest = fs::read_to_string(manifest).expect("written");
        assert!(
            manifest.contains(&format!("kind = \"{kind}\"")),
            "{manifest}"
        );
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_plugin_in_python_cannot_run_without_an_interpreter() {
    let bench = Bench::new();
    bench.ok("plugin new sensor my-eye --language python");
    let folder = "--plugin-dir my-eye/src/my_eye";
    let out = bench.ok(&format!("plugin list {folder}"));
    let why = "    cannot run: it is written in Python, and no interpreter is known";
    assert!(out.contains(why), "{out}");
    let doctor = bench.run(&format!("doctor {folder}"));
    assert!(
        doctor.out.contains("cannot run: it is written in Python"),
        "{}",
        doctor.out
    );
    assert!(!doctor.out.contains("--trust"), "{}", doctor.out);
}

#[test]
fn the_help_says_where_a_trusted_plugin_runs() {
    let help = Bench::new().ok("plugin list --help");
    let words: Vec<&str> = help.split_whitespace().collect();
    let said = "without confinement: a library runs in this process, Python in its own process";
    assert!(words.join(" ").contains(said), "{help}");
}

#[cfg(target_os = "linux")]
#[test]
fn an_interpreter_that_was_named_and_cannot_run_a_plugin_is_named_with_the_reason() {
    let bench = Bench::new();
    bench.ok("plugin new sensor my-eye --language python");
    let named = "--plugin-dir my-eye/src/my_eye --python /nonexistent/python";
    let why = "no named interpreter can run it: /nonexistent/python: cannot be started: ";
    let listed = bench.ok(&format!("plugin list {named}"));
    assert!(listed.contains(why), "{listed}");
    let checked = bench.run(&format!("plugin check org.example.my-eye {named}"));
    assert_ne!(checked.code, 0, "{}", checked.out);
    assert!(checked.err.contains(why), "{}", checked.err);
}
