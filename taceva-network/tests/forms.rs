//! The two forms of convolutions: each predicts as it does whatever stands beside, both alike, and training in one of them keeps what a
//! training promises.

mod common;
#[path = "common/plain.rs"]
mod plain;

use common::{doubles, filled, singles};
use plain::Moments;
use taceva_network::{
    Architecture, Body, Checkpoint, ConvolutionForm, Depth, Labels, Loss, NetworkError, Optimizer,
    Picture, PlainLayer, Pooling, Recipe, Samples, Schedule, Trainer,
};

const FORMS: [ConvolutionForm; 2] = [ConvolutionForm::Direct, ConvolutionForm::Winograd];

const fn picture(height: usize, width: usize, channels: usize) -> Picture {
    Picture {
        height,
        width,
        channels,
    }
}

/// Three convolutions of 3 × 3 that keep the size of pictures.
fn same_size(input: Picture) -> Architecture {
    let layer = |channels| PlainLayer {
        channels,
        kernel: 3,
        stride: 1,
    };
    Architecture {
        input,
        body: Body::Plain {
            layers: vec![layer(16), layer(48), layer(16)],
            pooling: Pooling::Average,
        },
        outputs: 2,
    }
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn both_forms_predict_alike_and_neither_depends_on_the_pictures_beside() {
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
    for (direct, winograd) in found[0].iter().zip(&found[1]) {
        assert!((direct - winograd).abs() < 1e-5 * largest);
    }
    assert_ne!(bits(&found[0]), bits(&found[1]));
    let mut usual = vec![0.0; 70];
    let mut predictor = network.predictor();
    assert_eq!(predictor.form(), ConvolutionForm::Winograd);
    predictor.predict(&pictures, &mut usual).expect("finite");
    assert_eq!(bits(&usual), bits(&found[1]));
}

#[test]
fn a_network_without_such_convolutions_has_the_same_bits_in_both_forms() {
    let input = picture(24, 20, 1);
    let network = filled(&Architecture::five_layers(input, 3), 9);
    let pictures = singles(3, 5 * input.len());
    let [direct, winograd] = FORMS.map(|form| {
        let mut found = [0.0; 15];
        let mut predictor = network.predictor_in(form);
        predictor.predict(&pictures, &mut found).expect("finite");
        bits(&found)
    });
    assert_eq!(direct, winograd);
}

#[test]
fn maps_of_every_size_up_to_two_tiles_and_a_pixel_are_predicted_from_one_picture() {
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

#[test]
fn a_training_of_tiles_gone_on_with_after_any_step_ends_with_the_same_bits() {
    let learnt = learnt();
    let recipe = Recipe {
        epochs: 3,
        batch: 8,
        ..Recipe::default()
    };
    let architecture = same_size(picture(7, 6, 1));
    let begin = || Trainer::new(&architecture, &recipe, samples(&learnt), None);
    let whole = begin().expect("a training").run().expect("finite");
    let bits = |checkpoint: &Checkpoint| -> Vec<u32> {
        let tensors = checkpoint.tensors.iter();
        tensors
            .flat_map(|tensor| tensor.values.iter().map(|value| value.to_bits()))
            .collect()
    };
    for stop in 0..6 {
        let mut trainer = begin().expect("a training");
        for _ in 0..stop {
            trainer.step().expect("finite");
        }
        let checkpoint = trainer.checkpoint().expect("at hand");
        assert_eq!(checkpoint.summary.convolutions, ConvolutionForm::Winograd);
        let resumed = Trainer::resume(checkpoint, samples(&learnt), None);
        let mut resumed = resumed.expect("its own checkpoint");
        while trainer.step().expect("finite").is_some() {
            resumed.step().expect("finite");
        }
        let [found, expected] = [&resumed, &trainer].map(|t| t.checkpoint().expect("at hand"));
        assert!(bits(&found) == bits(&expected), "after {stop}");
        let resumed = resumed.finish().expect("at hand");
        assert_eq!(resumed.network.tensors(), whole.network.tensors());
    }
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
