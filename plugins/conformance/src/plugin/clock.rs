//! Comparison of the stamps of a real device with the clock of this machine, which shows stamps in another unit.

use taceva_core::DriverKind;
use taceva_host::{InProcess, Session};

use super::{Check, Of};
use crate::stream::keeps_time;

pub(super) const CHECKS: &[Check] = &[
    Of::Kind(DriverKind::Sensor).check("sensor/stamps-by-the-clock", |subject| {
        subject.tries(InProcess::sensor, keeps_time)
    }),
    Of::Kind(DriverKind::Force).check("force/stamps-by-the-clock", |subject| {
        subject.tries(InProcess::force, keeps_time)
    }),
];
