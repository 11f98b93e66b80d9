//! Guarantees of networks beyond those of all models.

use taceva_core::{ErrorKind, Frame, SilentProgress};
use taceva_models::{Model, ModelEstimator, ModelSettings, NetworkRegressor, find};
use taceva_needs::{Need, skip};

use super::case::{case_of, predict, rms};
use crate::blobs::{FRAME, numbers, recording};

const NETWORKS: [&str; 5] = ["cnn", "resnet10", "resnet18", "resnet34", "cnn-ensemble"];

fn estimator(name: &str, words: &[&str]) -> Box<dyn ModelEstimator> {
    let settings = ModelSettings::parse(words.iter().copied()).expect("well formed");
    find(name)
        .expect("registered")
        .estimator(&settings)
        .expect("valid")
}

#[test]
fn a_network_finds_a_blob_and_keeps_its_best_epoch() {
    let (training, validation, test) = (recording(200, 1), recording(40, 2), recording(60, 3));
    let words = ["epochs=30", "batch=20", "jitter=0", "local_mean=0"];
    let fit = estimator("cnn", &words)
        .fit_model(&training.set(), Some(&validation.set()), &SilentProgress)
        .expect("fits");
    let found = predict(&fit.regressor, &test.features);
    let rms = rms(&found, &test.labels);
    // The labels spread by about four pixels.
    assert!(rms < 1.0, "{rms}");
    let kept = fit.choice.channels[0].rmse.expect("measured");
    assert!(kept < 1.0 && fit.choice.setting.as_deref() == Some("epoch"));
}

#[test]
fn a_constant_label_is_predicted_exactly_by_the_deepest() {
    let mut training = recording(16, 1);
    training
        .labels
        .iter_mut()
        .skip(1)
        .step_by(2)
        .for_each(|label| *label = 0.1);
    for name in NETWORKS {
        let fit = estimator(name, &["epochs=1", "batch=8"])
            .fit_model(&training.set(), None, &SilentProgress)
            .expect("fits");
        let found = predict(&fit.regressor, &training.features);
        assert!(
            found
                .iter()
                .skip(1)
                .step_by(2)
                .all(|value| value.to_bits() == 0.1_f64.to_bits()),
            "{name}"
        );
        assert!(found[0].to_bits() != found[2].to_bits(), "{name}");
    }
    training.labels.iter_mut().for_each(|label| *label = -2.5);
    let fit = estimator("cnn", &["epochs=1", "batch=8"])
        .fit_model(&training.set(), None, &SilentProgress)
        .expect("fits");
    let found = predict(&fit.regressor, &training.features);
    assert!(
        found
            .iter()
            .all(|value| value.to_bits() == (-2.5_f64).to_bits())
    );
}

#[test]
fn fewer_samples_than_a_batch_are_refused() {
    let training = recording(16, 1);
    for name in NETWORKS {
        let few = estimator(name, &["batch=17"]).fit_model(&training.set(), None, &SilentProgress);
        let said = few.expect_err("too few").to_string();
        assert_eq!(said, "16 training samples, fewer than a batch of 17");
    }
}

#[test]
fn a_setting_that_no_network_has_is_refused_with_the_nearest() {
    let settings = ModelSettings::parse(["epoch=3"]).expect("well formed");
    let error = find("cnn").expect("registered").estimator(&settings).err();
    assert_eq!(
        error.expect("refused").to_string(),
        "`epoch`: unknown key, did you mean `epochs`?"
    );
}

#[test]
fn a_device_that_this_program_cannot_reach_is_refused_by_the_feature_it_needs() {
    let refused = |word: &str| {
        let settings = ModelSettings::parse([word]).expect("well formed");
        let made = find("cnn").expect("registered").estimator(&settings);
        made.err().map(|error| error.to_string())
    };
    assert_eq!(refused("device=cpu"), None);
    assert_eq!(
        refused("device=gpu").as_deref(),
        Some("`device=gpu`: expected cpu, cuda or wgpu")
    );
    for (device, is_built) in [
        ("cuda", cfg!(feature = "cuda")),
        ("wgpu", cfg!(feature = "wgpu")),
    ] {
        let said = refused(&format!("device={device}"));
        assert_eq!(said.is_none(), is_built, "{said:?}");
        let expected = format!(
            "`device={device}`: this program was built without the feature `{device}`: build it with `--features {device}`, or train with `device=cpu`"
        );
        assert!(said.is_none_or(|said| said == expected));
    }
}

#[test]
fn a_network_of_a_gpu_says_which_and_finds_the_blob_here() {
    for device in ["cuda", "wgpu"] {
        let words = ["epochs=30", "batch=20", "jitter=0", "local_mean=0"];
        let device_word = format!("device={device}");
        let settings = ModelSettings::parse(words.into_iter().chain([&*device_word]));
        let made = find("cnn")
            .expect("registered")
            .estimator(&settings.expect("well formed"));
        let (training, validation, test) = (recording(200, 1), recording(40, 2), recording(60, 3));
        let fit = match made {
            Ok(estimator) => {
                estimator.fit_model(&training.set(), Some(&validation.set()), &SilentProgress)
            }
            Err(reason) => {
                skip(Need::Gpu, reason);
                continue;
            }
        };
        let fit = match fit {
            Err(reason) if reason.kind() == ErrorKind::NotFound => {
                skip(Need::Gpu, reason);
                continue;
            }
            fit => fit.expect("fits"),
        };
        let rms = rms(&predict(&fit.regressor, &test.features), &test.labels);
        assert!(rms < 1.0, "{device}: {rms}");
        let network = fit.regressor.get::<NetworkRegressor>().expect("a network");
        let gpu = network.card().gpu.as_deref();
        assert!(gpu.is_some_and(|gpu| gpu.ends_with(&format!("({device})"))));
    }
}

#[test]
fn weights_have_the_names_of_torchvision() {
    let resnet = case_of("resnet10").model(&recording(24, 1), None);
    let network = resnet
        .regressor()
        .get::<NetworkRegressor>()
        .expect("a network");
    let tensors = network.tensors();
    let running = "layer2.0.downsample.1.running_var";
    assert!(tensors.iter().any(|tensor| tensor.name == running));
}

#[test]
fn components_are_no_picture() {
    let error = case_of("cnn")
        .try_model(&recording(24, 1), Some(4))
        .expect_err("refused");
    assert_eq!(
        error.to_string(),
        "a network reads pictures, not principal components: remove `pca`"
    );
}

#[test]
fn no_damaged_network_panics_or_opens_as_something_else() {
    let model = case_of("cnn").model(&recording(24, 1), None);
    let bytes = model.to_bytes().expect("small");
    let header = usize::from(u16::from_le_bytes([bytes[0], bytes[1]])) + 8;
    let mut next = numbers(11);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place below the bound"
    )]
    let mut below = |bound: usize| (next() * bound as f64) as usize;
    for _ in 0..3_000 {
        let mut damaged = bytes.clone();
        // Most damage is in the metadata.
        for _ in 0..=below(3) {
            let within = if below(4) > 0 { header } else { bytes.len() };
            damaged[below(within)] = u8::try_from(below(256)).expect("a byte");
        }
        if let Ok(opened) = Model::from_bytes(&damaged) {
            let network = opened
                .regressor()
                .get::<NetworkRegressor>()
                .expect("a network");
            assert!(
                network
                    .tensors()
                    .iter()
                    .flat_map(|tensor| &tensor.values)
                    .all(|value| value.is_finite())
            );
        }
    }
    let frames = [Frame::new(FRAME, vec![7; 48 * 40]).expect("whole")];
    let extractor = model.extractor(FRAME, None).expect("its own frames");
    assert!(
        model
            .predict(&extractor.extract_all(&frames).expect("one kind"))
            .is_ok()
    );
}

#[test]
fn an_ensemble_predicts_the_mean_of_networks_of_seeds_that_follow_each_other() {
    let (training, test) = (recording(24, 1), recording(6, 2));
    let found = |name: &str, word: &str| {
        let fit = estimator(name, &["epochs=2", "batch=8", word])
            .fit_model(&training.set(), None, &SilentProgress)
            .expect("fits");
        predict(&fit.regressor, &test.features)
    };
    let members = ["seed=4", "seed=5", "seed=6"].map(|word| found("cnn", word));
    let settings = ["epochs=2", "batch=8", "seed=4", "members=3"];
    let fit = estimator("cnn-ensemble", &settings)
        .fit_model(&training.set(), None, &SilentProgress)
        .expect("fits");
    let mean = predict(&fit.regressor, &test.features);
    for (at, mean) in mean.iter().enumerate() {
        let sum: f64 = members.iter().map(|member| member[at]).sum();
        assert!((mean - sum / 3.0).abs() < 1e-12, "{mean} of {sum}");
    }
    let settings = ModelSettings::parse(["members=1"]).expect("a pair");
    let refused = find("cnn-ensemble").expect("registered");
    let refused = refused.estimator(&settings).map(drop).expect_err("one");
    assert_eq!(
        refused.to_string(),
        "`members=1`: expected a whole number from 2 to 16"
    );
}
