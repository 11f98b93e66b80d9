//! Tests of trainings: the same bits in one run or in parts, and the best epoch at the end.

use crate::common::small::{PICTURE, architecture, recipe, sums, values};
use crate::draws::{doubles, singles};
use taceva_network::{
    Architecture, Augmentation, Checkpoint, Depth, Labels, Loss, NamedTensor, Network,
    NetworkError, Optimizer, Picture, Recipe, Samples, Schedule, Trained, Trainer,
};

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
    // A constant prediction of the mean has a loss of about a half, less the reduction by Huber's loss.
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
            let Checkpoint { summary, tensors } = trainer.checkpoint().expect("at hand");
            let text = serde_json::to_string(&summary).expect("text");
            let summary = serde_json::from_str(&text).expect("the same");
            let checkpoint = Checkpoint { summary, tensors };
            let resumed = Trainer::resume(
                checkpoint.clone(),
                values(&training),
                Some(values(&validation)),
            );
            let resumed = resumed.expect("its own checkpoint");
            assert_eq!(resumed.checkpoint().expect("at hand"), checkpoint);
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
    let network = crate::draws::filled(&Architecture::residual(Depth::Ten, picture, 2), 9);
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
    // Pictures are bright in the upper half or in the lower half, by class.
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
    // At such a high rate, the loss does not improve for long.
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
    let trained = trainer.finish().expect("at hand");
    let finite = |tensors: &[NamedTensor]| {
        tensors
            .iter()
            .flat_map(|tensor| &tensor.values)
            .all(|value| value.is_finite())
    };
    assert!(trained.state.best.is_none() || finite(&trained.network.tensors()));
}

#[test]
fn a_training_that_broke_keeps_its_best_and_breaks_again_wherever_it_is_gone_on_with() {
    let (training, validation) = (sums(1, 16), sums(2, 8));
    // Each step overshoots a hundredfold. The first epochs are finite; about the tenth is not.
    let recipe = Recipe {
        epochs: 50,
        rate: 10.0,
        schedule: Schedule::Constant,
        optimizer: Optimizer::Sgd {
            momentum: 0.9,
            weight_decay: 0.0,
        },
        loss: Loss::SquaredError,
        ..recipe()
    };
    let samples = || (values(&training), Some(values(&validation)));
    let (learnt, held) = samples();
    let trainer = Trainer::new(&architecture(), &recipe, learnt, held);
    let mut trainer = trainer.expect("a training");
    let error = loop {
        match trainer.step() {
            Ok(made) => assert!(made.is_some(), "such a rate breaks any training"),
            Err(error) => break error,
        }
    };
    assert_eq!(trainer.step().expect_err("broken"), error);
    assert!(trainer.state().best.is_some(), "{error}");
    let (learnt, held) = samples();
    let resumed = Trainer::resume(trainer.checkpoint().expect("at hand"), learnt, held);
    let mut resumed = resumed.expect("what is kept is finite");
    assert_eq!(resumed.step().expect_err("broken"), error);
    assert_same(
        &resumed.finish().expect("at hand"),
        &trainer.finish().expect("at hand"),
        "the best epoch",
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
