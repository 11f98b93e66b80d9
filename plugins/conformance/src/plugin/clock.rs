//! Compares the time stamps of a real device with the clock of this machine. The comparison detects stamps in a wrong unit.

use std::time::{Duration, Instant};

use taceva_core::{DriverKind, DriverSource, StampRate};
use taceva_host::{InProcess, Session};

use super::{Check, Of};
use crate::promise::{Unmet, expect, skipped};
use crate::stream::{Stream, next, started};
use crate::trial::Tried;

pub(super) const CHECKS: &[Check] = &[
    Of::Kind(DriverKind::Sensor).check("sensor/stamps-by-the-clock", |subject| {
        subject.tries(InProcess::sensor, keeps_time)
    }),
    Of::Kind(DriverKind::Force).check("force/stamps-by-the-clock", |subject| {
        subject.tries(InProcess::force, keeps_time)
    }),
];

/// Least duration of one comparison of stamps. A comparison also needs at least `COMPARED_MIN` items.
const COMPARED: Duration = Duration::from_millis(250);
const COMPARED_MIN: usize = 4;
/// Greatest number of comparisons. One comparison must agree, because a busy machine may delay items in the others.
const COMPARISONS: usize = 4;

/// The stamps of a real device advance like the clock of this machine.
fn keeps_time<D: Stream + ?Sized>(tried: &Tried<'_, D>) -> Result<(), Unmet> {
    let source = tried.descriptor.source();
    if source != DriverSource::Real {
        return Err(skipped(format!(
            "its stamps are {source}, so they need not follow the clock of this machine"
        )));
    }
    let mut device = started(tried)?;
    let mut rate = stamp_rate(tried, &mut *device)?;
    for _ in 1..COMPARISONS {
        if !rate.is_of_host_clock() {
            rate = stamp_rate(tried, &mut *device)?;
        }
    }
    expect(rate.is_of_host_clock(), || rate.to_string())
}

fn stamp_rate<D: Stream + ?Sized>(
    tried: &Tried<'_, D>,
    device: &mut D,
) -> Result<StampRate, Unmet> {
    let first = next(tried, device)?;
    let begun = Instant::now();
    let mut items = 0;
    loop {
        let stamp = next(tried, device)?;
        items += 1;
        let passed = begun.elapsed();
        if items >= COMPARED_MIN && passed >= COMPARED {
            let advance_s = stamp.valid_s - first.valid_s;
            return Ok(StampRate::of(advance_s, passed.as_secs_f64()));
        }
    }
}
