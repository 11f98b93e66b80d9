//! What a training promises: the same bits however it is run, whole or in parts, and errors that say what and where.

mod common;

use common::{doubles, singles};
use taceva_network::{
    Architecture, Augmentation, Body, Checkpoint, Depth, Jitter, LabelScaling, Labels, Loss,
    NamedTensor, Network, NetworkError, Optimizer, Picture, PlainLayer, Pooling, Recipe, Samples,
    Schedule, Trained, Trainer,
};

const PICTURE: Picture = Picture {
    height: 12,
    width: 10,
    channels: 1,
};

fn architecture() -> Architecture {
    let layer = |channels| PlainLayer {
        channels,
        kernel: 3,
        stride: 2,
    };
    let layers = vec![layer(16), layer(32)];
    Architecture {
        input: PICTURE,
        body: Body::Plain {
            layers,
            pooling: Pooling::Flatten,
        },
        outputs: 2,
    }
}

fn recipe() -> Recipe {
    Recipe {
        epochs: 6,
        batch: 8,
        augmentation: Augmentation {
            brightness: 0.1,
            noise: 0.01,
            jitter: Jitter {
                pixels: 1,
                label_per_pixel: vec![[0.1, 0.0], [0.0, 0.1]],
            },
        },
        ..Recipe::default()
    }
}

/// Pictures whose labels are the sums of their upper and of their left half: something to be learnt.
fn sums(seed: u64, samples: usize) -> (Vec<f32>, Vec<f64>) {
    let pictures = singles(seed, samples * PICTURE.len());
    let labels = pictures.chunks_exact(PICTURE.len()).flat_map(|picture| {
        let rows = picture.chunks_exact(PICTURE.width);
        let upper: f32 = rows.clone().take(6).flatten().sum();
        let left: f32 = rows.flat_map(|row| &row[..5]).sum();
        [f64::from(upper), f64::from(left)]
    });
    let labels = labels.collect();
    (pictures, labels)
}

fn values<'a>((pictures, labels): &'a (Vec<f32>, Vec<f64>)) -> Samples<'a> {
    Samples {
        pictures,
        labels: Labels::Values(labels),
    }
}

fn bits(tensors: &[NamedTensor]) -> Vec<(&str, Vec<u32>)> {
    let tensors = tensors.iter();
    tensors
        .map(|tensor| {
            (
                tensor.name.as_str(),
                tensor.values.iter().map(|value| value.to_bits()).collect(),
            )
        })
        .collect()
}

fn assert_same(found: &Trained, expected: &Trained, what: &str) {
    let (found_tensors, tensors) = (found.network.tensors(), expected.network.tensors());
    assert!(
        bits(&found_tensors) == bits(&tensors),
        "{what}: other weights"
    );
    assert_eq!(found.state, expected.state, "{what}");
}

#[test]
fn something_is_learnt_and_the_best_epoch_is_kept() {
    let (training, validation) = (sums(1, 1024), sums(2, 64));
    let recipe = Recipe {
        epochs: 15,
        augmentation: Augmentation::default(),
        ..recipe()
    };
    let trainer = Trainer::new(
        &architecture(),
        &recipe,
        values(&training),
        Some(values(&validation)),
    );
    let trained = trainer.expect("a training").run().expect("finite");
    let losses: Vec<f64> = trained
        .state
        .epochs
        .iter()
        .map(|epoch| epoch.validation_loss.expect("measured"))
        .collect();
    let least = losses.iter().copied().fold(f64::INFINITY, f64::min);
    let best = usize::try_from(trained.state.best.expect("measured")).expect("few");
    assert_eq!(losses[best].to_bits(), least.to_bits());
    // Predicting the mean has a loss of about a half minus what is cut off.
    assert!(least < 0.1 && losses[0] > 2.0 * least, "{losses:?}");

    let mut found = vec![0.0; 128];
    trained
        .network
        .predictor()
        .predict(&validation.0, &mut found)
        .expect("finite");
    let again: Vec<f64> = found
        .iter()
        .enumerate()
        .map(|(at, value)| trained.scale.unscaled(at % 2, *value))
        .collect();
    let spread = |values: &[f64], from: &[f64]| -> f64 {
        values
            .iter()
            .zip(from)
            .map(|(value, from)| (value - from).powi(2))
            .sum()
    };
    let mean = validation.1.iter().sum::<f64>() / 128.0;
    assert!(spread(&again, &validation.1) < 0.2 * spread(&vec![mean; 128], &validation.1));
}

#[test]
fn a_training_gone_on_with_after_any_step_ends_with_the_same_bits() {
    let (training, validation) = (sums(1, 21), sums(2, 9));
    for optimizer in [
        Optimizer::ADAM_W,
        Optimizer::Sgd {
            momentum: 0.9,
            weight_decay: 1e-4,
        },
    ] {
        let recipe = Recipe {
            epochs: 4,
            optimizer,
            rate: 1e-3,
            ..recipe()
        };
        let begin = || {
            Trainer::new(
                &architecture(),
                &recipe,
                values(&training),
                Some(values(&validation)),
            )
        };
        let whole = begin().expect("a training").run().expect("finite");
        let steps = begin().expect("a training").steps();
        assert_eq!(steps, 8);
        for stop in 0..=steps {
            let mut trainer = begin().expect("a training");
            for _ in 0..stop {
                trainer.step().expect("finite");
            }
            let Checkpoint { summary, tensors } = trainer.checkpoint();
            let text = serde_json::to_string(&summary).expect("text");
            let summary = serde_json::from_str(&text).expect("the same");
            let checkpoint = Checkpoint { summary, tensors };
            let resumed = Trainer::resume(
                checkpoint.clone(),
                values(&training),
                Some(values(&validation)),
            );
            let resumed = resumed.expect("its own checkpoint");
            assert_eq!(resumed.checkpoint(), checkpoint);
            assert_same(
                &resumed.run().expect("finite"),
                &whole,
                &format!("{optimizer:?} after {stop}"),
            );
        }
    }
}

#[test]
fn any_number_of_threads_trains_the_same_bits() {
    let picture = Picture {
        height: 40,
        width: 33,
        channels: 3,
    };
    let pictures = singles(3, 12 * picture.len());
    let labels = doubles(4, 24);
    let samples = Samples {
        pictures: &pictures,
        labels: Labels::Values(&labels),
    };
    let recipe = Recipe {
        epochs: 2,
        batch: 5,
        ..Recipe::default()
    };
    let residual = Architecture::residual(Depth::Ten, picture, 2);
    let plain = Architecture::five_layers(picture, 2);
    for architecture in [residual, plain] {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            pool.build().expect("threads").install(|| {
                let trainer = Trainer::new(&architecture, &recipe, samples, Some(samples));
                trainer.expect("a training").run().expect("finite")
            })
        };
        let alone = with(1);
        for threads in [2, 3] {
            assert_same(&with(threads), &alone, &format!("{threads} threads"));
        }
    }
}

#[test]
fn predictions_do_not_depend_on_what_is_predicted_beside_them() {
    let picture = Picture {
        height: 40,
        width: 33,
        channels: 3,
    };
    let network = common::filled(&Architecture::residual(Depth::Ten, picture, 2), 9);
    let pictures = singles(3, 35 * picture.len());
    let mut predictor = network.predictor();
    let mut all = vec![0.0; 70];
    predictor.predict(&pictures, &mut all).expect("finite");
    for (picture, expected) in pictures
        .chunks_exact(picture.len())
        .zip(all.chunks_exact(2))
        .step_by(9)
    {
        let mut found = [0.0; 2];
        predictor.predict(picture, &mut found).expect("finite");
        assert_eq!(
            found.map(f64::to_bits).to_vec(),
            expected
                .iter()
                .map(|value| value.to_bits())
                .collect::<Vec<_>>()
        );
    }
}

#[test]
fn classes_are_learnt_too() {
    // Bright above or bright below.
    let mut pictures = singles(5, 64 * PICTURE.len());
    let classes: Vec<u32> = (0..64).map(|sample| sample % 2).collect();
    for (picture, class) in pictures.chunks_exact_mut(PICTURE.len()).zip(&classes) {
        let half = PICTURE.len() / 2;
        let bright = if *class == 0 {
            &mut picture[..half]
        } else {
            &mut picture[half..]
        };
        bright.iter_mut().for_each(|value| *value += 0.3);
    }
    let recipe = Recipe {
        loss: Loss::CrossEntropy,
        augmentation: Augmentation::default(),
        ..recipe()
    };
    let samples = Samples {
        pictures: &pictures,
        labels: Labels::Classes(&classes),
    };
    let trained = Trainer::new(&architecture(), &recipe, samples, None)
        .expect("a training")
        .run()
        .expect("finite");
    let mut found = vec![0.0; 128];
    trained
        .network
        .predictor()
        .predict(&pictures, &mut found)
        .expect("finite");
    let right = found
        .chunks_exact(2)
        .zip(&classes)
        .filter(|(row, class)| (row[1] > row[0]) == (**class == 1));
    assert!(right.count() >= 62);
}

#[test]
fn patience_ends_a_training() {
    let (training, validation) = (sums(1, 32), sums(2, 8));
    // So high a rate that nothing gets better for long.
    let recipe = Recipe {
        epochs: 200,
        rate: 0.3,
        schedule: Schedule::Constant,
        patience: Some(3),
        ..recipe()
    };
    let trainer = Trainer::new(
        &architecture(),
        &recipe,
        values(&training),
        Some(values(&validation)),
    );
    let trained = trainer.expect("a training").run().expect("finite");
    assert!(trained.state.is_stopped);
    let best = trained.state.best.expect("measured");
    assert_eq!(trained.state.epochs.len() as u64, best + 4);
}

#[test]
fn a_loss_that_is_not_finite_names_its_step_and_leaves_the_best() {
    let (training, validation) = (sums(1, 16), sums(2, 8));
    let recipe = Recipe {
        epochs: 50,
        rate: 1e30,
        schedule: Schedule::Step {
            every: 1,
            factor: 1.0,
        },
        optimizer: Optimizer::Sgd {
            momentum: 0.9,
            weight_decay: 0.0,
        },
        loss: Loss::SquaredError,
        ..recipe()
    };
    let mut trainer = Trainer::new(
        &architecture(),
        &recipe,
        values(&training),
        Some(values(&validation)),
    )
    .expect("a training");
    let error = loop {
        match trainer.step() {
            Ok(Some(_)) => {}
            Ok(None) => panic!("such a rate breaks any training"),
            Err(error) => break error,
        }
    };
    let made = trainer.state().step;
    let named = match error {
        NetworkError::LossNotFinite { step } | NetworkError::WeightNotFinite { step } => step,
        other => panic!("{other}"),
    };
    assert!(
        named == made || named + 1 == made,
        "step {named}, {made} were made"
    );
    let trained = trainer.finish();
    let finite = |tensors: &[NamedTensor]| {
        tensors
            .iter()
            .flat_map(|tensor| &tensor.values)
            .all(|value| value.is_finite())
    };
    assert!(trained.state.best.is_none() || finite(&trained.network.tensors()));
}

fn refusal(recipe: &Recipe, samples: Samples<'_>) -> String {
    match Trainer::new(&architecture(), recipe, samples, None) {
        Ok(_) => panic!("accepted"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn samples_that_cannot_be_learnt_from_are_refused_where_they_stand() {
    let good = sums(1, 16);
    let few = sums(1, 7);
    assert_eq!(
        refusal(&recipe(), values(&few)),
        "7 training samples, a batch takes 8"
    );
    let mut constant = good.clone();
    constant
        .1
        .iter_mut()
        .skip(1)
        .step_by(2)
        .for_each(|label| *label = 2.5);
    assert_eq!(
        refusal(&recipe(), values(&constant)),
        "output 1: every training label is 2.5, so there is nothing to learn"
    );
    let mut broken = good.clone();
    broken.0[3 * PICTURE.len() + 7] = f32::NAN;
    assert_eq!(
        refusal(&recipe(), values(&broken)),
        "training picture 3: number 7 is not finite"
    );
    let mut broken = good.clone();
    broken.1[9] = f64::INFINITY;
    assert_eq!(
        refusal(&recipe(), values(&broken)),
        "training sample 4: label 1 is not finite"
    );
    let short = (good.0.clone(), good.1[1..].to_vec());
    assert_eq!(
        refusal(&recipe(), values(&short)),
        "training: 31 labels for 16 pictures of 2 outputs"
    );
    let torn = (good.0[1..].to_vec(), good.1.clone());
    assert_eq!(
        refusal(&recipe(), values(&torn)),
        "1919 numbers are no whole number of pictures of 12×10×1"
    );
    let classes = vec![2; 16];
    let samples = Samples {
        pictures: &good.0,
        labels: Labels::Classes(&classes),
    };
    let entropy = Recipe {
        loss: Loss::CrossEntropy,
        ..recipe()
    };
    assert_eq!(
        refusal(&entropy, samples),
        "training sample 0: class 2, the network tells 0 to 1"
    );
    assert!(refusal(&recipe(), samples).starts_with("`loss`: a distance of classes"));
    assert!(refusal(&entropy, values(&good)).starts_with("`loss`: cross entropy of numbers"));
}

#[test]
fn recipes_out_of_range_are_refused_by_name() {
    let good = sums(1, 16);
    let refused = |recipe: Recipe, name: &str| {
        let message = refusal(&recipe, values(&good));
        assert!(message.starts_with(&format!("`{name}`: ")), "{message}");
    };
    refused(
        Recipe {
            epochs: 0,
            ..recipe()
        },
        "epochs",
    );
    refused(
        Recipe {
            batch: 1,
            ..recipe()
        },
        "batch",
    );
    refused(
        Recipe {
            rate: f64::NAN,
            ..recipe()
        },
        "rate",
    );
    refused(
        Recipe {
            schedule: Schedule::OneCycle { rise: 1.0 },
            ..recipe()
        },
        "rise",
    );
    refused(
        Recipe {
            schedule: Schedule::Step {
                every: 0,
                factor: 0.5,
            },
            ..recipe()
        },
        "schedule",
    );
    refused(
        Recipe {
            loss: Loss::Huber { delta: 0.0 },
            ..recipe()
        },
        "delta",
    );
    let momentum = Optimizer::Sgd {
        momentum: 1.0,
        weight_decay: 0.0,
    };
    refused(
        Recipe {
            optimizer: momentum,
            ..recipe()
        },
        "momentum",
    );
    let decay = Optimizer::Sgd {
        momentum: 0.0,
        weight_decay: -1.0,
    };
    refused(
        Recipe {
            optimizer: decay,
            ..recipe()
        },
        "weight_decay",
    );
    let augmentation = Augmentation {
        noise: -1.0,
        ..Augmentation::default()
    };
    refused(
        Recipe {
            augmentation,
            ..recipe()
        },
        "noise",
    );
    let jitter = Jitter {
        pixels: 10,
        label_per_pixel: vec![],
    };
    refused(
        Recipe {
            augmentation: Augmentation {
                jitter,
                ..Augmentation::default()
            },
            ..recipe()
        },
        "jitter",
    );
    let scaling = LabelScaling::MinMax;
    assert!(
        Trainer::new(
            &architecture(),
            &Recipe {
                scaling,
                ..recipe()
            },
            values(&good),
            None
        )
        .is_ok()
    );
}

#[test]
fn tensors_of_another_network_are_refused_by_name() {
    let network = Network::new(&architecture(), 1).expect("a network");
    let refused = |change: fn(&mut Vec<NamedTensor>)| {
        let mut tensors = network.tensors();
        change(&mut tensors);
        Network::from_tensors(&architecture(), tensors)
            .expect_err("refused")
            .to_string()
    };
    assert_eq!(
        refused(|tensors| drop(tensors.remove(0))),
        "no tensor `fc.bias`, which the architecture has"
    );
    assert_eq!(
        refused(|tensors| tensors[0].name = "fc.biass".into()),
        "no tensor `fc.bias`, which the architecture has"
    );
    assert_eq!(
        refused(|tensors| tensors.push(NamedTensor {
            name: "conv9.weight".into(),
            ..tensors[0].clone()
        })),
        "unexpected tensor `conv9.weight`: the architecture has none of that name"
    );
    assert_eq!(
        refused(|tensors| tensors[0].shape = vec![1, 2]),
        "tensor `fc.bias` has the shape [1, 2] and 2 numbers, expected [2]"
    );
    assert_eq!(
        refused(|tensors| tensors[0].values[1] = f32::NAN),
        "tensor `fc.bias`: number 1 is not finite"
    );
    let counted = network.tensors().into_iter().chain([NamedTensor {
        name: "features.0.1.num_batches_tracked".into(),
        shape: vec![],
        values: vec![7.0],
    }]);
    let again = Network::from_tensors(&architecture(), counted)
        .expect("PyTorch's counters are passed over");
    assert_eq!(again.tensors(), network.tensors());
}

#[test]
fn a_checkpoint_of_another_training_is_refused() {
    let (training, other) = (sums(1, 16), sums(1, 24));
    let mut trainer =
        Trainer::new(&architecture(), &recipe(), values(&training), None).expect("a training");
    trainer.step().expect("finite");
    let checkpoint = trainer.checkpoint();
    let error =
        Trainer::resume(checkpoint.clone(), values(&other), None).expect_err("other samples");
    assert_eq!(
        error.to_string(),
        "the checkpoint is of another training: 16 samples, now there are 24"
    );
    let mut torn = checkpoint.clone();
    torn.tensors.retain(|tensor| tensor.name != "moment.1.0");
    let error = Trainer::resume(torn, values(&training), None).expect_err("a tensor is missing");
    assert_eq!(
        error.to_string(),
        "the checkpoint is of another training: `moment.1.0` is missing or does not have 16 numbers"
    );
}

#[test]
fn parameters_are_counted_as_they_are() {
    for architecture in [
        architecture(),
        Architecture::residual(Depth::ThirtyFour, PICTURE, 3),
    ] {
        let network = Network::new(&architecture, 1).expect("a network");
        assert_eq!(
            architecture.parameters().expect("checked"),
            network.parameters()
        );
    }
}

#[test]
fn networks_that_cannot_be_built_are_refused() {
    let refused = |architecture: Architecture| {
        Network::new(&architecture, 1)
            .expect_err("refused")
            .to_string()
    };
    let mut odd = architecture();
    let Body::Plain { layers, .. } = &mut odd.body else {
        panic!("plain")
    };
    layers[1].channels = 24;
    assert!(refused(odd).contains("layer 1: 24 channels"));
    let nothing = Picture {
        height: 0,
        ..PICTURE
    };
    assert!(
        refused(Architecture {
            input: nothing,
            ..architecture()
        })
        .contains("none may be zero")
    );
    let huge = Picture {
        height: 1 << 20,
        width: 1 << 20,
        channels: 3,
    };
    assert!(refused(Architecture::residual(Depth::Ten, huge, 1)).contains("too large"));
}
