//! Estimators called through their table: fit, save, load and predict.

#![expect(unsafe_code, reason = "the tables of a plugin are called")]

use std::ffi::c_void;
use std::ptr::{null, null_mut};

use taceva_plugin::abi::{Progress, Regressor, RegressorCalls, Status, Text, TrainingSet};

use crate::fake_host::{Ended, ended, estimators, taken, with_args};

/// A fitted model that is closed on drop.
struct Fitted(Regressor);

impl Fitted {
    fn calls(&self) -> &'static RegressorCalls {
        // SAFETY: a table lives as long as the library.
        unsafe { &*self.0.calls }
    }

    fn predict(&self, features: &[f32], samples: u64, into: &mut [f64]) -> Ended {
        let predict = self.calls().predict.expect("a function");
        // SAFETY: both arrays have two numbers per sample.
        ended(|error| unsafe {
            predict(
                self.0.handle,
                features.as_ptr(),
                features.len() as u64,
                samples,
                into.as_mut_ptr(),
                into.len() as u64,
                error,
            )
        })
    }

    fn save(&self) -> Vec<u8> {
        let save = self.calls().save.expect("a function");
        let mut length = 0;
        // SAFETY: NULL requests only the length.
        let asked =
            ended(|error| unsafe { save(self.0.handle, null_mut(), &raw mut length, error) });
        assert_eq!(asked.0, Status::OUT_OF_RANGE);
        let mut bytes = vec![0; usize::try_from(length).expect("small")];
        // SAFETY: the buffer has the requested length.
        let saved = ended(|error| unsafe {
            save(self.0.handle, bytes.as_mut_ptr(), &raw mut length, error)
        });
        assert_eq!(saved.0, Status::OK);
        bytes
    }
}

impl Drop for Fitted {
    fn drop(&mut self) {
        let close = self.calls().close.expect("a function");
        // SAFETY: this is the last call on the model.
        unsafe { close(self.0.handle) };
    }
}

fn unfilled() -> Regressor {
    Regressor {
        handle: null_mut(),
        calls: null(),
    }
}

/// Fits three samples with two features and two channels.
fn fit(names: [&str; 2], targets: [f64; 6], progress: Progress) -> Result<Fitted, Ended> {
    let features = [0.0_f32; 6];
    let names = names.map(Text::from);
    let training = TrainingSet {
        size: u32::try_from(size_of::<TrainingSet>()).expect("small"),
        channels: 2,
        samples: 3,
        height: 1,
        width: 2,
        depth: 1,
        reserved: 0,
        features: features.as_ptr(),
        targets: targets.as_ptr(),
        groups: null(),
        channel_names: names.as_ptr(),
    };
    let fit = estimators().fit.expect("a function");
    let mut regressor = unfilled();
    let mut calls = 0_u32;
    let context = (&raw mut calls).cast();
    let ended = with_args(&[("shift", "0.5")], |settings| {
        // SAFETY: all arguments live for the call.
        ended(|error| unsafe {
            fit(
                0,
                settings,
                &raw const training,
                null(),
                progress,
                context,
                &raw mut regressor,
                error,
            )
        })
    });
    match ended.0 {
        Status::OK => Ok(Fitted(regressor)),
        _ => Err(ended),
    }
}

fn load(bytes: &[u8]) -> Result<Fitted, Ended> {
    let load = estimators().load.expect("a function");
    let mut regressor = unfilled();
    // SAFETY: all arguments live for the call.
    let ended = ended(|error| unsafe {
        load(
            0,
            bytes.as_ptr(),
            bytes.len() as u64,
            &raw mut regressor,
            error,
        )
    });
    match ended.0 {
        Status::OK => Ok(Fitted(regressor)),
        _ => Err(ended),
    }
}

const TARGETS: [f64; 6] = [1.0, 10.0, 2.0, 20.0, 3.0, 30.0];

unsafe extern "C" fn count(context: *mut c_void, done: f64) -> i32 {
    assert!((0.0..=1.0).contains(&done));
    // SAFETY: the context of every call in this file is a counter.
    unsafe { *context.cast::<u32>() += 1 };
    0
}

unsafe extern "C" fn cancel(_: *mut c_void, _: f64) -> i32 {
    1
}

#[test]
fn a_model_is_fitted_kept_loaded_and_predicts_the_same() {
    let fitted = fit(["Px", "Fz"], TARGETS, Some(count))
        .map_err(|ended| ended.1)
        .expect("it learns");
    let loaded = load(&fitted.save())
        .map_err(|ended| ended.1)
        .expect("its own bytes");
    for model in [&fitted, &loaded] {
        let mut into = [0.0; 4];
        assert_eq!(model.predict(&[0.0; 4], 2, &mut into).0, Status::OK);
        for (found, expected) in into.iter().zip([2.5, 20.5, 2.5, 20.5]) {
            assert!((found - expected).abs() < 1e-12, "{into:?}");
        }
    }
    for (features, samples, room) in [(0, u64::MAX, 0), (3, 2, 4), (4, 2, 3), (4, 1, 4)] {
        let mut into = vec![7.0; room];
        let ended = loaded.predict(&vec![0.0; features], samples, &mut into);
        assert_eq!(
            ended.0,
            Status::INVALID_ARGUMENT,
            "{features} {samples} {room}"
        );
        assert!(
            into.iter()
                .all(|value| value.to_bits() == 7.0_f64.to_bits())
        );
    }
}

#[test]
fn an_estimator_describes_itself_as_its_manifest_would() {
    let describe = estimators().describe.expect("a function");
    // SAFETY: `take` appends the text to the list.
    let (_, texts) = taken(|context, error| unsafe {
        describe(0, Some(crate::fake_host::take), context, error)
    });
    assert!(
        texts
            .concat()
            .starts_with("kind = \"estimator\"\nkey = \"mean\"\n"),
        "{texts:?}"
    );
}

#[test]
fn a_host_that_answers_cancels_the_fit() {
    let refused = fit(["Px", "Fz"], TARGETS, Some(cancel))
        .err()
        .expect("cancelled");
    assert_eq!(
        refused,
        (Status::INTERRUPTED, "the fit was cancelled".to_owned())
    );
}

#[test]
fn sets_that_cannot_be_meant_are_refused() {
    let mut spoilt = TARGETS;
    spoilt[3] = f64::NAN;
    for (names, targets, expected) in [
        (["Px", "Fz"], spoilt, "not finite"),
        (["Fz", "Px"], TARGETS, "wrong order"),
        (["Fz", "Fz"], TARGETS, "given twice"),
        (["F z", "Px"], TARGETS, "not a channel name"),
    ] {
        let (status, message) = fit(names, targets, None).err().expect("refused");
        assert_eq!(status, Status::INVALID_ARGUMENT);
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn bytes_that_are_no_model_are_refused_wherever_they_are_cut_or_changed() {
    let bytes = fit(["Px", "Fz"], TARGETS, None)
        .map_err(|ended| ended.1)
        .expect("it learns")
        .save();
    for length in 0..bytes.len() {
        let (status, _) = load(&bytes[..length]).err().expect("cut");
        assert_eq!(status, Status::PROTOCOL, "{length}");
    }
    for position in 0..bytes.len() {
        let mut changed = bytes.clone();
        changed[position] ^= 0x81;
        // Some changes give another model, and none may have any other effect.
        drop(load(&changed));
    }
}
