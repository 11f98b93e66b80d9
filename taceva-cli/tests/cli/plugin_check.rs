//! `taceva plugin check` on a plugin in C: a correct plugin passes, and a faulty plugin fails the check for its fault.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::support::Bench;
use taceva_needs::{Need, skip};

/// Test folder with the plugin in `plugins/fixture`, built with `macros`. `None`, with a message, without a C compiler.
fn with_plugin(macros: &[&str]) -> Option<Bench> {
    let bench = Bench::new();
    let plugins = Path::new(env!("CARGO_MANIFEST_DIR")).join("../plugins");
    let source = plugins.join("host/tests/plugins/fixture.rs");
    let source = fs::read_to_string(source).expect("there");
    let manifest = source
        .split("r#\"")
        .nth(1)
        .and_then(|rest| rest.split("\"#").next());
    bench.write(
        "plugins/fixture/plugin.toml",
        manifest.expect("it holds the manifest"),
    );
    let built = Command::new("cc")
        .args(["-std=c11", "-shared", "-fPIC", "-fvisibility=hidden", "-I"])
        .arg(plugins.join("abi/include"))
        .args(macros.iter().map(|name| format!("-D{name}")))
        .arg(plugins.join("host/tests/fixture/plugin.c"))
        .arg("-o")
        .arg(bench.path("plugins/fixture/libfixture.so"))
        .arg("-lm")
        .status();
    match built {
        Ok(status) => assert!(status.success()),
        Err(error) => {
            skip(Need::CCompiler, format!("`cc`: {error}"));
            return None;
        }
    }
    Some(bench)
}

#[test]
fn checks_are_reported_as_a_runner_of_tests_does() {
    let Some(bench) = with_plugin(&[]) else {
        return;
    };
    let check = "plugin check org.example.fixture --plugin-dir plugins --only library,force";
    let checked = bench.json(&format!("{check} --seed 7"));
    assert_eq!(checked["schema"], "taceva.plugin-check/1");
    assert_eq!(
        (&checked["seed"], &checked["failed"]),
        (&7.into(), &0.into())
    );
    let results = checked["results"].as_array().expect("a list");
    assert_eq!(results[0]["check"], "library/loads");
    assert_eq!(results[0]["outcome"], "passed");
    let out = bench.ok(check);
    assert!(
        out.contains("pass") && out.contains("force/interrupt-within-50-ms"),
        "{out}"
    );
    let (tried, skipped) = out.split_once("(seed 0)\n").expect("the counts");
    assert!(!tried.contains("its rigs have no extensions"), "{out}");
    assert!(
        skipped.contains("1 skipped: its rigs have no extensions\n"),
        "{out}"
    );
    let nothing = "plugin check org.example.fixture --plugin-dir plugins --only nothing";
    assert_eq!(bench.run(nothing).code, 2);
}

/// Test folder with the plugin built with `macros`, whose devices claim to be real, and the rig file `first.toml` with its transducer.
fn with_real_plugin(macros: &[&str]) -> Option<Bench> {
    let real = ["EYE_SOURCE=\"real\"", "WRIST_SOURCE=\"real\""];
    let bench = with_plugin(&[&real[..], macros].concat())?;
    let path = bench.path("plugins/fixture/plugin.toml");
    let mut manifest = fs::read_to_string(path).expect("written");
    for title in ["an eye, by the manifest: words may differ", "wrist"] {
        let of = |source: &str| format!("title = \"{title}\"\nsource = \"{source}\"");
        manifest = manifest.replace(&of("simulated"), &of("real"));
    }
    bench.write("plugins/fixture/plugin.toml", &manifest);
    bench.write(
        "first.toml",
        "rig_version = 1\n[force]\ndriver = \"org.example.fixture/wrist\"\naxes = [\"x\", \"y\", \"z\"]\n",
    );
    Some(bench)
}

#[test]
fn stamps_of_another_clock_are_a_problem_of_rig_check() {
    let Some(bench) = with_real_plugin(&["UNIT_NS=1", "LAG_NS=-3600000000000"]) else {
        return;
    };
    let ran = bench.run("rig check first.toml --plugin-dir plugins");
    assert_eq!(ran.code, 1, "{}{}", ran.out, ran.err);
    let words = "problem the force has stamps 3600 s ahead of the clock of this machine";
    assert!(ran.out.contains(words), "{}", ran.out);
}

#[test]
fn a_plugin_that_crashes_in_rig_check_is_named_with_its_commands_and_no_cable_is_blamed() {
    for crash in ["CRASHES", "OPEN_CRASHES"] {
        let Some(bench) = with_real_plugin(&["UNIT_NS=1", crash]) else {
            return;
        };
        let rig = "rig_version = 1\n[sensor]\ndriver = \"org.example.fixture/eye\"\n";
        bench.write("first.toml", rig);
        let checked = |expected: &[&str]| {
            let ran = bench.run("rig check first.toml --plugin-dir plugins");
            assert_eq!(ran.code, 1, "{crash}: {}{}", ran.out, ran.err);
            for words in expected {
                assert!(ran.out.contains(words), "{crash}, {words}: {}", ran.out);
            }
            assert!(!ran.out.contains("cable"), "{crash}: {}", ran.out);
        };
        checked(&[
            "the plugin `org.example.fixture` is gone: its process was ended by signal 11",
            "`taceva plugin check org.example.fixture`",
            "`taceva plugin release org.example.fixture`",
        ]);
        checked(&[
            "is in quarantine: its process was ended by signal 11",
            "`taceva plugin release org.example.fixture` lets it start again",
        ]);
    }
}

#[test]
fn stamps_of_a_real_plugin_in_microseconds_are_refused_by_rig_check_and_capture() {
    let Some(bench) = with_real_plugin(&["UNIT_NS=1000"]) else {
        return;
    };
    let unit = "they are probably microseconds where nanoseconds are expected";
    let ran = bench.run("rig check first.toml --plugin-dir plugins");
    assert_eq!(ran.code, 1, "{}{}", ran.out, ran.err);
    assert!(ran.out.contains(unit), "{}", ran.out);
    let ran = bench
        .run("capture out --sensor org.example.fixture/eye --frames 100000 --plugin-dir plugins");
    assert_eq!(ran.code, 4, "{}", ran.err);
    assert!(ran.err.contains(unit), "{}", ran.err);
}

#[test]
fn a_new_plugin_in_c_is_built_by_make_and_passes_its_checks() {
    for tool in ["cc", "make"] {
        if let Err(error) = Command::new(tool).arg("--version").output() {
            skip(Need::CCompiler, format!("`{tool}`: {error}"));
            return;
        }
    }
    let bench = Bench::new();
    bench.ok("plugin new sensor my-eye --language c");
    let made = Command::new("make")
        .current_dir(bench.path("my-eye"))
        .output();
    let made = made.expect("it was asked for its version");
    let said = String::from_utf8_lossy(&made.stderr);
    assert!(made.status.success(), "{said}");
    let only = "library/,driver/opens,sensor/gives,sensor/stamps-in-order";
    let checked = bench.ok(&format!(
        "plugin check org.example.my-eye --plugin-dir my-eye --only {only}"
    ));
    assert!(
        checked.contains("sensor/gives-the-frames-it-says"),
        "{checked}"
    );
    let listed = bench.ok("devices --plugin-dir my-eye");
    assert!(listed.contains("org.example.my-eye/my-eye"), "{listed}");
}

#[test]
fn a_failed_check_is_exit_code_1_and_says_why() {
    let Some(bench) = with_plugin(&["FORCE=NAN"]) else {
        return;
    };
    let ran = bench.run("plugin check org.example.fixture --plugin-dir plugins --only force/reads");
    assert_eq!(ran.code, 1, "{}", ran.err);
    assert!(
        ran.out.contains("FAIL") && ran.out.contains("`Fz` is NaN"),
        "{}",
        ran.out
    );
}
