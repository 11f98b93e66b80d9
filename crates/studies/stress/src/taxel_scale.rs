//! Change of signals by contact, which is the unit of the strength of faults of taxels.

use taceva_check::SignalFacts;
use taceva_core::Signals;
use taceva_dataset::Dataset;
use taceva_evaluate::EvaluateError;

use crate::scale::{contact_rows, least_loaded, mean};

/// Untouched signals, and the change of signals by contact.
///
/// # Units
/// The unit of the signals.
pub(crate) struct TaxelScale {
    /// Statistics of signals. They contain no sample yet, but the mean signals without contact, if the recording declares them.
    pub(crate) facts: SignalFacts,
    /// Mean change of a signal value by contact; `None` if it is unknown or zero.
    pub(crate) contact: Option<f64>,
    /// Greatest change by contact of each channel of a taxel, over all taxels.
    pub(crate) full_scale: Vec<f64>,
    /// Origin of the untouched signals.
    pub(crate) source: &'static str,
}

impl TaxelScale {
    /// Measures the change by contact in the signals of `rows`; `None` without signals. The untouched signals are the declared mean without contact,
    /// or the signals of the least load.
    pub(crate) fn of(
        dataset: &Dataset,
        rows: &[usize],
    ) -> Result<Option<TaxelScale>, EvaluateError> {
        let Some(facts) = SignalFacts::empty(dataset)? else {
            return Ok(None);
        };
        let (untouched, source) = match (facts.rest.clone(), least_loaded(dataset, rows)) {
            (Some(rest), _) => (Some(rest), "reference"),
            (None, Some(row)) => (dataset.signals(row)?, "least load"),
            (None, None) => (None, "none"),
        };
        let mut full_scale = vec![0.0_f64; facts.info.channels as usize];
        let mut changes = Vec::new();
        for row in contact_rows(dataset, rows) {
            if let (Some(pressed), Some(untouched)) = (dataset.signals(row)?, &untouched) {
                changes.push(change(&pressed, untouched));
                let channels = full_scale.len();
                for (position, change) in changes_of(&pressed, untouched).enumerate() {
                    let greatest = &mut full_scale[position % channels];
                    *greatest = greatest.max(change);
                }
            }
        }
        Ok(Some(TaxelScale {
            facts,
            contact: mean(changes.into_iter()).filter(|change| *change > 0.0),
            full_scale,
            source,
        }))
    }
}

/// Mean absolute difference of the signals of two samples, over all values.
pub(crate) fn change(one: &Signals, other: &Signals) -> f64 {
    mean(changes_of(one, other)).unwrap_or(0.0)
}

fn changes_of(one: &Signals, other: &Signals) -> impl Iterator<Item = f64> {
    let pairs = one.values().iter().zip(other.values());
    pairs.map(|(one, other)| (f64::from(*one) - f64::from(*other)).abs())
}
