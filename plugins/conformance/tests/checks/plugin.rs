//! Checks of a plugin. A valid plugin passes all checks, and each kind of mistake fails the check for this mistake.

use std::sync::Arc;
use std::time::Duration;

use taceva_conformance::{CheckRequest, CheckResult, Outcome, check};
use taceva_host::{Children, PluginConfig, PluginHost, Plugins, SearchPath};

use crate::fixture::{Fixture, cpp};
use crate::runner::Test;

fn checked(fixture: &Fixture, only: &[&str]) -> Vec<CheckResult> {
    checked_within(fixture, only, Duration::from_secs(10))
}

fn checked_within(fixture: &Fixture, only: &[&str], limit: Duration) -> Vec<CheckResult> {
    let log = Arc::new(|_: &_, _, _: &str, _: &str| {});
    let host = PluginHost::with_children(
        fixture.found(),
        PluginConfig::default(),
        log,
        Children::default(),
    );
    let request = CheckRequest {
        only: only.iter().map(|name| (*name).to_owned()).collect(),
        limit,
        ..CheckRequest::default()
    };
    let mut results = Vec::new();
    check(
        &host,
        &fixture.plugin(),
        &request,
        &mut |_| {},
        &mut |result| results.push(result),
    )
    .expect("its library can be read");
    results
}

fn a_good_plugin_passes_every_check() {
    let Some(fixture) = Fixture::built(&["LEND"]) else {
        return;
    };
    let results = checked(&fixture, &[]);
    let failed: Vec<&CheckResult> = (results.iter())
        .filter(|result| matches!(result.outcome, Outcome::Failed(_)))
        .collect();
    assert!(failed.is_empty(), "{failed:#?}");
    let skipped = |result: &&CheckResult| matches!(result.outcome, Outcome::Skipped(_));
    let skipped: Vec<&str> = results
        .iter()
        .filter(skipped)
        .map(|result| result.check)
        .collect();
    let expected = [
        "library/needs-what-its-manifest-says",
        "library/unknown-rig-extension",
        "force/numbers-its-readings",
        "sensor/stamps-by-the-clock",
        "force/stamps-by-the-clock",
    ];
    assert_eq!(skipped, expected);
    assert!(results.len() > 100, "{} checks", results.len());
}

pub(crate) const TESTS: &[Test] = &[
    (
        "a_good_plugin_passes_every_check",
        a_good_plugin_passes_every_check,
    ),
    (
        "every_kind_of_mistake_is_found_by_a_check",
        every_kind_of_mistake_is_found_by_a_check,
    ),
    (
        "what_a_library_says_that_it_needs_stands_in_its_manifest",
        what_a_library_says_that_it_needs_stands_in_its_manifest,
    ),
    (
        "checks_that_hang_in_the_call_of_an_earlier_one_are_skipped",
        checks_that_hang_in_the_call_of_an_earlier_one_are_skipped,
    ),
    (
        "a_plugin_that_hangs_while_it_loads_fails_one_check_and_skips_all_others_at_once",
        a_plugin_that_hangs_while_it_loads_fails_one_check_and_skips_all_others_at_once,
    ),
    (
        "readings_with_one_number_are_found_frozen",
        readings_with_one_number_are_found_frozen,
    ),
    (
        "calls_of_a_real_device_that_block_beyond_their_deadline_are_found",
        calls_of_a_real_device_that_block_beyond_their_deadline_are_found,
    ),
    (
        "stamps_of_a_real_device_in_another_unit_or_of_another_clock_are_found",
        stamps_of_a_real_device_in_another_unit_or_of_another_clock_are_found,
    ),
    (
        "a_device_of_each_kind_in_cpp_keeps_every_promise",
        a_device_of_each_kind_in_cpp_keeps_every_promise,
    ),
];

/// Asserts that `check` fails on the plugin built with `macros`, with `words` in the reason.
fn finds(macros: &[&str], check: &str, words: &str) {
    let Some(fixture) = Fixture::built(macros) else {
        return;
    };
    let results = checked(&fixture, &[check]);
    let found = results
        .iter()
        .any(|result| matches!(&result.outcome, Outcome::Failed(why) if why.contains(words)));
    assert!(found, "{macros:?}: {results:#?}");
}

fn checks_that_hang_in_the_call_of_an_earlier_one_are_skipped() {
    let Some(fixture) = Fixture::built(&["HANGS"]) else {
        return;
    };
    let results = checked(&fixture, &["driver/opens"]);
    let failed: Vec<&str> = (results.iter())
        .filter(|result| matches!(result.outcome, Outcome::Failed(_)))
        .map(|result| result.check)
        .collect();
    // The first check of each driver has its whole time.
    let is_first = |check: &&str| *check == "driver/opens";
    assert!(
        !failed.is_empty() && failed.iter().all(is_first),
        "{results:#?}"
    );
    let why = "it did not open the device in the check `driver/opens`, which failed";
    let skipped = Outcome::Skipped(why.to_owned());
    let skipped = results.iter().filter(|result| result.outcome == skipped);
    // No process is started for these checks.
    let at_once = skipped.filter(|result| result.took_s < 1.0);
    assert!(at_once.count() >= 2, "{results:#?}");
}

fn a_plugin_that_hangs_while_it_loads_fails_one_check_and_skips_all_others_at_once() {
    let Some(fixture) = Fixture::built(&["INIT_HANGS"]) else {
        return;
    };
    let results = checked(&fixture, &[]);
    let (first, others) = results.split_first().expect("checks");
    assert_eq!(first.check, "library/loads");
    let why = "it did not load its library within 10s";
    assert!(
        matches!(&first.outcome, Outcome::Failed(found) if found.contains(why)),
        "{first:?}"
    );
    let why = "it did not load its library in the check `library/loads`, which failed";
    for result in others {
        assert_eq!(result.outcome, Outcome::Skipped(why.to_owned()));
        assert!(result.took_s < 1.0, "{result:?}");
    }
}

fn every_kind_of_mistake_is_found_by_a_check() {
    for (macros, check, words) in [
        (
            &["MAGIC=1"] as &[&str],
            "library/loads",
            "begins with 0x00000001",
        ),
        (&["RATE_HZ=\"60\""], "library/loads", "rate_hz"),
        (&["PRINTS"], "library/quiet", "hello"),
        (&["TAKES_SIGNALS"], "library/keeps-signals", "signal 10"),
        (&["LEAKS"], "driver/memory", "leaked"),
        (
            &["ANY_DRIVER"],
            "driver/open-of-no-driver",
            "but the plugin has no such driver",
        ),
        (
            &["LONG_ERRORS"],
            "driver/keeps-to-the-callers-error",
            "a message exceeded",
        ),
        (
            &["ANY_EXTENSION"],
            "driver/unknown-extension",
            "a table for",
        ),
        (&["TOLD_WIDTH=4"], "sensor/gives-the-frames", "expected 8×6"),
        (&["DEAF", "BLOCK"], "sensor/interrupt", "too slow"),
        (&["NAPS"], "sensor/interrupt", "the wait after an interrupt"),
        (&["BLOCK"], "sensor/gives-the-frames", "too slow"),
        (&["OVERRUNS"], "sensor/writes-no-further", "it wrote beyond"),
        (
            &["LEND", "KEEPS_RELEASE"],
            "sensor/release-says",
            "set itself to NULL",
        ),
        (&["CRASHES"], "sensor/gives-the-frames", "the process ended"),
        (
            &["HANGS"],
            "driver/opens-again",
            "did not open the device within",
        ),
        (&["BAD_POSE"], "robot/says-its-pose", "NaN"),
        (&["ANY_TARGET"], "robot/refuses-targets", "succeeded"),
        (&["FORCE=NAN"], "force/reads", "`Fz` is NaN"),
        (
            &["BAD_PREDICTION"],
            "estimator/fits-and-predicts",
            "expected a number",
        ),
        (&["ANY_MODEL"], "estimator/refuses-hostile", "expected"),
    ] {
        finds(macros, check, words);
    }
}

fn what_a_library_says_that_it_needs_stands_in_its_manifest() {
    finds(
        &["NEEDS=\"hid\""],
        "library/needs",
        "it states the need \"hid\"",
    );
    let Some(fixture) = Fixture::built(&["NEEDS=\"hid\\nlisten:5025\""]) else {
        return;
    };
    let abi = "abi = { major = 1, minor = 0 }";
    let needs = format!("{abi}\nneeds = [\"listen:5025\", \"hid\"]");
    let fixture = fixture.with_manifest(abi, &needs);
    let results = checked(&fixture, &["library/needs"]);
    assert_eq!(results[0].outcome, Outcome::Passed, "{results:#?}");
}

fn readings_with_one_number_are_found_frozen() {
    for (macros, words) in [
        (&["NUMBERED"][..], None),
        (
            &["NUMBERED", "FROZEN"],
            Some("two readings have the number 7"),
        ),
    ] {
        let Some(fixture) = Fixture::built(macros) else {
            return;
        };
        let fixture = fixture.with_manifest("tare = true", "tare = true\nnumbered = true");
        let results = checked(&fixture, &["force/numbers"]);
        match (&results[0].outcome, words) {
            (Outcome::Passed, None) => {}
            (Outcome::Failed(why), Some(words)) if why.contains(words) => {}
            (outcome, _) => panic!("{macros:?}: {outcome:?}"),
        }
    }
}

/// The fixture with a real sensor or transducer, by its `kind`, built with `macros`.
fn real(kind: &str, macros: &[&str]) -> Option<Fixture> {
    let (source, title) = match kind {
        "sensor" => (
            "EYE_SOURCE=\"real\"",
            "title = \"an eye, by the manifest: words may differ\"",
        ),
        _ => ("WRIST_SOURCE=\"real\"", "title = \"wrist\""),
    };
    let fixture = Fixture::built(&[&[source][..], macros].concat())?;
    let [simulated, real] =
        ["simulated", "real"].map(|source| format!("{title}\nsource = \"{source}\""));
    Some(fixture.with_manifest(&simulated, &real))
}

/// Asserts that a check of the real device `kind`, built with `macros`, passes, or that it fails with `words`.
fn judges(kind: &str, check: &str, macros: &[&str], words: Option<&str>) {
    let Some(fixture) = real(kind, macros) else {
        return;
    };
    let check = format!("{kind}/{check}");
    let results = checked_within(&fixture, &[&check], Duration::from_secs(30));
    match (&results[0].outcome, words) {
        (Outcome::Passed, None) => {}
        (Outcome::Failed(why), Some(words)) => assert!(why.contains(words), "{words}: {why}"),
        (outcome, _) => panic!("{check}, {macros:?}: {outcome:?}"),
    }
}

fn calls_of_a_real_device_that_block_beyond_their_deadline_are_found() {
    for (kind, macros, words) in [
        ("sensor", &["UNIT_NS=1"][..], None),
        (
            "sensor",
            &["UNIT_NS=1", "NAPS"],
            Some("a frame in 5ms took"),
        ),
        ("force", &["UNIT_NS=1"], None),
        (
            "force",
            &["UNIT_NS=1", "WRIST_NAPS"],
            Some("a reading in 5ms took"),
        ),
    ] {
        judges(kind, "keeps-deadlines", macros, words);
    }
}

fn stamps_of_a_real_device_in_another_unit_or_of_another_clock_are_found() {
    const CHECK: &str = "stamps-by-the-clock";
    for kind in ["sensor", "force"] {
        for (macros, words) in [
            (&["UNIT_NS=1"][..], None),
            (
                &["UNIT_NS=1000"],
                Some("they are probably microseconds where nanoseconds are expected"),
            ),
            (
                &["UNIT_NS=1000000"],
                Some("they are probably milliseconds where nanoseconds are expected"),
            ),
            (
                &["UNIT_NS=1", "LAG_NS=-3600000000000"],
                Some("s ahead of the clock of this machine"),
            ),
        ] {
            judges(kind, CHECK, macros, words);
        }
    }
    // A rate is compared for 6 s, and alike for both kinds.
    let words = "correct the rate from which its driver computes them";
    judges(
        "sensor",
        CHECK,
        &["UNIT_NS=1", "STAMP_RATE=1.5"],
        Some(words),
    );
}

fn a_device_of_each_kind_in_cpp_keeps_every_promise() {
    let Some(folder) = cpp("kinds", &Children::default()) else {
        return;
    };
    let path = SearchPath::empty().given([folder.path().to_owned()]);
    let log = Arc::new(|_: &_, _, _: &str, _: &str| {});
    let plugins = Plugins::search(path, &[]);
    let host =
        PluginHost::with_children(plugins, PluginConfig::default(), log, Children::default());
    let plugin = host.plugins().get("org.example.kinds").expect("found");
    assert_eq!(plugin.manifest.drivers().count(), 5);
    let (mut made, mut failed) = (0, Vec::new());
    check(
        &host,
        plugin,
        &CheckRequest::default(),
        &mut |_| {},
        &mut |result| {
            made += 1;
            // A wait of at most 50 ms may take longer if other programs use the machine.
            let is_timed = result.check.ends_with("within-50-ms");
            if let Outcome::Failed(why) = result.outcome
                && !is_timed
            {
                failed.push(format!("{} of {:?}: {why}", result.check, result.subject));
            }
        },
    )
    .expect("it can be checked");
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    assert!(made > 90, "{made} checks");
}
