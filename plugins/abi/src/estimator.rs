//! Models with functions to fit and to predict. The caller owns all arrays. Arrays are contiguous, sample by sample.

use core::ffi::c_void;

use crate::args::Args;
use crate::error::Error;
use crate::status::Status;
use crate::text::{TakeText, Text};

/// `taceva_training_set`: training samples. Every number is finite.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::{Text, TrainingSet};
/// let (features, targets, names) = ([0.0_f32, 1.0, 2.0, 3.0], [0.1_f64, 0.2], [Text::from("Fz")]);
/// let set = TrainingSet {
///     size: size_of::<TrainingSet>() as u32,
///     channels: 1,
///     samples: 2,
///     height: 1,
///     width: 2,
///     depth: 1,
///     reserved: 0,
///     features: features.as_ptr(),
///     targets: targets.as_ptr(),
///     groups: std::ptr::null(),
///     channel_names: names.as_ptr(),
/// };
/// assert_eq!(set.samples * u64::from(set.width), features.len() as u64);
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct TrainingSet {
    /// Size of this struct, bytes.
    pub size: u32,
    /// Number of target channels.
    pub channels: u32,
    /// Number of samples.
    pub samples: u64,
    /// Rows of one sample's features; 1 for a flat list.
    pub height: u32,
    /// Columns of one sample's features; the length of a flat list.
    pub width: u32,
    /// Values per row and column.
    pub depth: u32,
    /// Reserved, 0.
    pub reserved: u32,
    /// Features, `[samples, height, width, depth]`.
    pub features: *const f32,
    /// True values, `[samples, channels]`.
    pub targets: *const f64,
    /// Contact point of each sample, `[samples]`; NULL if unknown.
    pub groups: *const u32,
    /// Names of the channels, such as `Px` and `Fz`: `[channels]`.
    pub channel_names: *const Text,
}

/// `taceva_progress`: callback with the progress of a fit, from 0 to 1. A nonzero return cancels the fit.
///
/// ```
/// use std::ffi::c_void;
/// use taceva_abi::Progress;
/// unsafe extern "C" fn until_half(_: *mut c_void, done: f64) -> i32 {
///     i32::from(done > 0.5)
/// }
/// let progress: Progress = Some(until_half);
/// // SAFETY: the function takes any context.
/// assert_eq!(unsafe { progress.expect("set")(std::ptr::null_mut(), 0.7) }, 1);
/// ```
pub type Progress = Option<unsafe extern "C" fn(context: *mut c_void, done: f64) -> i32>;

/// `taceva_regressor_calls`: functions of a fitted model.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::RegressorCalls;
/// let calls = RegressorCalls { size: size_of::<RegressorCalls>() as u32, reserved: 0, close: None, predict: None, save: None };
/// assert!(calls.save.is_none(), "a host refuses a model that cannot be kept");
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct RegressorCalls {
    /// Size of this struct, bytes.
    pub size: u32,
    /// Reserved, 0.
    pub reserved: u32,
    /// `[owner & open]` Closes the model; the last call.
    pub close: Option<unsafe extern "C" fn(*mut c_void)>,
    /// `[any & open]` Writes predictions, `[samples, channels]`. Accesses neither array if the lengths do not match the shape of the model.
    pub predict: Option<
        unsafe extern "C" fn(
            *const c_void,
            features: *const f32,
            features_length: u64,
            samples: u64,
            into: *mut f64,
            into_length: u64,
            *mut Error,
        ) -> Status,
    >,
    /// `[any & open]` Writes the model as bytes. Returns `OUT_OF_RANGE` with the required length if the buffer is too small.
    pub save: Option<
        unsafe extern "C" fn(*const c_void, into: *mut u8, length: *mut u64, *mut Error) -> Status,
    >,
}

/// `taceva_regressor`: a fitted model, filled in by `fit` or `load`.
///
/// Frozen, because the caller allocates exactly this size.
///
/// ```
/// use taceva_abi::Regressor;
/// let place = Regressor { handle: std::ptr::null_mut(), calls: std::ptr::null() }; // empty struct that `fit` fills
/// assert!(place.handle.is_null());
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Regressor {
    /// Plugin's own handle of the model, passed with every call.
    pub handle: *mut c_void,
    /// Table of the calls of the model. Valid as long as the library is loaded.
    pub calls: *const RegressorCalls,
}

/// `taceva_estimator_factory`: functions that describe, fit and load the estimators of a plugin.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::EstimatorFactory;
/// let none = EstimatorFactory { size: size_of::<EstimatorFactory>() as u32, estimators: 0, describe: None, fit: None, load: None };
/// assert_eq!(none.estimators, 0);
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EstimatorFactory {
    /// Size of this struct, bytes.
    pub size: u32,
    /// Number of estimators in the plugin.
    pub estimators: u32,
    /// `[any]` Writes the `[[provides]]` table of the manifest.
    pub describe: Option<unsafe extern "C" fn(u32, TakeText, *mut c_void, *mut Error) -> Status>,
    /// `[any]` Fits a model to training samples. `validation` may be NULL.
    pub fit: Option<
        unsafe extern "C" fn(
            u32,
            settings: *const Args,
            training: *const TrainingSet,
            validation: *const TrainingSet,
            Progress,
            context: *mut c_void,
            *mut Regressor,
            *mut Error,
        ) -> Status,
    >,
    /// `[any]` Loads a model from the bytes of `save`. Rejects other bytes.
    pub load: Option<
        unsafe extern "C" fn(
            u32,
            bytes: *const u8,
            length: u64,
            *mut Regressor,
            *mut Error,
        ) -> Status,
    >,
}
