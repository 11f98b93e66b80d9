//! Tests that invalid trainings and architectures are rejected, with the name of the fault.

use crate::common::small::{PICTURE, architecture, recipe, sums, values};
use taceva_network::{
    Architecture, Augmentation, Body, Depth, Jitter, LabelScaling, Labels, Loss, NamedTensor,
    Network, Optimizer, Picture, Recipe, Samples, Schedule, Trainer,
};

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
        "7 training samples, fewer than a batch of 8"
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
        "training: 31 labels, expected 2 for each of 16 pictures"
    );
    let torn = (good.0[1..].to_vec(), good.1.clone());
    assert_eq!(
        refusal(&recipe(), values(&torn)),
        "1919 numbers, expected whole pictures of 12×10×1"
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
        "training sample 0: class 2, expected 0 to 1"
    );
    assert!(refusal(&recipe(), samples).starts_with("`loss`: a distance loss for classes"));
    assert!(refusal(&entropy, values(&good)).starts_with("`loss`: cross entropy for numbers"));
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
        "the tensor `fc.bias` of the architecture is missing"
    );
    assert_eq!(
        refused(|tensors| tensors[0].name = "fc.biass".into()),
        "the tensor `fc.bias` of the architecture is missing"
    );
    assert_eq!(
        refused(|tensors| tensors.push(NamedTensor {
            name: "conv9.weight".into(),
            ..tensors[0].clone()
        })),
        "unexpected tensor `conv9.weight`: the architecture has no such tensor"
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
    let checkpoint = trainer.checkpoint().expect("at hand");
    let error =
        Trainer::resume(checkpoint.clone(), values(&other), None).expect_err("other samples");
    assert_eq!(
        error.to_string(),
        "the checkpoint belongs to another training run: 16 samples, expected 24"
    );
    let mut torn = checkpoint.clone();
    torn.tensors
        .retain(|tensor| tensor.name != "moment.0.features.0.1.bias");
    let error = Trainer::resume(torn, values(&training), None).expect_err("a tensor is missing");
    assert_eq!(
        error.to_string(),
        "the checkpoint belongs to another training run: `moment.0.features.0.1.bias` is missing or does not have 16 numbers"
    );
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
        .contains("expected sizes and outputs above 0")
    );
    let huge = Picture {
        height: 1 << 20,
        width: 1 << 20,
        channels: 3,
    };
    assert!(
        refused(Architecture::residual(Depth::Ten, huge, 1))
            .contains("within the network: expected at most")
    );
}
