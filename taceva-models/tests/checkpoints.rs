//! Guarantees of checkpoints.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

use taceva_core::{
    Channel, Channels, ErrorKind, FeatureShape, Features, ModelError, Progress, SilentProgress,
    Targets, TrainingSet,
};
use taceva_models::{CheckpointError, Checkpoints, Foreign, ModelFit, ModelSettings, find};

const SHAPE: FeatureShape = FeatureShape {
    height: 12,
    width: 12,
    depth: 1,
};

/// Pictures of noise. The label of a picture is its mean.
struct Recording {
    features: Features,
    channels: Channels,
    labels: Vec<f64>,
}

/// The numbers are from a linear congruential generator (Knuth's MMIX constants).
fn recording(samples: usize, seed: u64) -> Recording {
    let mut state = seed;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        f32::from(state.to_be_bytes()[0]) / 255.0
    };
    let values: Vec<f32> = (0..samples * SHAPE.len()).map(|_| next()).collect();
    let mean = |picture: &[f32]| picture.iter().copied().map(f64::from).sum::<f64>();
    Recording {
        labels: values.chunks_exact(SHAPE.len()).map(mean).collect(),
        features: Features::new(SHAPE, values).expect("whole samples"),
        channels: Channels::new([Channel::FZ]).expect("one"),
    }
}

impl Recording {
    fn set(&self) -> TrainingSet<'_> {
        TrainingSet::new(&self.features, Targets::new(&self.channels, &self.labels))
    }
}

/// Progress receiver that cancels the work after a number of steps.
struct Patience {
    left: AtomicUsize,
    /// True for a stage that began but has not advanced. Its first advance includes the steps made before.
    is_new: AtomicBool,
}

impl Patience {
    fn of(steps: usize) -> Patience {
        Patience {
            left: AtomicUsize::new(steps),
            is_new: AtomicBool::new(false),
        }
    }
}

impl Progress for Patience {
    fn begin(&self, _: &str, _: Option<u64>) {
        self.is_new.store(true, Ordering::Relaxed);
    }

    fn advance(&self, _: u64) {
        if !self.is_new.swap(false, Ordering::Relaxed) {
            self.left.fetch_sub(1, Ordering::Relaxed);
        }
    }

    fn is_cancelled(&self) -> bool {
        self.left.load(Ordering::Relaxed) == 0
    }
}

const WORDS: [&str; 4] = ["epochs=6", "batch=8", "jitter=1", "contrast=false"];

/// Fits with six epochs of three steps, with optional checkpoints.
fn fit(
    model: &str,
    words: &[&str],
    checkpoints: Option<Checkpoints>,
    progress: &dyn Progress,
) -> Result<ModelFit, ModelError> {
    let (training, validation) = (recording(24, 1), recording(8, 2));
    fit_on(
        model,
        words,
        (&training, &validation),
        (checkpoints, progress),
    )
}

fn fit_on(
    model: &str,
    words: &[&str],
    (training, validation): (&Recording, &Recording),
    (checkpoints, progress): (Option<Checkpoints>, &dyn Progress),
) -> Result<ModelFit, ModelError> {
    let settings = ModelSettings::parse(words.iter().copied()).expect("well formed");
    let info = find(model).expect("registered");
    let mut estimator = info.estimator(&settings).expect("valid");
    if let Some(checkpoints) = checkpoints {
        estimator.keep_checkpoints(checkpoints);
    }
    estimator.fit_model(&training.set(), Some(&validation.set()), progress)
}

fn after_each_step(path: &Path) -> Checkpoints {
    Checkpoints {
        every: Duration::ZERO,
        ..Checkpoints::at(path.to_owned())
    }
}

/// Writes the checkpoint of a `cnn` training that is stopped after `steps` steps.
fn leave(path: &Path, steps: usize) {
    let patience = Patience::of(steps);
    let stopped = fit(
        "cnn",
        &WORDS,
        Some(Checkpoints::at(path.to_owned())),
        &patience,
    );
    assert_eq!(stopped.expect_err("stopped").kind(), ErrorKind::Interrupted);
}

fn cause(error: &ModelError) -> &CheckpointError {
    let source = error.source().expect("a cause");
    source.downcast_ref().expect("one of a checkpoint")
}

#[test]
fn a_training_stopped_after_any_steps_ends_as_one_that_was_not() {
    let folder = tempfile::tempdir().expect("a folder");
    for (model, steps) in [("cnn", 1), ("cnn", 5), ("resnet10", 4)] {
        let expected = fit(model, &WORDS, None, &SilentProgress).expect("fits");
        let path = folder.path().join(format!("{model}.{steps}"));
        let mut stops = 0;
        let found = loop {
            let patience = Patience::of(steps);
            let checkpoints = match (model, stops % 2) {
                // A large network writes a checkpoint only when it is stopped, because each write takes long.
                ("cnn", 0) => after_each_step(&path),
                _ => Checkpoints::at(path.clone()),
            };
            match fit(model, &WORDS, Some(checkpoints), &patience) {
                Ok(found) => break found,
                Err(error) => assert_eq!(error.kind(), ErrorKind::Interrupted, "{error}"),
            }
            stops += 1;
        };
        // A training also stops if it is cancelled after its last step.
        assert_eq!(stops, 18 / steps, "{model} makes 18 steps");
        assert!(found.regressor == expected.regressor, "{model}, {steps}");
        assert_eq!(found.choice, expected.choice);
        Checkpoints::at(path.clone()).remove().expect("there");
        assert!(!path.exists());
    }
    assert_eq!(fs::read_dir(folder.path()).expect("there").count(), 0);
}

#[test]
fn a_checkpoint_of_other_samples_or_settings_is_refused_and_replaced_where_that_is_wanted() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("checkpoint");
    leave(&path, 4);
    let left = fs::read(&path).expect("a checkpoint");
    let (training, validation) = (recording(24, 1), recording(8, 2));
    let mut altered = recording(24, 1);
    altered.labels[23] += 1e-12;
    let seen = recording(8, 3);
    for (model, words, sets, what) in [
        (
            "cnn",
            WORDS,
            (&altered, &validation),
            "samples or preprocessing",
        ),
        ("cnn", WORDS, (&training, &seen), "samples or preprocessing"),
        (
            "cnn",
            ["epochs=6", "batch=8", "jitter=2", "contrast=false"],
            (&training, &validation),
            "settings",
        ),
        (
            "cnn",
            ["epochs=6", "batch=8", "jitter=1", "contrast=true"],
            (&training, &validation),
            "samples or preprocessing",
        ),
        (
            "resnet10",
            WORDS,
            (&training, &validation),
            "layers, channels or sizes of pictures",
        ),
    ] {
        let work = (
            Some(after_each_step(&path)),
            &SilentProgress as &dyn Progress,
        );
        let error = fit_on(model, &words, sets, work).expect_err("of another training");
        assert!(
            matches!(cause(&error), CheckpointError::Foreign { what: found, .. } if *found == what),
            "{error}"
        );
        assert_eq!(fs::read(&path).expect("there"), left);
    }
    let replaced = Checkpoints {
        foreign: Foreign::Replace,
        ..after_each_step(&path)
    };
    let work = (Some(replaced), &SilentProgress as &dyn Progress);
    fit_on("cnn", &WORDS, (&altered, &validation), work).expect("begins anew");
    assert_ne!(fs::read(&path).expect("there"), left);
}

#[test]
fn a_damaged_checkpoint_is_refused_whichever_byte_it_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("checkpoint");
    leave(&path, 4);
    let whole = fs::read(&path).expect("a checkpoint");
    let header = usize::from(u16::from_le_bytes([whole[0], whole[1]])) + 8;
    let places = (0..header)
        .step_by(header / 40)
        .chain((header..whole.len()).step_by(whole.len() / 20));
    for place in places {
        let mut damaged = whole.clone();
        damaged[place] ^= 1;
        fs::write(&path, damaged).expect("written");
        let refused = fit("cnn", &WORDS, Some(after_each_step(&path)), &SilentProgress);
        let error = refused.map(|_| ()).expect_err("damaged");
        assert!(
            matches!(
                cause(&error),
                CheckpointError::Damaged { .. } | CheckpointError::Foreign { .. }
            ),
            "byte {place}: {error}"
        );
    }
    for length in [0, 7, 8, header, whole.len() - 1] {
        fs::write(&path, &whole[..length]).expect("written");
        let refused = fit("cnn", &WORDS, Some(after_each_step(&path)), &SilentProgress);
        let error = refused.map(|_| ()).expect_err("cut off");
        assert!(
            matches!(cause(&error), CheckpointError::Damaged { .. }),
            "{length}: {error}"
        );
    }
}

#[test]
fn a_checkpoint_of_before_convolutions_had_forms_is_refused_by_its_format() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("checkpoint");
    leave(&path, 4);
    let bytes = fs::read(&path).expect("a checkpoint");
    let length = u64::from_le_bytes(*bytes.first_chunk().expect("a header"));
    let end = 8 + usize::try_from(length).expect("small");
    let mut header: serde_json::Value = serde_json::from_slice(&bytes[8..end]).expect("a header");
    let text = &mut header["__metadata__"]["taceva.checkpoint"];
    let mut card: serde_json::Value =
        serde_json::from_str(text.as_str().expect("a card")).expect("a card");
    card["format"] = "2".into();
    let summary = card["summary"].as_object_mut().expect("a summary");
    assert!(summary.remove("convolutions").is_some());
    *text = card.to_string().into();
    let mut header = header.to_string().into_bytes();
    header.resize(header.len().next_multiple_of(8), b' ');
    let mut older = (header.len() as u64).to_le_bytes().to_vec();
    older.extend(header);
    older.extend(&bytes[end..]);
    fs::write(&path, &older).expect("written");

    let fit_with = |foreign| {
        let checkpoints = Checkpoints {
            foreign,
            ..after_each_step(&path)
        };
        fit("cnn", &WORDS, Some(checkpoints), &SilentProgress)
    };
    let error = fit_with(Foreign::Refuse)
        .map(|_| ())
        .expect_err("another form");
    let said = error.to_string();
    assert!(
        said.contains("format 2, expected 3") && said.contains("remove it to start again"),
        "{said}"
    );
    assert!(fs::read(&path).expect("there") == older);
    fit_with(Foreign::Replace).expect("begins anew");
}

#[test]
fn a_place_that_cannot_be_written_or_read_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let absent = folder.path().join("absent/checkpoint");
    let error = fit(
        "cnn",
        &WORDS,
        Some(after_each_step(&absent)),
        &SilentProgress,
    )
    .expect_err("no folder");
    assert_eq!(error.kind(), ErrorKind::NotFound);
    assert!(
        matches!(cause(&error), CheckpointError::Write { path, .. } if *path == absent),
        "{error}"
    );
    let error = fit(
        "cnn",
        &WORDS,
        Some(after_each_step(folder.path())),
        &SilentProgress,
    );
    let error = error.expect_err("a folder is not a file");
    assert!(
        matches!(cause(&error), CheckpointError::Read { .. }),
        "{error}"
    );
}
