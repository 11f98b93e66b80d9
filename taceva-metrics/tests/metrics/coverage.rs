//! Intervals by contact point contain the expected score as often as stated; intervals by sample do not. The presses are simulated;
//! `examples/coverage.rs` runs more designs.

use std::sync::LazyLock;

use crate::support::simulation::{Coverage, Design, Each, METRICS, Method, coverage};
use taceva_metrics::{BootstrapEnds, PoissonBootstrap};

/// Design of a calibration: four presses at each of 400 locations.
const CALIBRATION: Design = Design {
    locations: 400,
    presses: 4,
};
const RUNS: u32 = 300;
/// Coverage of a calibration by location, which two tests read.
static BY_LOCATION: LazyLock<Each<Coverage>> =
    LazyLock::new(|| coverage(CALIBRATION, Method::Jackknife, 0..RUNS));

#[test]
fn intervals_by_location_hold_95_percent() {
    for coverage in *BY_LOCATION {
        assert_eq!(coverage.intervals, RUNS);
        // Three standard errors of 300 runs are 0.038.
        assert!((0.912..=0.988).contains(&coverage.share()), "{coverage:?}");
    }
}

#[test]
fn intervals_of_few_locations_hold_90_percent() {
    let few = Design {
        locations: 10,
        presses: 4,
    };
    for ((metric, _), coverage) in METRICS
        .iter()
        .zip(coverage(few, Method::Jackknife, 0..RUNS))
    {
        assert_eq!(coverage.intervals, RUNS, "{metric}");
        // 0.90 minus three standard errors of 300 runs.
        assert!(coverage.share() >= 0.85, "{metric}: {coverage:?}");
    }
}

#[test]
fn intervals_by_sample_hold_too_little() {
    // Presses at one location are alike: their mean is less certain than the mean of as many independent presses.
    let by_sample = coverage(CALIBRATION, Method::JackknifeBySample, 0..RUNS);
    let scores = METRICS.iter().zip(by_sample.iter().zip(*BY_LOCATION));
    // The magnitudes of errors at one location are alike; their signs are independent.
    for ((metric, _), (by_sample, by_location)) in
        scores.filter(|((metric, _), _)| *metric != "bias")
    {
        assert!(
            by_sample.held < by_location.held,
            "{metric}: {by_sample:?} {by_location:?}"
        );
    }
    let mean_absolute_error = by_sample[0];
    assert!(
        mean_absolute_error.share() < 0.912,
        "{mean_absolute_error:?}"
    );
}

#[test]
fn bootstrap_intervals_hold_nearly_as_much() {
    const RUNS: u32 = 150;
    for ends in [BootstrapEnds::Normal, BootstrapEnds::Percentile] {
        // Ends of 199 replicates take a fifth of the time of 1,000, and cover about 0.004 less.
        let bootstrap = PoissonBootstrap::DEFAULT
            .with_replicates(199)
            .with_ends(ends);
        for coverage in coverage(CALIBRATION, Method::Bootstrap(bootstrap), 0..RUNS) {
            if coverage.intervals == 0 {
                continue;
            }
            assert_eq!(coverage.intervals, RUNS);
            // Percentiles cover at least 0.925 in long runs; three standard errors of 150 runs are 0.065.
            assert!(coverage.share() >= 0.86, "{ends}: {coverage:?}");
        }
    }
}

#[test]
fn runs_add_up_whoever_computes_them() {
    let method = Method::Jackknife;
    let mut parts = coverage(CALIBRATION, method, 0..7);
    let rest = coverage(CALIBRATION, method, 7..20);
    parts
        .iter_mut()
        .zip(rest)
        .for_each(|(part, rest)| *part += rest);
    assert_eq!(parts, coverage(CALIBRATION, method, 0..20));
}

#[test]
fn the_page_has_a_row_of_every_metric_with_an_interval() {
    let page = include_str!("../../../docs/coverage.md");
    // Maxima and scores of all times together, and the factor of a tolerance interval, whose truth depends on the number of points.
    let without = [
        "crosstalk",
        "bias_level",
        "inter_sensor",
        "intrinsic",
        "tolerance_interval",
    ];
    for metric in taceva_metrics::catalogue::ALL {
        let row = format!("\n| {} ", metric.id);
        let is_left_out = without.contains(&metric.id);
        assert_eq!(page.contains(&row), !is_left_out, "{}", metric.id);
    }
}

#[test]
fn the_page_states_the_studies_that_the_example_draws() {
    // Words, wherever a line of the page ends.
    let page = include_str!("../../../docs/coverage.md");
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    let example = include_str!("../../examples/coverage_by_metric.rs");
    for (code, words) in [
        (
            "const RUNS: u32 = 1000;",
            "Each column has 1,000 simulated studies.",
        ),
        (
            "const POINTS_OF_TRUTH: u32 = 20_000;",
            "one study of 20,000 locations",
        ),
        (
            "const REPEATS: u32 = 2;",
            "presses and releases at random locations, twice each",
        ),
        (
            "const FALLING: &str = \"tolerance_interval\";",
            "The table omits `tolerance_interval`",
        ),
        (
            "const LIGHT: u32 = 30;",
            "`detection_limit` is computed from 30 light presses in both columns.",
        ),
        (
            "const LIGHT_STUDIES: u32 = 4000;",
            "the mean over 4,000 such studies",
        ),
    ] {
        assert!(example.contains(code), "{code}");
        assert!(page.contains(words), "{words}");
    }
}
