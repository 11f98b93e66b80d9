//! Order of the recordings of one unit: by presses on its gel, or by date.

use std::collections::BTreeMap;

use serde::Serialize;

use taceva_core::{Date, shown};
use taceva_dataset::Dataset;
use taceva_evaluate::EvaluateError;

/// Quantity that orders the recordings of a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum WearBy {
    /// Presses on the gel before the recording.
    Presses,
    /// Days from the first recording of the gel.
    Date,
}

impl WearBy {
    /// Number of presses or days for which the growth of an error is stated.
    pub fn step(self) -> f64 {
        match self {
            WearBy::Presses => 1000.0,
            WearBy::Date => 30.0,
        }
    }

    /// Unit of the quantity.
    pub fn unit(self) -> &'static str {
        match self {
            WearBy::Presses => "presses",
            WearBy::Date => "days",
        }
    }
}

/// Recording with its age: the number of presses or days in the life of the gel.
pub(crate) struct Placed {
    /// Index of the recording among all recordings.
    pub(crate) at: usize,
    pub(crate) presses: Option<u32>,
    /// First day of the recording; `None` if unknown.
    pub(crate) day: Option<Date>,
    /// Presses on the gel, or days from its first recording.
    pub(crate) place: f64,
}

/// Recordings of one sensor unit, by gel and, for each gel, in the order of their age.
pub(crate) struct Order {
    pub(crate) by: WearBy,
    /// Recordings of each gel in the order of their age. The gels are in the order of their names.
    pub(crate) gels: Vec<Vec<Placed>>,
}

impl Order {
    /// Orders `recordings` by `wanted`. For `None`, by presses if every recording states them, otherwise by date.
    pub(crate) fn of(
        recordings: &[Dataset],
        wanted: Option<WearBy>,
    ) -> Result<Order, EvaluateError> {
        check_unit(recordings)?;
        let mut gels: BTreeMap<&str, Vec<Placed>> = BTreeMap::new();
        for (at, recording) in recordings.iter().enumerate() {
            let header = recording.header();
            let days = header.days(recording.table().t_s());
            let own = gels.entry(header.sensor.gel.as_str()).or_default();
            own.push(Placed {
                at,
                presses: header.sensor.presses_since_gel,
                day: days.map(|days| *days.start()),
                place: 0.0,
            });
        }
        let mut all = gels.values().flatten();
        let by = wanted.unwrap_or(match all.all(|of| of.presses.is_some()) {
            true => WearBy::Presses,
            false => WearBy::Date,
        });
        let mut gels: Vec<Vec<Placed>> = gels.into_values().collect();
        for gel in &mut gels {
            check_presses(recordings, gel)?;
            place(recordings, gel, by)?;
        }
        Ok(Order { by, gels })
    }
}

fn refused<T>(words: String) -> Result<T, EvaluateError> {
    Err(EvaluateError::Request(words))
}

/// Refuses fewer than two recordings, recordings of several units, and a recording that is given twice or together with an earlier state of it.
fn check_unit(recordings: &[Dataset]) -> Result<(), EvaluateError> {
    let expected = "expected two or more recordings of one unit, made at different times";
    let [first, others @ ..] = recordings else {
        return refused(format!("no recording is named, {expected}"));
    };
    if others.is_empty() {
        let path = shown(first.path());
        return refused(format!("{path}: one recording, {expected}"));
    }
    for (at, other) in recordings.iter().enumerate() {
        let has_state_of = |before: &&Dataset| {
            let mut states = before.header().stages();
            states.any(|state| other.header().stages().any(|own| own == state))
        };
        if let Some(same) = recordings[..at].iter().find(has_state_of) {
            return refused(format!(
                "{} and {} are one recording or states of one recording, {expected}",
                shown(same.path()),
                shown(other.path())
            ));
        }
        let [own, of_first] = [other, first].map(|of| &of.header().sensor);
        if own.model != of_first.model || own.serial != of_first.serial {
            return refused(format!(
                "{} is of the sensor `{}` with serial number `{}`, {} of `{}` with `{}`: {expected}",
                shown(first.path()),
                shown(&of_first.model),
                shown(&of_first.serial),
                shown(other.path()),
                shown(&own.model),
                shown(&own.serial)
            ));
        }
    }
    Ok(())
}

/// Refuses a recording with fewer presses than an earlier recording of the same gel.
fn check_presses(recordings: &[Dataset], gel: &[Placed]) -> Result<(), EvaluateError> {
    let mut dated: Vec<(Date, u32, usize)> = gel
        .iter()
        .filter_map(|of| Some((of.day?, of.presses?, of.at)))
        .collect();
    dated.sort_unstable();
    let decrease = dated.windows(2).find(|pair| pair[1].1 < pair[0].1);
    let Some(&[(day, presses, at), (later, fewer, other)]) = decrease else {
        return Ok(());
    };
    refused(format!(
        "{} of {day} states presses_since_gel = {presses}, and {} of {later} states {fewer} with the same gel `{}`: expected numbers that do not \
         decrease; correct [sensor] in dataset.toml, and accept the edit by `taceva reseal`",
        shown(recordings[at].path()),
        shown(recordings[other].path()),
        shown(&recordings[at].header().sensor.gel)
    ))
}

/// Sets the age of each recording of a gel, in presses or days, and sorts by age.
fn place(recordings: &[Dataset], gel: &mut [Placed], by: WearBy) -> Result<(), EvaluateError> {
    let first = gel.iter().filter_map(|of| of.day).min();
    let day = |day: Date| day.days_since_1970() as f64;
    for of in gel.iter_mut() {
        let place = match by {
            WearBy::Presses => of.presses.map(f64::from),
            WearBy::Date => of.day.zip(first).map(|(own, first)| day(own) - day(first)),
        };
        let Some(place) = place else {
            let path = shown(recordings[of.at].path());
            return refused(match by {
                WearBy::Presses => format!(
                    "{path}: no `presses_since_gel` in [sensor] of dataset.toml, expected the presses on the gel before the recording; add them and \
                     accept the edit by `taceva reseal`, or use --by date"
                ),
                WearBy::Date => format!(
                    "{path}: no day: `recorded_on` is not stated in dataset.toml, and its clock gives no date; add it and accept the edit by \
                     `taceva reseal`, or state `presses_since_gel` in [sensor] of every recording"
                ),
            });
        };
        of.place = place;
    }
    let path = |of: &Placed| recordings[of.at].path();
    gel.sort_by(|one, other| {
        let places = one.place.total_cmp(&other.place);
        places
            .then_with(|| one.day.cmp(&other.day))
            .then_with(|| path(one).cmp(path(other)))
    });
    Ok(())
}
