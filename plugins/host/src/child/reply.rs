//! Results of device operations: conversion to and from answers, and checks of their values.

use taceva_core::{GuardedStop, Pose, Stamp, Wrench, check_pose, check_wrench};

use super::wire::Answer;

/// Result of a device operation.
pub(super) trait Reply: Sized {
    /// Converts the result into an answer.
    fn into_answer(self) -> Answer;

    /// Extracts the result from `answer`; `None` for an answer to another call.
    fn from_answer(answer: Answer) -> Option<Self>;

    /// Rejects impossible values. The error names the value.
    fn check(&self) -> Result<(), String>;
}

/// Reading of a force transducer with its sequence number and the number of lost readings.
#[derive(Clone, Copy)]
pub(super) struct Reading {
    pub(super) wrench: Wrench,
    pub(super) stamp: Stamp,
    pub(super) sequence: Option<u64>,
    pub(super) lost: Option<u64>,
}

/// Time stamp of a frame with its sequence number.
#[derive(Clone, Copy)]
pub(super) struct Captured {
    pub(super) stamp: Stamp,
    pub(super) sequence: Option<u64>,
}

/// Name of the item that a changer has in place.
pub(super) struct InPlace(pub(super) String);

/// Implements [`Reply`]. Each row has the type, its parts, the matching answer and the check.
macro_rules! replies {
    ($($type:ty: $value:pat_param = $parts:expr => $answer:ident { $($part:ident),* }, $check:expr;)*) => {$(
        impl Reply for $type {
            fn into_answer(self) -> Answer {
                let $value = self;
                Answer::$answer { $($part),* }
            }

            fn from_answer(answer: Answer) -> Option<$type> {
                match answer {
                    Answer::$answer { $($part),* } => Some($parts),
                    _ => None,
                }
            }

            fn check(&self) -> Result<(), String> {
                let check: fn(&$type) -> Result<(), String> = $check;
                check(self)
            }
        }
    )*};
}

replies! {
    (): () = () => Done {}, |()| Ok(());
    Stamp: stamp = stamp => Stamped { stamp }, is_time;
    (Pose, Stamp): (pose, stamp) = (pose, stamp) => At { pose, stamp }, |(pose, stamp)| is_pose(pose, stamp);
    Reading: Reading { wrench, stamp, sequence, lost } = Reading { wrench, stamp, sequence, lost } => Load { wrench, stamp, sequence, lost }, is_load;
    InPlace: InPlace(name) = InPlace(name) => InPlace { name }, is_name;
    Captured: Captured { stamp, sequence } = Captured { stamp, sequence } => Framed { stamp, sequence }, |captured| is_time(&captured.stamp);
    GuardedStop: stop = stop => Stopped { stop }, is_stop;
}

fn is_time(stamp: &Stamp) -> Result<(), String> {
    let is_time = |time_s: f64| time_s >= 0.0 && time_s.is_finite();
    if is_time(stamp.valid_s) && stamp.received_s.is_none_or(is_time) {
        return Ok(());
    }
    Err(format!(
        "a stamp of {} s, expected a finite time",
        stamp.valid_s
    ))
}

fn is_pose(pose: &Pose, stamp: &Stamp) -> Result<(), String> {
    check_pose(pose).map_err(|error| error.to_string())?;
    is_time(stamp)
}

fn is_load(reading: &Reading) -> Result<(), String> {
    check_wrench(&reading.wrench).map_err(|error| error.to_string())?;
    is_time(&reading.stamp)
}

fn is_name(InPlace(name): &InPlace) -> Result<(), String> {
    match name.is_empty() {
        true => Err("the item in place has no name".to_owned()),
        false => Ok(()),
    }
}

fn is_stop(stop: &GuardedStop) -> Result<(), String> {
    match *stop {
        GuardedStop::Arrived { stamp } => is_time(&stamp),
        GuardedStop::Guarded { pose, stamp } => is_pose(&pose, &stamp),
    }
}
