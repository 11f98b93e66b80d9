//! Intervals by contact location cover the truth as often as they say; intervals by sample do not.

#[path = "golden/recipe.rs"]
#[expect(dead_code, reason = "only the generator is used here")]
mod recipe;
mod support;

use recipe::SplitMix64;
use support::{Row, evaluate};

/// As in a calibration: four presses at each of 400 locations.
const LOCATIONS: u32 = 400;
const PRESSES: u32 = 4;
/// Correlation of the errors of one location.
const CORRELATION: f64 = 0.3;
const REPETITIONS: usize = 300;

/// How often the interval of the mean absolute error holds E|d| = √(2/π) of standard Gaussian errors.
fn coverage(cluster: fn(location: u32, press: u32) -> u32) -> f64 {
    let expected = (2.0 / std::f64::consts::PI).sqrt();
    let mut random = SplitMix64(400);
    let mut held = 0.0;
    for _ in 0..REPETITIONS {
        let mut rows = Vec::new();
        for location in 0..LOCATIONS {
            let shared = CORRELATION.sqrt() * random.bell();
            for press in 0..PRESSES {
                let error = shared + (1.0 - CORRELATION).sqrt() * random.bell();
                rows.push(Row::same(0.0, error, cluster(location, press)));
            }
        }
        let evaluation = evaluate(&rows);
        let score = evaluation.score("mae", "Fx").expect("a score");
        let [low, high] = score.interval.ends().expect("enough clusters");
        held += f64::from(u8::from(low <= expected && expected <= high));
    }
    held / f64::from(u32::try_from(REPETITIONS).expect("a few hundred"))
}

#[test]
fn intervals_by_location_cover_95_percent() {
    // Three standard errors of 300 repetitions are 0.038.
    let covered = coverage(|location, _| location);
    assert!((0.912..=0.988).contains(&covered), "{covered}");
}

#[test]
fn intervals_by_sample_would_be_too_narrow() {
    // Presses at one location share part of their error: their mean is less certain than that of as many independent ones.
    let by_sample = coverage(|location, press| location * PRESSES + press);
    let by_location = coverage(|location, _| location);
    assert!(
        by_sample < by_location,
        "{by_sample} is not below {by_location}"
    );
}
