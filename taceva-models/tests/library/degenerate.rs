//! Recordings on which libraries panic or predict NaN: every model fits them or returns an error with its name.

use taceva_core::{
    Channel, Channels, ErrorKind, FeatureShape, Features, Regressor, SilentProgress, Targets,
    TrainingSet, Unit,
};
use taceva_models::{ModelSettings, Models, library_models};

const WIDTH: usize = 6;

/// Samples of six features, with the labels of some channels.
#[derive(Clone)]
struct Data {
    features: Vec<f32>,
    channels: Channels,
    labels: Vec<f64>,
}

/// Random features and labels.
fn data(samples: usize, channels: usize) -> Data {
    let number = |seed: usize| {
        let mixed = (seed as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        (mixed >> 40) as f32 / 16_777_216.0
    };
    let named = |channel: usize| Channel::named(&format!("load{channel:03}"), Unit::Newton);
    let list: Result<Vec<Channel>, _> = (0..channels).map(named).collect();
    Data {
        features: (0..samples * WIDTH).map(number).collect(),
        channels: Channels::new(list.expect("good names")).expect("distinct"),
        // Five levels, so that classifiers can be fitted too.
        labels: (0..samples * channels)
            .map(|place| f64::from((number(place + 7919) * 5.0).floor()))
            .collect(),
    }
}

/// Fits every model. Fitted models must predict finite numbers, and other models must not panic. Returns the names of models that reject the data.
fn fit_all(training: &Data, held: Option<&Data>) -> Vec<String> {
    let features = |data: &Data| {
        Features::new(FeatureShape::flat(WIDTH), data.features.clone()).expect("whole samples")
    };
    let (seen, held_seen) = (features(training), held.map(features));
    fn set<'a>(data: &'a Data, features: &'a Features) -> TrainingSet<'a> {
        TrainingSet::new(features, Targets::new(&data.channels, &data.labels))
    }
    let held_set = held.zip(held_seen.as_ref());
    let held_set = held_set.map(|(data, features)| set(data, features));
    let models = Models::builtin().with_libraries(library_models());
    let mut refused = Vec::new();
    for model in library_models() {
        let name = model.info.name;
        let estimator = models.find(name).expect("registered");
        let estimator = estimator
            .estimator(&ModelSettings::default())
            .expect("defaults");
        match estimator.fit_model(&set(training, &seen), held_set.as_ref(), &SilentProgress) {
            Ok(fit) => {
                let mut found = vec![f64::NAN; training.labels.len()];
                fit.regressor.predict(&seen, &mut found).expect("finite");
                assert!(found.iter().all(|value| value.is_finite()), "{name}");
            }
            Err(error) => {
                assert_ne!(error.kind(), ErrorKind::Panicked, "{name}: {error}");
                refused.push(format!("{name}: {error}"));
            }
        }
    }
    refused
}

#[test]
fn a_constant_column_among_others_is_learnt_around() {
    let mut training = data(30, 2);
    let column = training.features.iter_mut().skip(2).step_by(WIDTH);
    column.for_each(|value| *value = 0.1);
    assert_eq!(fit_all(&training, None), [] as [&str; 0]);
}

#[test]
fn rows_that_stand_there_twice_are_learnt_from_with_equal_and_with_other_labels() {
    let one = data(15, 2);
    let mut twice = one.clone();
    twice.features.extend(one.features.iter());
    twice.labels.extend(one.labels.iter());
    assert_eq!(fit_all(&twice, None), [] as [&str; 0]);
    let others = twice.labels.iter_mut().skip(30);
    others.for_each(|label| *label += 1.0);
    assert_eq!(fit_all(&twice, None), [] as [&str; 0]);
}

#[test]
fn columns_that_depend_on_each_other_are_learnt_from() {
    let mut training = data(30, 2);
    for row in training.features.chunks_exact_mut(WIDTH) {
        row[3] = row[1];
        row[4] = -2.0 * row[0];
    }
    assert_eq!(fit_all(&training, None), [] as [&str; 0]);
}

#[test]
fn one_sample_is_refused_by_all_and_two_by_those_that_need_more() {
    let refused = fit_all(&data(1, 2), None);
    assert_eq!(refused.len(), library_models().count());
    let few = |said: &String| said.contains("1 training sample, at least 2 are needed");
    assert!(refused.iter().all(few), "{refused:?}");
    let refused = fit_all(&data(2, 2), None);
    assert_eq!(refused.len(), 1, "{refused:?}");
    assert!(refused[0].starts_with("smartcore/svr: 2 training samples, smartcore/svr needs"));
}

#[test]
fn more_features_than_samples_are_learnt_from_by_all_but_one_which_says_so() {
    let refused = fit_all(&data(WIDTH - 1, 2), None);
    assert_eq!(refused.len(), 1, "{refused:?}");
    let said = "smartcore/svr: 5 training samples, smartcore/svr needs at least as many as there are features, 6: ";
    assert!(refused[0].starts_with(said), "{refused:?}");
}

#[test]
fn numbers_that_are_not_finite_are_refused_by_all_where_they_stand() {
    let mut features = data(12, 2);
    features.features[2 * WIDTH + 4] = f32::NAN;
    let mut labels = data(12, 2);
    labels.labels[3 * 2 + 1] = f64::NAN;
    for (training, place) in [
        (features, "training sample 2: feature 4 is not finite"),
        (labels, "training sample 3: `load001` is not finite"),
    ] {
        let refused = fit_all(&training, None);
        assert_eq!(refused.len(), library_models().count());
        let is_named = |said: &String| said.ends_with(place);
        assert!(refused.iter().all(is_named), "{refused:?}");
    }
}

#[test]
fn two_hundred_and_fifty_six_channels_are_learnt() {
    assert_eq!(fit_all(&data(12, 256), None), [] as [&str; 0]);
}

#[test]
fn a_class_that_only_the_validation_part_has_is_learnt_with_it() {
    let (training, mut held) = (data(30, 1), data(10, 1));
    held.labels[3] = 17.0;
    assert_eq!(fit_all(&training, Some(&held)), [] as [&str; 0]);
    // A class with one training sample is missing when that sample is held out.
    let mut rare = data(30, 1);
    rare.labels[4] = 17.0;
    assert_eq!(fit_all(&rare, None), [] as [&str; 0]);
}
