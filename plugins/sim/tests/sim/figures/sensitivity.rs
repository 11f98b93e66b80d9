//! Sensitivity S, its uniformity U, and the range of forces.

use taceva_sim::{Label, Model};

use super::calibration::{SEEDS, labels};

/// Number of bins along x, and along y.
const BINS: usize = 15;
/// Force below which the ratio of travel and force is ignored.
const GATE_N: f64 = 0.02;
/// Published sensitivity S, mm/N, and uniformity U of each sensor.
pub(crate) const PUBLISHED: [(Model, f64, f64); 4] = [
    (Model::GelSight, 0.857, 0.900),
    (Model::GelSightWm, 0.948, 0.892),
    (Model::MagicTac, 1.277, 0.875),
    (Model::ViTacTip, 6.753, 0.863),
];
/// Allowed relative deviation of the bench from published values.
pub(crate) const TOLERANCE: f64 = 0.05;

/// Sensitivity S and uniformity U of one run, from Pz/Fz of every label and its mean in each bin: S is the mean μ of the bins, U is 1/(1 + σ/μ) with
/// their standard deviation σ.
pub(crate) fn sensitivity(model: Model, labels: &[Label]) -> (f64, f64) {
    let probing = model.parameters().probing;
    let half = [probing.half_width_mm, probing.half_height_mm];
    let mut bins = vec![(0.0_f64, 0_u32); BINS * BINS];
    for label in labels {
        let [x, y, z] = label.position_mm;
        let force = label.force_n[2];
        if force < GATE_N || z <= 0.0 || x.abs() > half[0] || y.abs() > half[1] {
            continue;
        }
        let bin = |place: f64, half: f64| {
            let share = (place / half + 1.0) / 2.0 * BINS as f64;
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "the place was checked to lie inside"
            )]
            let bin = share as usize;
            bin.min(BINS - 1)
        };
        let (sum, count) = &mut bins[bin(y, half[1]) * BINS + bin(x, half[0])];
        *sum += z / force;
        *count += 1;
    }
    let means: Vec<f64> = bins
        .iter()
        .filter(|(_, count)| *count > 0)
        .map(|(sum, count)| sum / f64::from(*count))
        .collect();
    let n = means.len() as f64;
    let mean = means.iter().sum::<f64>() / n;
    let variance = means.iter().map(|bin| (bin - mean).powi(2)).sum::<f64>() / n;
    (mean, 1.0 / (1.0 + variance.sqrt() / mean))
}

/// Sensitivity S and uniformity U, averaged over the runs.
fn averaged(model: Model) -> (f64, f64) {
    let runs = SEEDS.map(|seed| sensitivity(model, &labels(model, seed)));
    let mean = |value: fn(&(f64, f64)) -> f64| runs.iter().map(value).sum::<f64>() / 3.0;
    (mean(|run| run.0), mean(|run| run.1))
}

fn force_max(model: Model) -> f64 {
    let forces = SEEDS.map(|seed| {
        let labels = labels(model, seed);
        let forces = labels.iter().map(|label| label.force_n[2]);
        forces.fold(0.0, f64::max)
    });
    forces.iter().sum::<f64>() / 3.0
}

#[test]
fn sensitivity_and_uniformity_are_the_published_ones_within_five_per_cent() {
    for (model, published_s, published_u) in PUBLISHED {
        let (s, u) = averaged(model);
        println!("{model}: S {s:.3} mm/N ({published_s}), U {u:.3} ({published_u})");
        assert!(
            (s / published_s - 1.0).abs() < TOLERANCE,
            "{model}: S = {s}"
        );
        assert!(
            (u / published_u - 1.0).abs() < TOLERANCE,
            "{model}: U = {u}"
        );
    }
}

#[test]
fn sensors_are_ranked_by_sensitivity_and_uniformity_as_published() {
    let [gelsight, marker_less, magictac, vitactip] = PUBLISHED.map(|(model, ..)| averaged(model));
    assert!(gelsight.0 < marker_less.0, "{gelsight:?} {marker_less:?}");
    assert!(marker_less.0 < magictac.0 && magictac.0 < vitactip.0);
    assert!(
        gelsight.1.min(marker_less.1) > magictac.1,
        "{gelsight:?} {magictac:?}"
    );
    assert!(magictac.1 > vitactip.1, "{magictac:?} {vitactip:?}");
}

#[test]
fn the_dome_bears_the_least_force() {
    let dome = force_max(Model::ViTacTip);
    println!("{}: greatest force {dome:.2} N", Model::ViTacTip);
    for model in [Model::GelSight, Model::GelSightWm, Model::MagicTac] {
        let force = force_max(model);
        println!("{model}: greatest force {force:.2} N");
        assert!(force > dome, "{model}");
    }
}
