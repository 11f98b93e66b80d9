//! Tests that a study over real sockets equals the same study simulated in the program. `TACEVA_WIRE_PRESSES=60` also compares the scores.

use taceva_tests::wire::{OnTheWire, RUN, compare, finished, scene_of};
use taceva_wire::{BenchOptions, ServeOptions};

const SEED: u64 = 7;
/// Number of presses of the default test, which takes a minute and a half.
const FEW: usize = 10;
/// Minimum number of presses for a comparison of scores.
const WHOLE: usize = 60;
const DEPTH_APART_MM: f64 = 5e-5;
const FORCE_APART_N: f64 = 2e-3;
const SCORES_APART: f64 = 1e-3;

#[test]
#[expect(clippy::print_stderr, reason = "the differences are the result")]
fn a_study_over_sockets_is_the_one_that_is_simulated_in_the_program() {
    let presses = std::env::var("TACEVA_WIRE_PRESSES");
    let presses = presses.map_or(FEW, |count| count.parse().expect("a number of presses"));
    let options = ServeOptions::over(BenchOptions::quiet(SEED));
    let on = OnTheWire::new(&options, &scene_of(presses));
    finished(on.simulated()).expect("it is simulated");
    let before = on.served.bench().truth();
    let took = finished(on.study()).expect("over sockets");
    let moving = on.served.bench().truth().in_motion - before.in_motion;
    let compared = compare(&on, ("simulated", RUN));
    eprintln!(
        "{presses} presses in {:.1} s, {:.1} s of them in motion: {compared:?}",
        took.as_secs_f64(),
        moving.as_secs_f64()
    );
    assert_eq!(compared.samples, 2 * presses);
    assert!(compared.scores > 10);
    assert!(compared.depth_mm <= DEPTH_APART_MM, "{compared:?}");
    assert!(compared.force_n <= FORCE_APART_N, "{compared:?}");
    assert!(compared.shade <= 1, "{compared:?}");
    // A small study tests one or two presses with a model of few samples, so its scores change by more than link noise. R² is undefined if
    // both presses have exactly the same depth.
    let is_of_equal_labels = |name: &String| presses < WHOLE && name.starts_with("r2 ");
    assert!(
        compared.of_one_alone.iter().all(is_of_equal_labels),
        "{compared:?}"
    );
    if presses >= WHOLE {
        assert!(compared.error_part <= SCORES_APART, "{compared:?}");
        assert!(compared.share_part <= SCORES_APART, "{compared:?}");
    }
}
