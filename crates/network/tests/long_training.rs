//! Tests with trainings of a thousand epochs. For any pictures, every number stays finite and errors do not grow.

use crate::common::plain::{self, Moments};
use crate::common::tiles::{picture, same_size};
use crate::draws::{doubles, singles};
use taceva_network::{
    ConvolutionForm, Labels, Network, Picture, Recipe, Samples, Schedule, Trainer,
};

const INPUT: Picture = picture(6, 5, 1);
const SAMPLES: usize = 16;
const EPOCHS: u64 = 1000;

/// Five sets of pictures with their names: random pictures, and four alterations of these.
fn pictures() -> [(&'static str, Vec<f32>); 5] {
    let usual = singles(21, SAMPLES * INPUT.len());
    let changed = |change: &dyn Fn(usize, f32) -> f32| {
        let pixels = usual.iter().enumerate();
        pixels
            .map(|(at, value)| change(at / INPUT.len(), *value))
            .collect()
    };
    let large = changed(&|_, value| value * 1e4);
    let small = changed(&|_, value| value * 1e-4);
    let constant = changed(&|sample, _| sample as f32 / 16.0);
    let saturated = changed(&|_, value| if value > 0.1 { 255.0 } else { 0.0 });
    [
        ("usual", usual),
        ("large", large),
        ("small", small),
        ("constant", constant),
        ("saturated", saturated),
    ]
}

/// Largest error of predictions, relative to the largest prediction.
fn error(network: &Network, form: ConvolutionForm, pictures: &[f32]) -> f64 {
    let tensors = plain::tensors(network);
    let architecture = network.architecture();
    let expected = plain::outputs(architecture, &tensors, pictures, Moments::Running);
    let mut found = vec![0.0; expected.len()];
    let mut predictor = network.predictor_in(form);
    predictor.predict(pictures, &mut found).expect("finite");
    let size = expected.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    let errors = found.iter().zip(&expected).map(|(f, e)| (f - e).abs());
    errors.fold(0.0, f64::max) / size
}

#[test]
fn a_thousand_epochs_of_usual_constant_saturated_large_and_small_pictures_stay_finite_and_exact() {
    let labels = doubles(22, SAMPLES * 2);
    let architecture = same_size(INPUT, [16, 32]);
    let recipe = Recipe {
        epochs: EPOCHS,
        batch: 8,
        rate: 1e-3,
        schedule: Schedule::Constant,
        ..Recipe::default()
    };
    for (what, pictures) in pictures() {
        let samples = Samples {
            pictures: &pictures,
            labels: Labels::Values(&labels),
        };
        for form in [ConvolutionForm::Direct, ConvolutionForm::Winograd] {
            let trainer = Trainer::new(&architecture, &recipe, samples, None);
            let mut trainer = trainer.expect("a training").in_form(form).expect("room");
            let (mut losses, mut errors) = (Vec::new(), Vec::new());
            // A weight or a loss that is not finite is an error.
            while let Some(step) = trainer.step().expect("finite") {
                let Some(epoch) = step.epoch else { continue };
                losses.push(epoch.training_loss);
                if [10, 100, 1000].contains(&losses.len()) {
                    let checkpoint = trainer.checkpoint().expect("at hand");
                    let tensors = checkpoint.tensors.into_iter().filter_map(|mut tensor| {
                        tensor.name = tensor.name.strip_prefix("now.")?.to_owned();
                        Some(tensor)
                    });
                    let network = Network::from_tensors(&architecture, tensors);
                    errors.push(error(&network.expect("its own"), form, &pictures));
                }
            }
            assert_eq!(losses.len() as u64, EPOCHS);
            let [first, last] = [losses[0], losses[losses.len() - 1]];
            assert!(last < first, "{what}, {form}: {first}, {last}");
            // Rounding errors of three layers stay equally small early and late.
            assert!(
                errors.iter().all(|error| *error < 2e-6),
                "{what}, {form}: {errors:?}"
            );
        }
    }
}
