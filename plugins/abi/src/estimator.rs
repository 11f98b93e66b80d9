//! Models that are fitted and predict. All arrays are the caller's, contiguous, sample by sample.

use core::ffi::c_void;

use crate::args::Args;
use crate::error::Error;
use crate::status::Status;
use crate::text::{TakeText, Text};

/// `taceva_training_set`: samples to learn from; every number is finite.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct TrainingSet {
    /// Of this struct.
    pub size: u32,
    /// Columns of the targets.
    pub channels: u32,
    /// How many samples.
    pub samples: u64,
    /// Rows of one sample's features; 1 for a flat list.
    pub height: u32,
    /// Columns; the length of a flat list.
    pub width: u32,
    /// Numbers a place.
    pub depth: u32,
    /// 0.
    pub reserved: u32,
    /// `[samples, height, width, depth]`
    pub features: *const f32,
    /// `[samples, channels]`
    pub targets: *const f64,
    /// `[samples]`: which belong together; NULL: unknown.
    pub groups: *const u32,
    /// `[channels]`
    pub channel_names: *const Text,
}

/// `taceva_progress`: called with how far a fit is, from 0 to 1; a return that is not 0 asks it to end.
pub type Progress = Option<unsafe extern "C" fn(context: *mut c_void, done: f64) -> i32>;

/// `taceva_regressor_calls`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct RegressorCalls {
    /// Of this struct.
    pub size: u32,
    /// 0.
    pub reserved: u32,
    /// `[owner & open]`
    pub close: Option<unsafe extern "C" fn(*mut c_void)>,
    /// `[any & open]` Writes `[samples, channels]`; a model of another shape than the lengths say touches neither array.
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
    /// `[any & open]` The model as bytes; `OUT_OF_RANGE` with the length needed where they do not fit.
    pub save: Option<
        unsafe extern "C" fn(*const c_void, into: *mut u8, length: *mut u64, *mut Error) -> Status,
    >,
}

/// `taceva_regressor`: a fitted model, filled in by `fit` or `load`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Regressor {
    /// The plugin's.
    pub handle: *mut c_void,
    /// Lives as long as the library.
    pub calls: *const RegressorCalls,
}

/// `taceva_estimator_factory`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct EstimatorFactory {
    /// Of this struct.
    pub size: u32,
    /// How many.
    pub estimators: u32,
    /// `[any]` Writes the `[[provides]]` table of the manifest.
    pub describe: Option<unsafe extern "C" fn(u32, TakeText, *mut c_void, *mut Error) -> Status>,
    /// `[any]` `validation` may be NULL.
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
    /// `[any]` From the bytes of `save`; hostile bytes are refused.
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
