//! Tests of the convolution algorithms (forms). Predictions do not depend on other pictures of the batch, all forms agree, and a resumed
//! training in any form ends with the same bits.

use crate::common::plain::{self, Moments};
use crate::common::tiles::{self, picture};
use crate::draws::{doubles, filled, singles};
use taceva_network::{
    Architecture, Checkpoint, ConvolutionForm, Depth, Labels, Loss, NetworkError, Optimizer,
    Picture, Recipe, Samples, Schedule, Trainer,
};

const FORMS: [ConvolutionForm; 3] = ConvolutionForm::ALL;

/// Three convolutions of 3 × 3 that keep the size of pictures.
fn same_size(input: Picture) -> Architecture {
    tiles::same_size(input, [16, 48, 16])
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn all_forms_predict_alike_and_none_depends_on_the_pictures_beside() {
    let input = picture(40, 33, 3);
    let network = filled(&Architecture::residual(Depth::Ten, input, 2), 9);
    let pictures = singles(3, 35 * input.len());
    let found = FORMS.map(|form| {
        let mut predictor = network.predictor_in(form);
        assert_eq!(predictor.form(), form);
        let mut all = vec![0.0; 70];
        predictor.predict(&pictures, &mut all).expect("finite");
        let each = pictures.chunks_exact(input.len());
        for (picture, expected) in each.zip(all.chunks_exact(2)).step_by(9) {
            let mut alone = [0.0; 2];
            predictor.predict(picture, &mut alone).expect("finite");
            assert_eq!(bits(&alone), bits(expected), "{form}");
        }
        all
    });
    let largest = found[0].iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    for other in &found[1..] {
        for (direct, other) in found[0].iter().zip(other) {
            assert!((direct - other).abs() < 1e-5 * largest);
        }
    }
    let [direct, mixed, winograd] = found.each_ref().map(|found| bits(found));
    assert!(direct != mixed && mixed != winograd && direct != winograd);
    let mut usual = vec![0.0; 70];
    let mut predictor = network.predictor();
    assert_eq!(predictor.form(), ConvolutionForm::Winograd);
    predictor.predict(&pictures, &mut usual).expect("finite");
    assert_eq!(bits(&usual), winograd);
}

#[test]
fn fewer_pictures_than_threads_are_divided_among_these_and_keep_their_bits() {
    // One channel and three, odd sizes, and one picture whose last maps are 1 × 1.
    let inputs = [picture(61, 45, 1), picture(39, 70, 3), picture(20, 20, 1)];
    for (input, form) in inputs.into_iter().flat_map(|i| FORMS.map(|form| (i, form))) {
        let network = filled(&Architecture::residual(Depth::Ten, input, 2), 9);
        let pictures = singles(3, 2 * input.len());
        let of = |count: usize| {
            let mut predictor = network.predictor_in(form);
            let mut found = vec![0.0; 2 * count];
            let pictures = &pictures[..count * input.len()];
            // Two calls, because the first one allocates buffers.
            for _ in 0..2 {
                predictor.predict(pictures, &mut found).expect("finite");
            }
            bits(&found)
        };
        let on = |threads: usize, count: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.expect("threads").install(|| of(count))
        };
        for count in [0, 1, 2] {
            let alone = on(1, count);
            for threads in [2, 3, 8] {
                let what = format!("{count} of {input} in {form} on {threads} threads");
                assert_eq!(on(threads, count), alone, "{what}");
            }
            assert_eq!(of(count), alone, "{count} of {input} outside any pool");
        }
    }
}

#[test]
fn a_network_without_such_convolutions_has_the_same_bits_in_every_form() {
    let input = picture(24, 20, 1);
    let network = filled(&Architecture::five_layers(input, 3), 9);
    let pictures = singles(3, 5 * input.len());
    let [direct, mixed, winograd] = FORMS.map(|form| {
        let mut found = [0.0; 15];
        let mut predictor = network.predictor_in(form);
        predictor.predict(&pictures, &mut found).expect("finite");
        bits(&found)
    });
    assert_eq!(direct, winograd);
    assert_eq!(direct, mixed);
}

#[test]
fn maps_of_every_size_from_1_to_9_are_predicted_in_every_form_from_a_batch_of_one() {
    for (height, width) in (1..=9)
        .map(|side| (side, 10 - side))
        .chain((1..=9).map(|s| (s, s)))
    {
        let input = picture(height, width, 1);
        let architecture = same_size(input);
        let network = filled(&architecture, 5);
        let pictures = singles(7, input.len());
        let tensors = plain::tensors(&network);
        let expected = plain::outputs(&architecture, &tensors, &pictures, Moments::Running);
        let size = expected.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        for form in FORMS {
            let mut found = [0.0; 2];
            let mut predictor = network.predictor_in(form);
            predictor.predict(&pictures, &mut found).expect("finite");
            for (found, expected) in found.iter().zip(&expected) {
                let error = (found - expected).abs() / size;
                assert!(error < 1e-5, "{form} {input}: {found}, expected {expected}");
            }
        }
    }
}

/// Sixteen pictures of 7 × 6, and labels.
fn learnt() -> (Vec<f32>, Vec<f64>) {
    (singles(11, 16 * picture(7, 6, 1).len()), doubles(12, 32))
}

fn samples((pictures, labels): &(Vec<f32>, Vec<f64>)) -> Samples<'_> {
    Samples {
        pictures,
        labels: Labels::Values(labels),
    }
}

fn recipe() -> Recipe {
    Recipe {
        epochs: 3,
        batch: 8,
        ..Recipe::default()
    }
}

fn weights(checkpoint: &Checkpoint) -> Vec<u32> {
    let tensors = checkpoint.tensors.iter();
    tensors
        .flat_map(|tensor| tensor.values.iter().map(|value| value.to_bits()))
        .collect()
}

#[test]
fn a_training_gone_on_with_after_any_step_keeps_its_form_and_ends_with_the_same_bits() {
    let learnt = learnt();
    let architecture = same_size(picture(7, 6, 1));
    let ends = FORMS.map(|form| {
        let begin = || {
            let trainer = Trainer::new(&architecture, &recipe(), samples(&learnt), None);
            trainer.expect("a training").in_form(form).expect("room")
        };
        let whole = begin().run().expect("finite");
        for stop in 0..6 {
            let mut trainer = begin();
            for _ in 0..stop {
                trainer.step().expect("finite");
            }
            let checkpoint = trainer.checkpoint().expect("at hand");
            assert_eq!(checkpoint.summary.convolutions, form);
            let resumed = Trainer::resume(checkpoint, samples(&learnt), None);
            let mut resumed = resumed.expect("its own checkpoint");
            while trainer.step().expect("finite").is_some() {
                resumed.step().expect("finite");
            }
            let [found, expected] = [&resumed, &trainer].map(|t| t.checkpoint().expect("at hand"));
            assert!(weights(&found) == weights(&expected), "{form} after {stop}");
            let resumed = resumed.finish().expect("at hand");
            assert_eq!(resumed.network.tensors(), whole.network.tensors());
        }
        whole.network.tensors()
    });
    assert_ne!(ends[0], ends[1], "forms round differently");
}

#[test]
fn a_summary_that_names_no_form_of_convolution_is_refused() {
    let learnt = learnt();
    let architecture = same_size(picture(7, 6, 1));
    let trainer = Trainer::new(&architecture, &recipe(), samples(&learnt), None);
    let checkpoint = trainer.expect("a training").checkpoint().expect("at hand");
    let mut summary = serde_json::to_value(&checkpoint.summary).expect("text");
    let fields = summary.as_object_mut().expect("a summary");
    assert!(fields.remove("convolutions").is_some());
    let read = serde_json::from_value(summary);
    let read = read.map(|summary| Checkpoint {
        summary,
        ..checkpoint
    });
    let error = read.expect_err("no form").to_string();
    assert!(error.contains("convolutions"), "{error}");
}

#[test]
fn maps_of_1_by_1_train_to_the_same_bits_in_both_forms() {
    let input = picture(1, 1, 1);
    let learnt = (singles(11, 16), doubles(12, 32));
    let architecture = same_size(input);
    let ends = FORMS.map(|form| {
        let trainer = Trainer::new(&architecture, &recipe(), samples(&learnt), None);
        let trainer = trainer.expect("a training").in_form(form).expect("room");
        trainer.run().expect("finite").network.tensors()
    });
    assert_eq!(ends[0], ends[1]);
}

#[test]
fn weights_that_stop_being_finite_end_a_training_of_tiles_by_its_step() {
    let learnt = learnt();
    let recipe = Recipe {
        epochs: 50,
        batch: 8,
        rate: 1e30,
        schedule: Schedule::Constant,
        optimizer: Optimizer::Sgd {
            momentum: 0.9,
            weight_decay: 0.0,
        },
        loss: Loss::SquaredError,
        ..Recipe::default()
    };
    let architecture = same_size(picture(7, 6, 1));
    let trainer = Trainer::new(&architecture, &recipe, samples(&learnt), None);
    let mut trainer = trainer.expect("a training");
    let error = loop {
        match trainer.step() {
            Ok(made) => assert!(made.is_some(), "such a rate breaks any training"),
            Err(error) => break error,
        }
    };
    let made = trainer.state().step;
    assert!(
        matches!(
            error,
            NetworkError::LossNotFinite { step } | NetworkError::WeightNotFinite { step }
                if step == made
        ),
        "{error} after {made} steps"
    );
}
