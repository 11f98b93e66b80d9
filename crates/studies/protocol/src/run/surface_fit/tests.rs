use super::*;
use crate::run::rig::Draws;

/// Step of a search, in mm.
const STEP_MM: f64 = 0.1;
/// Length of a segment of a step, in mm.
const SEGMENT_MM: f64 = 0.015;
const THRESHOLD_N: f64 = 0.02;
const WINDOW_MM: f64 = 0.6;
const SEEDS: u32 = 200;

/// Readings of a search for a gel at height 0, and the height of the first contact.
///
/// A search reads at the end of each segment, and once more at the end of each step. The search begins at a random height, as over a tilted gel.
fn search(seed: u32, noise_n: f64, law: fn(f64) -> f64) -> (Vec<DepthForce>, f64) {
    let mut draws = Draws::new(u64::from(seed));
    // Error of the zero of the force: a mean of sixteen readings.
    let zero_n = 0.25 * noise_n * draws.normal();
    let mut end_mm = -STEP_MM * (9.0 + draws.fraction());
    let mut readings = Vec::new();
    loop {
        let start_mm = end_mm;
        end_mm += STEP_MM;
        let segments = (1..=7).map(|segment| start_mm + f64::from(segment) * SEGMENT_MM);
        for z_mm in segments.map(|z_mm| z_mm.min(end_mm)).chain([end_mm]) {
            readings.push(DepthForce {
                z_mm,
                force_n: law(z_mm.max(0.0)) + zero_n + noise_n * draws.normal(),
            });
        }
        let last = readings.last().expect("a reading");
        if last.force_n >= THRESHOLD_N {
            return (readings, end_mm);
        }
    }
}

/// Errors of fitted heights over all seeds.
#[derive(Debug)]
struct Errors {
    mean_mm: f64,
    deviation_mm: f64,
    /// Share of the seeds for which the error is at most 1.96 standard uncertainties.
    held: f64,
    greatest_mm: f64,
    /// Greatest depth of a fitted height below the gel, in mm. A press to the depth limit goes deeper than the limit by this amount.
    lowest_mm: f64,
}

fn errors(noise_n: f64, law: fn(f64) -> f64) -> Errors {
    let (mut sum, mut squares, mut held, mut greatest_mm) = (0.0, 0.0, 0.0, 0.0_f64);
    let mut lowest_mm = f64::NEG_INFINITY;
    for seed in 0..SEEDS {
        let (readings, contact_mm) = search(seed, noise_n, law);
        let found = surface(&readings, contact_mm, WINDOW_MM).expect("a gel");
        // The gel is at 0.
        let error_mm = found.height_mm;
        sum += error_mm;
        squares += error_mm * error_mm;
        held += f64::from(u8::from(error_mm.abs() <= 1.96 * found.deviation_mm));
        greatest_mm = greatest_mm.max(error_mm.abs());
        lowest_mm = lowest_mm.max(error_mm);
    }
    let count = f64::from(SEEDS);
    let mean_mm = sum / count;
    Errors {
        mean_mm,
        deviation_mm: (squares / count - mean_mm * mean_mm).sqrt(),
        held: held / count,
        greatest_mm,
        lowest_mm,
    }
}

fn linear(depth_mm: f64) -> f64 {
    2.0 * depth_mm
}

/// Force in N of a sphere of 2 mm radius at `depth_mm` in a gel of 0.3 MPa.
fn ball(depth_mm: f64) -> f64 {
    0.754 * depth_mm * depth_mm.sqrt()
}

#[test]
fn the_height_of_a_noisy_linear_gel_is_found_to_hundredths_wherever_a_step_meets_it() {
    let errors = errors(0.004, linear);
    assert!(errors.mean_mm.abs() < 0.005, "{errors:?}");
    assert!(errors.deviation_mm < 0.01, "{errors:?}");
    assert!(errors.held >= 0.95, "{errors:?}");
    assert!(errors.lowest_mm <= 0.02, "{errors:?}");
}

#[test]
fn the_height_below_a_ball_is_found_within_its_uncertainty() {
    let errors = errors(0.004, ball);
    assert!(errors.mean_mm.abs() < 0.01, "{errors:?}");
    assert!(errors.deviation_mm < 0.02, "{errors:?}");
    assert!(errors.held >= 0.93, "{errors:?}");
    assert!(errors.lowest_mm <= 0.06, "{errors:?}");
}

#[test]
fn without_noise_the_height_is_found_to_micrometres_under_either_law() {
    for law in [linear, ball] {
        let errors = errors(1e-6, law);
        assert!(errors.greatest_mm < 0.008, "{errors:?}");
        assert!(errors.mean_mm.abs() < 0.001, "{errors:?}");
    }
}

#[test]
fn the_height_is_never_below_the_first_contact_nor_above_the_window() {
    for seed in 0..SEEDS {
        let (readings, contact_mm) = search(seed, 0.006, ball);
        if let Ok(found) = surface(&readings, contact_mm, WINDOW_MM) {
            let above_mm = contact_mm - found.height_mm;
            assert!(
                (0.0..=WINDOW_MM + 1e-6).contains(&above_mm),
                "seed {seed}: {above_mm}"
            );
        }
    }
}

#[test]
fn a_force_that_does_not_rise_gives_no_height() {
    let mut draws = Draws::new(7);
    let readings: Vec<DepthForce> = (0..40)
        .map(|number| DepthForce {
            z_mm: 0.015 * f64::from(number),
            force_n: 0.004 * draws.normal(),
        })
        .collect();
    assert_eq!(
        surface(&readings, 0.585, WINDOW_MM),
        Err(ZeroUnknown::NoRise)
    );
}

#[test]
fn readings_that_are_all_in_contact_give_no_height() {
    let readings: Vec<DepthForce> = (0..40)
        .map(|number| DepthForce {
            z_mm: 0.015 * f64::from(number),
            force_n: 0.5 + 2.0 * 0.015 * f64::from(number),
        })
        .collect();
    let found = surface(&readings, 0.585, WINDOW_MM);
    assert_eq!(found, Err(ZeroUnknown::NoneWithoutContact));
}

#[test]
fn the_uncertainty_grows_with_the_noise() {
    let of = |noise_n| {
        let (readings, contact_mm) = search(3, noise_n, linear);
        surface(&readings, contact_mm, WINDOW_MM)
            .expect("a gel")
            .deviation_mm
    };
    assert!(of(0.006) > of(0.003) && of(0.003) > of(0.000_1));
}
