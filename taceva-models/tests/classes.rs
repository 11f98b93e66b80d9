//! Classes predicted by networks: labels, probabilities and files.

use taceva_core::random::SplitMix64;
use taceva_core::{
    Channel, Channels, Features, FrameInfo, PixelFormat, SilentProgress, Targets, TrainingSet, Unit,
};
use taceva_models::{FeatureSpec, FitInput, Model, ModelSettings, Provenance, find};

const FRAME: FrameInfo = FrameInfo {
    width: 32,
    height: 24,
    format: PixelFormat::Gray8,
};

const SPEC: FeatureSpec = FeatureSpec {
    width: 32,
    height: 24,
    ..FeatureSpec::DEFAULT
};

/// Pictures and their labels.
struct Halves {
    features: Features,
    labels: Vec<f64>,
}

impl Halves {
    fn set<'a>(&'a self, channels: &'a Channels) -> TrainingSet<'a> {
        TrainingSet::new(&self.features, Targets::new(channels, &self.labels))
    }
}

/// Noisy pictures whose left or right half is brighter, with the label 0 or 3. Every fourth is of the right half.
fn halves(count: usize, seed: u64) -> Halves {
    let mut random = SplitMix64::new(seed);
    let (mut values, mut labels) = (Vec::new(), Vec::new());
    for sample in 0..count {
        let is_right = sample % 4 == 3;
        for place in 0..32 * 24 {
            let is_bright = (place % 32 >= 16) == is_right;
            let noise = f32::from(random.next_u64().to_le_bytes()[0]) / 255.0;
            values.push(0.2 * noise + if is_bright { 0.6 } else { 0.3 });
        }
        labels.push(if is_right { 3.0 } else { 0.0 });
    }
    Halves {
        features: Features::new(SPEC.shape(), values).expect("whole samples"),
        labels,
    }
}

fn fit(words: &[&str], training: &Halves, held: Option<&Halves>) -> Model {
    let settings = ["head=classes", "batch=16", "appearance=light"];
    let settings = ModelSettings::parse(settings.into_iter().chain(words.iter().copied()));
    let settings = settings.expect("pairs");
    let estimator = find("cnn").expect("registered").estimator(&settings);
    let side = Channel::named("side", Unit::One).expect("a name");
    let channels = Channels::new([side]).expect("one");
    let estimator = estimator.expect("valid");
    let input = FitInput {
        estimator: &*estimator,
        settings: &settings,
        features: SPEC,
        input: FRAME.into(),
        training: training.set(&channels),
        validation: held.map(|held| held.set(&channels)),
        provenance: Provenance::default(),
    };
    Model::fit(input, &SilentProgress).expect("learnable")
}

#[test]
fn a_network_predicts_labels_of_the_fit_with_probabilities_that_its_file_keeps() {
    let (training, held) = (halves(64, 1), halves(24, 2));
    let model = fit(&["epochs=25"], &training, Some(&held));
    let card = model.card().network.as_ref().expect("a network");
    let classes = card.classes.as_ref().expect("classes");
    assert_eq!(classes.labels, [0.0, 3.0]);
    assert_eq!(classes.calibrated_on, 24);

    let Halves {
        features: unseen,
        labels: expected,
    } = halves(40, 3);
    let found = model.predict(&unseen).expect("finite");
    let is_right = |(found, expected): &(&f64, &f64)| found.total_cmp(expected).is_eq();
    let right = found.iter().zip(&expected).filter(is_right).count();
    assert!(right >= 38, "{right} of 40");

    let shares = model.probabilities(&unseen).expect("finite");
    let shares = shares.expect("a network of classes knows them");
    for (sample, found) in shares.samples().zip(&found) {
        assert!((sample.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        let likelier = usize::from(sample[1] > sample[0]);
        assert_eq!(shares.labels[likelier].to_bits(), found.to_bits());
    }

    let reopened = Model::from_bytes(&model.to_bytes().expect("small")).expect("opens");
    assert_eq!(reopened, model);
    let again = reopened.probabilities(&unseen).expect("finite");
    assert_eq!(again, Some(shares));
}

#[test]
fn samples_of_a_label_that_the_training_part_lacks_do_not_calibrate() {
    let (training, mut held) = (halves(32, 1), halves(8, 2));
    held.labels[0] = 1.0;
    let model = fit(&["epochs=1"], &training, Some(&held));
    let card = model.card().network.as_ref().expect("a network");
    let classes = card.classes.as_ref().expect("classes");
    assert_eq!((classes.labels.len(), classes.calibrated_on), (2, 7));
}

#[test]
fn a_single_label_is_predicted_with_certainty_and_without_features() {
    let mut training = halves(16, 1);
    training.labels.fill(3.0);
    let model = fit(&["epochs=1"], &training, None);
    assert!(!model.reads_features());
    let unseen = halves(2, 2).features;
    assert_eq!(model.predict(&unseen).expect("finite"), [3.0, 3.0]);
    let shares = model.probabilities(&unseen).expect("finite");
    assert_eq!(shares.expect("known").shares, [1.0, 1.0]);
}
