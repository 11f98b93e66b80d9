//! Tests of the distance from the training samples: held-out samples are within the limit, and different samples are beyond it.

use taceva_core::random::SplitMix64;
use taceva_core::{FeatureShape, Features, SilentProgress};
use taceva_models::FeatureDistance;

use crate::model_file::{SPEC, fit};

const SHAPE: FeatureShape = FeatureShape {
    height: 40,
    width: 48,
    depth: 3,
};

/// A number from 0 to 1.
fn unit(random: &mut SplitMix64) -> f32 {
    f32::from(random.next_u64().to_le_bytes()[0]) / 255.0
}

/// Pictures of a dark disc at a random place and of random strength, with noise; `light` is added to every pixel.
fn pictures(count: usize, seed: u64, light: f32, strongest: f32) -> Features {
    let mut random = SplitMix64::new(seed);
    let mut values = Vec::with_capacity(count * SHAPE.len());
    for _ in 0..count {
        let [x, y, strength] = [(); 3].map(|()| unit(&mut random));
        let (x, y) = (8.0 + 32.0 * x, 8.0 + 24.0 * y);
        for row in 0..SHAPE.height {
            for column in 0..SHAPE.width {
                let square = (row as f32 - y).powi(2) + (column as f32 - x).powi(2);
                let dark = strongest * strength * (-square / 60.0).exp();
                for channel in 0..SHAPE.depth {
                    let noise = 0.02 * (unit(&mut random) - 0.5);
                    values.push(0.5 + 0.1 * channel as f32 + light - dark + noise);
                }
            }
        }
    }
    Features::new(SHAPE, values).expect("whole")
}

fn fitted(training: &Features, groups: Option<&[u32]>) -> FeatureDistance {
    let distance = FeatureDistance::fit(training, groups, &SilentProgress).expect("fits");
    distance.expect("enough samples")
}

fn outside(distance: &FeatureDistance, features: &Features) -> f64 {
    let distances = distance.of_all(features).expect("of one shape");
    let count = distances
        .iter()
        .filter(|distance| FeatureDistance::is_outside(**distance));
    count.count() as f64 / distances.len() as f64
}

#[test]
fn about_one_in_a_hundred_new_pictures_of_the_same_kind_lies_outside() {
    let shares: Vec<f64> = (0..10)
        .map(|seed| {
            let distance = fitted(&pictures(300, 2 * seed, 0.0, 0.3), None);
            outside(&distance, &pictures(200, 2 * seed + 1, 0.0, 0.3))
        })
        .collect();
    let mean = shares.iter().sum::<f64>() / shares.len() as f64;
    assert!((0.0005..0.03).contains(&mean), "{mean}: {shares:?}");
}

#[test]
fn another_light_a_stronger_press_a_dead_row_and_noise_lie_outside() {
    let distance = fitted(&pictures(300, 1, 0.0, 0.3), None);
    for (what, light, strongest) in [("brighter", 0.05, 0.3), ("darker", -0.05, 0.3)] {
        let share = outside(&distance, &pictures(50, 7, light, strongest));
        assert!(share > 0.99, "{what}: {share}");
    }
    let strong = pictures(1, 9, 0.0, 3.0);
    assert!(outside(&distance, &strong) > 0.99);
    let mut dead = pictures(1, 11, 0.0, 0.3).values().to_vec();
    dead[20 * 48 * 3..22 * 48 * 3].fill(0.0);
    let noise: Vec<f32> = {
        let mut random = SplitMix64::new(3);
        (0..SHAPE.len()).map(|_| unit(&mut random)).collect()
    };
    let not_a_number = vec![f32::NAN; SHAPE.len()];
    for (what, values) in [("dead", dead), ("noise", noise), ("NaN", not_a_number)] {
        let found = distance.of(&values).expect("of its shape");
        assert!(FeatureDistance::is_outside(found), "{what}: {found}");
    }
}

#[test]
fn a_group_is_held_out_whole_so_that_new_groups_are_no_novelty() {
    // Ten similar pictures of each of 30 places. With single held-out pictures, another place looks new.
    let mut random = SplitMix64::new(5);
    let mut samples = |places: u32| -> (Features, Vec<u32>) {
        let mut values = Vec::new();
        let mut groups = Vec::new();
        for place in 0..places {
            let centre: Vec<f32> = (0..60).map(|_| unit(&mut random)).collect();
            for _ in 0..10 {
                values.extend(centre.iter().map(|value| value + 0.001 * unit(&mut random)));
                groups.push(place);
            }
        }
        let features = Features::new(FeatureShape::flat(60), values);
        (features.expect("whole"), groups)
    };
    let ((training, groups), (fresh, _)) = (samples(30), samples(30));
    let by_group = fitted(&training, Some(&groups));
    let singly: Vec<u32> = (0..300).collect();
    let by_sample = fitted(&training, Some(&singly));
    let [grouped, single] = [by_group, by_sample].map(|distance| outside(&distance, &fresh));
    assert!(
        grouped < 0.2 && single > 2.0 * grouped,
        "{grouped}, {single}"
    );
}

#[test]
fn too_few_samples_and_samples_that_never_change_have_no_distance_and_other_groups_are_refused() {
    let fit = |features: &Features, groups: Option<&[u32]>| {
        FeatureDistance::fit(features, groups, &SilentProgress)
    };
    let few = pictures(19, 1, 0.0, 0.3);
    assert_eq!(fit(&few, None).expect("fits"), None);
    let even = Features::new(FeatureShape::flat(3), [0.1, 0.2, 0.3].repeat(40)).expect("whole");
    assert_eq!(fit(&even, None).expect("fits"), None);
    let enough = pictures(20, 1, 0.0, 0.3);
    assert!(fit(&enough, None).expect("fits").is_some());
    let error = fit(&enough, Some(&[0; 19])).expect_err("one too few");
    assert!(
        error.to_string().contains("19 groups for 20 samples"),
        "{error}"
    );
    let distance = fitted(&enough, None);
    assert!(distance.of(&[0.0; 3]).is_err());
}

#[test]
fn a_model_knows_the_distance_of_what_it_predicts_and_one_that_looks_at_nothing_does_not() {
    let (model, features) = fit("ridge", &[], SPEC);
    let distances = model
        .distances(&features)
        .expect("of its shape")
        .expect("known");
    assert_eq!(distances.len(), 60);
    let shifted: Vec<f32> = features.values().iter().map(|value| value + 4.0).collect();
    let shifted = Features::new(features.shape(), shifted).expect("whole");
    let far = model
        .distances(&shifted)
        .expect("of its shape")
        .expect("known");
    assert!(far.iter().all(|far| *far > 2.0), "{far:?}");
    let (baseline, _) = fit("baseline", &[], SPEC);
    assert_eq!(baseline.distances(&features).expect("none"), None);
    let components = taceva_models::FeatureSpec {
        pca: Some(5),
        ..SPEC
    };
    let (through, _) = fit("ridge", &[], components);
    let of_components = through.distances(&features).expect("of its shape");
    assert_eq!(
        of_components,
        Some(distances),
        "components are of no account"
    );
}
