//! Repeated sweeps: results that are reused, and results of changed inputs.

use super::store::scored;
use super::{small, text};

#[test]
fn a_finished_sweep_is_looked_at_and_not_carried_out_again() {
    let bench = scored();
    bench.ok("sweep which.toml -q");
    let times = text(&bench, "which.sweep/times.csv");
    let dry = bench.ok("sweep which.toml --dry-run");
    assert!(
        dry.contains("tasks    8, 0") && dry.contains("found    8"),
        "{dry}"
    );
    bench.ok("sweep which.toml -q");
    assert_eq!(text(&bench, "which.sweep/times.csv"), times);
    let shown = bench.ok("sweep show which.toml --by model,size --format csv");
    assert!(shown.starts_with("model,size,channel,mean,"), "{shown}");
    assert!(shown.contains("\nridge,8x8,Fz,"), "{shown}");
    let status = bench.ok("sweep status which.toml");
    assert!(status.contains("8: 8 scored, 0 failed, 0 left"), "{status}");
    bench.refused(
        "sweep show which.toml --by modell",
        2,
        "did you mean `model`?",
    );
    // More seeds: existing results are found, and the cost of the rest is estimated from measured times.
    small(&bench, &[("seeds = [1]", "seeds = [1, 2]")]);
    let dry = bench.ok("sweep which.toml --dry-run --jobs 1");
    assert!(
        dry.contains("tasks    16") && dry.contains("found    8"),
        "{dry}"
    );
    assert!(
        dry.contains("time     about") && dry.contains("disk     about"),
        "{dry}"
    );
}

#[test]
fn a_file_that_changed_since_its_tasks_were_listed_is_said_to_have() {
    let bench = scored();
    small(&bench, &[("\"8x8\", \"12x12\"", "\"8x8\"")]);
    bench.ok("sweep which.toml -q");
    assert_eq!(bench.run("sweep status which.toml").err, "");
    small(&bench, &[("\"8x8\", \"12x12\"", "\"9x9\"")]);
    for words in ["status", "show", "collect"] {
        let ran = bench.run(&format!("sweep {words} which.toml"));
        assert_eq!(ran.code, 0, "{}", ran.err);
        assert!(
            ran.err
                .contains("which.toml has changed since its tasks were listed"),
            "{}",
            ran.err
        );
    }
}

#[test]
fn a_recording_whose_header_changed_is_another_one_and_scored_anew() {
    let bench = scored();
    small(&bench, &[("\"8x8\", \"12x12\"", "\"8x8\"")]);
    bench.ok("sweep which.toml -q");
    let before = text(&bench, "which.sweep/table.csv");
    let header = text(&bench, "monday/dataset.toml");
    assert!(header.contains("\"drawn\""), "{header}");
    bench.write(
        "monday/dataset.toml",
        &header.replace("\"drawn\"", "\"drawn again\""),
    );
    bench.ok("reseal monday --reason corrected -q");
    bench.ok("sweep which.toml -q");
    let after = text(&bench, "which.sweep/table.csv");
    assert!(before.contains(",drawn,"), "{before}");
    assert!(
        after.contains(",drawn again,") && !after.contains(",drawn,"),
        "{after}"
    );
}
