//! Errors that faults add, relative to the errors of a reference model.

use taceva_dataset::Dataset;
use taceva_evaluate::{EvaluateError, Work, model_provenance};
use taceva_metrics::LEAST_CLUSTERS;
use taceva_metrics::distributions::student_t;
use taceva_models::Model;

use crate::estimate::{Estimate, Undefined};
use crate::others::OtherFaults;
use crate::ratio::{Errors, UPPER};
use crate::report::{ByChannel, FaultReport, StressReport};
use crate::setup::StressRequest;
use crate::study::stress_beside;

/// Adds to `report` its errors relative to the errors of `reference`. [`stress_beside`](crate::stress_beside) made `report` of the same request.
///
/// # Errors
/// Errors of [`stress`](crate::stress()), and [`EvaluateError::Request`] if the reference model scores other samples.
pub fn add_reference(
    report: &mut StressReport,
    dataset: &Dataset,
    reference: &Model,
    request: &StressRequest,
    others: OtherFaults<'_>,
    work: Work<'_>,
) -> Result<(), EvaluateError> {
    let found = stress_beside(dataset, reference, request, others, work)?;
    if found.basis.rows != report.basis.rows {
        return Err(EvaluateError::Request(format!(
            "the reference model scores {} samples, the model {}: expected the same samples; fit both on the same part of the same recording",
            found.basis.rows.len(),
            report.basis.rows.len()
        )));
    }
    let own_clean = &report.basis.clean;
    for fault in &mut report.faults {
        let mut others = found.faults.iter();
        let Some(beside) = others.find(|other| other.id == fault.id) else {
            continue;
        };
        let channels = fault.mean.keys().filter_map(|channel| {
            let own = Excess::of(fault, beside, own_clean, channel)?;
            let other = Excess::of(beside, fault, &found.basis.clean, channel)?;
            Some((channel.clone(), ratio(&own, &other)))
        });
        let relative: ByChannel<Estimate> = channels.collect();
        fault.relative_error = Some(relative);
    }
    report.reference = Some(model_provenance(reference)?);
    report.provenance.frames_decoded += found.provenance.frames_decoded;
    Ok(())
}

/// Errors of a channel without a fault and at some severities of a fault.
struct Excess<'a> {
    clean: &'a Errors,
    cells: Vec<&'a Errors>,
}

impl<'a> Excess<'a> {
    /// Errors of `fault` at the severities that `other` has too; `None` if the channel is not scored.
    fn of(
        fault: &'a FaultReport,
        other: &FaultReport,
        clean: &'a ByChannel<Errors>,
        channel: &str,
    ) -> Option<Excess<'a>> {
        let is_common = |severity: u8| other.severities.iter().any(|of| of.severity == severity);
        let cells = fault.severities.iter().zip(&fault.errors);
        let cells = cells.filter(|(of, _)| is_common(of.severity));
        let cells = cells.map(|(_, errors)| errors.get(channel));
        Some(Excess {
            clean: clean.get(channel)?,
            cells: cells.collect::<Option<Vec<&Errors>>>()?,
        })
    }

    /// Sum over the severities of the error that the fault adds to the mean error without a fault; `None` for no errors.
    fn sum(&self) -> Option<f64> {
        let clean = self.clean.mean()?;
        let added = self.cells.iter().map(|of| Some(of.mean()? - clean));
        added.sum()
    }

    /// The same sum without the cluster at `left`.
    fn without(&self, left: usize) -> f64 {
        let clean = self.clean.mean_without(left);
        let added = self.cells.iter().map(|of| of.mean_without(left) - clean);
        added.sum()
    }

    /// True if the errors have this number of clusters at every severity.
    fn has_clusters(&self, count: usize) -> bool {
        let mut all = self.cells.iter().chain([&self.clean]);
        all.all(|of| of.clusters() == Some(count))
    }
}

/// Error that a fault adds to the model, divided by the error that it adds to the reference model.
fn ratio(own: &Excess<'_>, reference: &Excess<'_>) -> Estimate {
    if own.cells.is_empty() {
        return Estimate::undefined(Undefined::NoSeverity);
    }
    let (Some(added), Some(by)) = (own.sum(), reference.sum()) else {
        return Estimate::undefined(Undefined::Empty);
    };
    let sizes = own.clean.sizes();
    let reason = match own.clean.clusters() {
        None => Some(Undefined::NoClusters),
        Some(count) if count < LEAST_CLUSTERS => Some(Undefined::TooFewClusters),
        Some(count) if !own.has_clusters(count) || !reference.has_clusters(count) => {
            Some(Undefined::NoInterval)
        }
        Some(_) => None,
    };
    if let Some(reason) = reason {
        return Estimate::undefined(reason);
    }
    match interval(by, &sizes, |left| reference.without(left)) {
        Ok([low, _]) if low > 0.0 => {}
        _ => return Estimate::undefined(Undefined::ReferenceUnmoved),
    }
    let left_out = |left: usize| own.without(left) / reference.without(left);
    Estimate::new(added / by, interval(added / by, &sizes, left_out))
}

/// 95 % interval of `value` by the jackknife over clusters. `left_out` returns the value without a cluster. `sizes` has the number of all errors
/// divided by the number of errors of each cluster.
///
/// # Reference
/// Busing, Meijer and van der Leeden, Delete-m jackknife for unequal m, Statistics and Computing 9 (1999).
fn interval(
    value: f64,
    sizes: &[f64],
    left_out: impl Fn(usize) -> f64,
) -> Result<[f64; 2], Undefined> {
    let count = sizes.len() as f64;
    let pseudo = sizes.iter().enumerate();
    let pseudo = pseudo.map(|(left, size)| size * value - (size - 1.0) * left_out(left));
    let pseudo: Vec<f64> = pseudo.collect();
    let pairs = || pseudo.iter().zip(sizes);
    let mean: f64 = pairs().map(|(pseudo, size)| pseudo / size).sum();
    let squares = pairs().map(|(pseudo, size)| (pseudo - mean) * (pseudo - mean) / (size - 1.0));
    let variance = squares.sum::<f64>() / count;
    let half = student_t::quantile(UPPER, count - 1.0) * variance.sqrt();
    match half.is_finite() {
        true => Ok([value - half, value + half]),
        false => Err(Undefined::NoInterval),
    }
}
