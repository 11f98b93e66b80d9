//! Compares the time stamps of a real device with the clock of this machine. The comparison detects stamps in a wrong unit, of another clock, and of a
//! clock with another rate.

use std::time::{Duration, Instant};

use rustix::time::{ClockId, clock_gettime};
use taceva_core::{DriverKind, DriverSource, StampAge, StampRate};
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

/// Least duration of one comparison of stamps for their unit. A comparison also needs at least `COMPARED_MIN` items.
const COMPARED: Duration = Duration::from_millis(250);
const COMPARED_MIN: usize = 4;
/// Greatest number of comparisons. One comparison must agree, because a busy machine may delay items in the other comparisons.
const COMPARISONS: usize = 4;
/// Duration between two comparisons of the rate, duration from the first item to the last comparison, and least number of items of a comparison.
const RATED: Duration = Duration::from_secs(2);
const RATED_MAX: Duration = Duration::from_secs(6);
const RATED_MIN: usize = 8;
/// Greatest deviation of the rate of stamps from 1. The compared items arrive at least 1 s apart, at the last comparison at least 3 s. So a device
/// fails falsely only if a busy machine delays every item in a quarter of this time, by 20 ms or more in each comparison.
const DEVIATION_MAX: f64 = 0.02;

/// The stamps of a real device advance like the clock of this machine, and are of this clock.
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
    expect(rate.is_of_host_clock(), || rate.to_string())?;
    let age = StampAge::of(arrival(tried, &mut *device)?.age_s());
    expect(age.is_of_host_clock(), || format!("it has {age}"))?;
    keeps_rate(tried, &mut *device)
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

/// Arrival of an item on the clock of this machine, and its stamp, both in s.
#[derive(Clone, Copy)]
struct Arrival {
    now_s: f64,
    valid_s: f64,
}

impl Arrival {
    fn age_s(self) -> f64 {
        self.now_s - self.valid_s
    }
}

fn arrival<D: Stream + ?Sized>(tried: &Tried<'_, D>, device: &mut D) -> Result<Arrival, Unmet> {
    let valid_s = next(tried, device)?.valid_s;
    // A monotonic clock begins at 0, so neither number is negative.
    let now = Duration::try_from(clock_gettime(ClockId::Monotonic)).unwrap_or_default();
    let now_s = now.as_secs_f64();
    Ok(Arrival { now_s, valid_s })
}

/// The rate of the stamps differs from 1 by at most [`DEVIATION_MAX`] in one of several comparisons, each longer than the previous comparison.
fn keeps_rate<D: Stream + ?Sized>(tried: &Tried<'_, D>, device: &mut D) -> Result<(), Unmet> {
    let begun = Instant::now();
    let mut due = RATED;
    let mut arrivals = Vec::new();
    loop {
        arrivals.push(arrival(tried, device)?);
        let passed = begun.elapsed();
        if passed < due {
            continue;
        }
        let Some(rate) = rate_of(&arrivals) else {
            continue;
        };
        let is_exact = rate.is_exact_to(DEVIATION_MAX);
        if is_exact || passed >= RATED_MAX {
            return expect(is_exact, || rate.to_string());
        }
        due = passed + RATED;
    }
}

/// Rate of the stamps from the first to the last quarter of `arrivals`, between the items of least age; `None` for fewer than [`RATED_MIN`] items.
fn rate_of(arrivals: &[Arrival]) -> Option<StampRate> {
    let promptest = |of: &[Arrival]| {
        let least = |one: Arrival, other: Arrival| match other.age_s() < one.age_s() {
            true => other,
            false => one,
        };
        of.iter().copied().reduce(least)
    };
    if arrivals.len() < RATED_MIN {
        return None;
    }
    let quarter = arrivals.len() / 4;
    let first = promptest(&arrivals[..quarter])?;
    let last = promptest(&arrivals[arrivals.len() - quarter..])?;
    let (stamps_s, host_s) = (last.valid_s - first.valid_s, last.now_s - first.now_s);
    Some(StampRate::of(stamps_s, host_s))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rate of 400 items in 4 s, with stamps `rate` times as fast as the clock, of which nine of ten arrive 80 ms late.
    fn measured(rate: f64) -> Option<StampRate> {
        let arrivals: Vec<Arrival> = (0..400)
            .map(|number| Arrival {
                now_s: 0.01 * f64::from(number) + if number % 10 == 3 { 0.0 } else { 0.08 },
                valid_s: 7.0 + 0.01 * rate * f64::from(number),
            })
            .collect();
        rate_of(&arrivals)
    }

    #[test]
    fn late_items_change_no_rate_and_a_clock_that_is_3_per_cent_too_fast_is_found() {
        for (rate, is_exact) in [(1.0, true), (1.03, false), (0.97, false), (1.5, false)] {
            let found = measured(rate).expect("enough items");
            assert_eq!(found.is_exact_to(DEVIATION_MAX), is_exact, "{found}");
        }
        assert_eq!(rate_of(&[]), None);
    }
}
