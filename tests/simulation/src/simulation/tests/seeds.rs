//! Tests that many seeds violate no invariant, and that the oracle finds planted bugs.

use crate::simulation::fault::{FaultCounts, FaultKind};
use crate::simulation::oracle::{Checks, HALT_WITHIN_S, Violation};
use crate::simulation::scenario::{simulate, simulate_with};
use crate::simulation::world::Sabotage;

#[test]
fn five_hundred_seeds_pass_without_a_violation_and_strike_with_every_fault() {
    let mut struck = FaultCounts::default();
    let mut checks = Checks::default();
    let mut seeds_of = [0_u32; FaultKind::ALL.len()];
    for seed in 0..500 {
        let report = simulate(seed);
        assert_eq!(
            report.violations,
            [],
            "seed {seed}: play it again with `cargo run -p taceva-simulation --example faults -- 1 {seed}`"
        );
        for kind in FaultKind::ALL {
            seeds_of[kind as usize] += u32::from(report.struck.of(kind) > 0);
        }
        struck.add(&report.struck);
        checks.join(&report.checks);
    }
    for kind in FaultKind::ALL {
        assert!(
            seeds_of[kind as usize] >= 10,
            "{kind} struck in too few seeds"
        );
    }
    assert!(checks.halts > 500 && checks.samples > 5_000 && checks.motions > 100_000);
    assert!(checks.redone >= 10, "{checks:?}");
    assert!(checks.slowest_halt_s <= HALT_WITHIN_S);
}

/// Plays seeds in which the force limit was exceeded under a frozen signal. The oracle must distinguish a retreating tip from an approaching tip. It
/// must also distinguish a force that no reading showed from an ignored force.
#[test]
fn the_limit_is_passed_under_a_frozen_signal_by_no_more_than_is_stated() {
    for seed in [3074, 4881, 8150, 8592, 9366] {
        let report = simulate(seed);
        assert_eq!(report.violations, [], "seed {seed}");
        assert!(report.struck.of(FaultKind::Freeze) > 0, "seed {seed}");
    }
}

#[test]
fn a_tip_that_goes_sideways_over_an_uneven_gel_is_no_deeper_than_where_it_touched() {
    assert_eq!(simulate(16921).violations, []);
}

#[test]
fn a_seed_is_the_same_run_every_time() {
    for seed in [3, 17, 42] {
        assert_eq!(simulate(seed), simulate(seed));
    }
}

/// Violations in the runs of seeds 0 to 59 with a planted bug.
fn found_with(sabotage: Sabotage) -> Vec<Violation> {
    let reports = (0..60).map(|seed| simulate_with(seed, sabotage));
    reports.flat_map(|report| report.violations).collect()
}

#[test]
fn the_judge_finds_limits_that_were_loosened() {
    let found = found_with(Sabotage::LooseLimits);
    assert!(
        found
            .iter()
            .any(|found| matches!(found, Violation::TooHard { .. })),
        "{found:?}"
    );
}

#[test]
fn the_judge_finds_halts_that_come_late() {
    let found = found_with(Sabotage::SlowHalt);
    assert!(
        found
            .iter()
            .any(|found| matches!(found, Violation::LateHalt { .. })),
        "{found:?}"
    );
}

#[test]
fn the_judge_finds_a_disk_that_acknowledges_what_it_did_not_sync() {
    let found = found_with(Sabotage::LazyDisk);
    assert!(
        found
            .iter()
            .any(|found| matches!(found, Violation::Lost(_) | Violation::Doubled(_))),
        "{found:?}"
    );
}

#[test]
fn the_judge_finds_frames_of_another_time() {
    let found = found_with(Sabotage::OldFrames);
    assert!(
        found
            .iter()
            .any(|found| matches!(found, Violation::Untrue(_))),
        "{found:?}"
    );
}

#[test]
fn the_judge_finds_a_guard_that_does_not_heed_the_enabling_switch() {
    let found = found_with(Sabotage::UnheededSwitch);
    for wanted in [
        |found: &Violation| matches!(found, Violation::LateHalt { .. }),
        |found: &Violation| matches!(found, Violation::Defied(_)),
    ] {
        assert!(found.iter().any(wanted), "{found:?}");
    }
}
