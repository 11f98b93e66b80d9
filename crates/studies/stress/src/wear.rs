//! Wear of a sensor: errors of a fitted model on recordings of one unit, from the first recording to the last.

mod comparison;
mod order;
mod report;
mod trend;

use std::collections::BTreeMap;

use taceva_core::{Amount, Frame, Unit, shown};
use taceva_dataset::Dataset;
use taceva_evaluate::{EvaluateError, Work, subject_of};
use taceva_metrics::PLANES;
use taceva_models::Model;
use taceva_results::{Provenance, Subject, not_measured};

use crate::notes::of_scores;
use crate::pass::predictions;
use crate::report::ByChannel;
use crate::samples::{Unseen, require_model_of_pictures};
use crate::scale::{Scale, difference};
use crate::score::{Scored, Scorer};
use order::{Order, Placed};
use trend::{ErrorAt, Trend};

pub use order::WearBy;
pub use report::{ChannelWear, GelWear, LimitMet, RecordingWear, WEAR_SCHEMA, WearReport};

/// Request of a comparison of recordings: their order, and limits of errors.
#[derive(Clone, Debug, Default)]
pub struct WearRequest {
    /// Quantity that orders the recordings; `None` for presses if every recording states them, otherwise for the date.
    pub by: Option<WearBy>,
    /// Greatest accepted mean absolute error, by channel or plane.
    pub limits: ByChannel<Amount>,
}

/// Measures the errors of `model` on `recordings` of one sensor unit, in the order of their age. The model is not fitted again.
///
/// # Errors
/// [`EvaluateError::Request`] if the recordings are not of one unit or have no order, or if a limit suits no channel. Other [`EvaluateError`] if the
/// model does not suit a recording, or a picture cannot be read.
pub fn wear(
    recordings: &[Dataset],
    model: &Model,
    request: &WearRequest,
    work: Work<'_>,
) -> Result<WearReport, EvaluateError> {
    require_model_of_pictures(model)?;
    let order = Order::of(recordings, request.by)?;
    check_limits(model, &request.limits)?;
    let unseen = recordings.iter().map(|dataset| {
        let samples = Unseen::of(dataset, model, None);
        samples.map_err(|error| named(dataset, error))
    });
    let unseen: Vec<Unseen> = unseen.collect::<Result<_, EvaluateError>>()?;
    let measured = recordings.iter().zip(unseen).enumerate();
    let measured = measured.map(|(at, (dataset, samples))| {
        let is_first = order.gels.iter().any(|gel| gel[0].at == at);
        Measured::of(dataset, model, samples, is_first, work)
    });
    let measured: Vec<Measured> = measured.collect::<Result<_, EvaluateError>>()?;
    let subjects: Vec<Subject> = recordings.iter().map(subject_of).collect();
    let gels = order.gels.iter().map(|placed| Gel {
        recordings,
        measured: &measured,
        placed,
        by: order.by,
        limits: &request.limits,
    });
    let mut units = ByChannel::new();
    for of in &measured {
        units.extend(of.units.clone());
    }
    let notes = recordings.iter().zip(&measured);
    let notes = notes.flat_map(|(dataset, own)| own.notes(dataset));
    Ok(WearReport {
        schema: WEAR_SCHEMA,
        not_measured: not_measured(subjects.iter().map(|of| of.source.as_str())),
        subject: subjects[1..]
            .iter()
            .fold(subjects[0].clone(), |all, of| all.joined(of)),
        by: order.by,
        step: order.by.step(),
        units,
        gels: gels.map(|gel| gel.report()).collect(),
        notes: notes.collect(),
    })
}

/// Adds the folder of the recording to the text of a request error that does not begin with it. Other errors are unchanged.
fn named(dataset: &Dataset, error: EvaluateError) -> EvaluateError {
    let folder = format!("{}: ", shown(dataset.path()));
    match error {
        EvaluateError::Request(words) if !words.starts_with(&folder) => {
            EvaluateError::Request(folder + &words)
        }
        other => other,
    }
}

/// Refuses a limit of a channel that is not scored, in another unit, or not above 0.
fn check_limits(model: &Model, limits: &ByChannel<Amount>) -> Result<(), EvaluateError> {
    let channels = model.channels().iter();
    let scored = channels.filter(|channel| channel.period().is_none());
    let mut units: BTreeMap<&str, Unit> = scored
        .map(|channel| (channel.name(), channel.unit()))
        .collect();
    for (plane, axes, unit) in PLANES {
        if axes.iter().all(|axis| units.contains_key(axis)) {
            units.insert(plane, unit);
        }
    }
    for (name, limit) in limits {
        let problem = match units.get(name.as_str()) {
            None => format!(
                "is not scored for this model, expected one of `{}`",
                Vec::from_iter(units.keys().copied()).join("`, `")
            ),
            Some(unit) if *unit != limit.unit => {
                format!("has a limit in {}, expected a limit in {unit}", limit.unit)
            }
            Some(_) if limit.value <= 0.0 => {
                format!("has the limit {limit}, expected a limit above 0")
            }
            Some(_) => continue,
        };
        let name = shown(name);
        return Err(EvaluateError::Request(format!("mae.{name} {problem}")));
    }
    Ok(())
}

/// Scores of one recording, and its untouched picture.
struct Measured {
    scored: Scored,
    units: ByChannel<&'static str>,
    samples: usize,
    left_out: usize,
    untouched: Option<Frame>,
    source: &'static str,
    /// Mean change of a picture by contact; `None` except in the first recording of a gel.
    contact: Option<f64>,
    provenance: Provenance,
}

impl Measured {
    fn of(
        dataset: &Dataset,
        model: &Model,
        samples: Unseen,
        is_first: bool,
        work: Work<'_>,
    ) -> Result<Measured, EvaluateError> {
        // Changes are compared with contact in the first recording of a gel.
        let scale = match is_first {
            true => Scale::of(dataset, &samples.rows)?,
            false => Scale::untouched(dataset, &samples.rows)?,
        };
        let shares = vec![1.0; dataset.table().rows()];
        let found = predictions(dataset, model, &samples.rows, &shares, &[], None, work)?;
        let scorer = Scorer::new(
            dataset,
            model,
            &samples.target,
            &samples.rows,
            &[],
            work.jobs,
        )?;
        let scored = scorer.score(&found.clean)?;
        Ok(Measured {
            units: scorer.units(&scored),
            scored,
            samples: samples.rows.len(),
            left_out: samples.left_out(),
            source: scale.source(),
            provenance: samples.provenance(dataset, model, scale.decoded)?,
            untouched: scale.untouched,
            contact: scale.contact,
        })
    }

    /// Notes on limitations of the scores, each with the folder of the recording.
    fn notes(&self, dataset: &Dataset) -> Vec<String> {
        let notes = of_scores(&self.scored, self.samples).into_iter().flatten();
        let notes = notes.map(|note| format!("{}: {note}", shown(dataset.path())));
        notes.collect()
    }

    /// Difference of the untouched picture from that of `first`, as a ratio to the change by contact in `first`; `None` if unknown.
    fn stimulus(&self, first: &Measured) -> Option<f64> {
        let (own, before) = (self.untouched.as_ref()?, first.untouched.as_ref()?);
        let contact = first.contact.filter(|_| own.info() == before.info())?;
        Some(difference(own, before) / contact)
    }
}

/// Recordings of one gel, in order.
struct Gel<'a> {
    recordings: &'a [Dataset],
    measured: &'a [Measured],
    placed: &'a [Placed],
    by: WearBy,
    limits: &'a ByChannel<Amount>,
}

impl Gel<'_> {
    fn report(&self) -> GelWear {
        let of = |placed: &Placed| &self.measured[placed.at];
        let first = of(&self.placed[0]);
        let later: Vec<&Scored> = self.placed[1..]
            .iter()
            .map(|placed| &of(placed).scored)
            .collect();
        let differences = comparison::differences(&first.scored, &later);
        let differences = std::iter::once(ByChannel::new()).chain(differences);
        let recordings = self.placed.iter().zip(differences);
        let recordings = recordings.map(|(placed, differences)| {
            let own = of(placed);
            RecordingWear {
                recording: shown(self.recordings[placed.at].path()).to_string(),
                source: subject_of(&self.recordings[placed.at]).source,
                presses_since_gel: placed.presses,
                day: placed.day,
                place: placed.place,
                samples: own.samples,
                left_out: own.left_out,
                untouched: own.source,
                stimulus: own.stimulus(first),
                mae: own.scored.mae.clone(),
                differences,
                provenance: own.provenance.clone(),
            }
        });
        let recordings: Vec<RecordingWear> = recordings.collect();
        let channels = first.scored.names();
        let channels = channels.map(|name| (name.clone(), self.channel(name, &recordings)));
        GelWear {
            gel: self.recordings[self.placed[0].at]
                .header()
                .sensor
                .gel
                .clone(),
            channels: channels.collect(),
            recordings,
        }
    }

    fn channel(&self, name: &str, recordings: &[RecordingWear]) -> ChannelWear {
        let step = self.by.step();
        let errors = recordings.iter().filter_map(|of| {
            Some(ErrorAt {
                steps: of.place / step,
                error: of.mae.get(name)?.value?,
            })
        });
        let trend = Trend::of(&errors.collect::<Vec<ErrorAt>>());
        let mut later = recordings.iter();
        let different = later.find(|of| of.differences.get(name).is_some_and(|of| of.is_shown));
        ChannelWear {
            slope: trend.slope(),
            limit: self
                .limits
                .get(name)
                .map(|limit| trend.meets(limit.value, step)),
            first_different: different.map(|of| of.recording.clone()),
        }
    }
}
