//! Errors that faults add to a model, relative to the errors that they add to a reference model.

use taceva_core::counted;
use taceva_dataset::Dataset;
use taceva_evaluate::{EvaluateError, Work, model_provenance};
use taceva_metrics::distributions::student_t;
use taceva_metrics::{Difference, LEAST_CLUSTERS, Sides, SignFlip, holm};
use taceva_models::Model;

use crate::difference::decided;
use crate::estimate::{Estimate, Undefined};
use crate::others::OtherFaults;
use crate::ratio::{Errors, UPPER};
use crate::report::{ByChannel, CleanScore, FaultReport, StressReport};
use crate::setup::StressRequest;
use crate::study::stress_beside;

/// Maximum p value of a significant difference.
const LEVEL: f64 = 0.05;

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
    let mut tested: Vec<Result<Difference, String>> = Vec::new();
    for fault in &mut report.faults {
        let mut others = found.faults.iter();
        let Some(beside) = others.find(|other| other.id == fault.id) else {
            continue;
        };
        let channels = fault.mean.keys().filter_map(|channel| {
            let own = Excess::of(fault, beside, own_clean, channel)?;
            let other = Excess::of(beside, fault, &found.basis.clean, channel)?;
            tested.push(match without_skill(channel, &report.clean, &found.clean) {
                Some(reason) => Err(reason.to_owned()),
                None => difference(&own, &other, request.seed),
            });
            Some((channel.clone(), ratio(&own, &other)))
        });
        let relative: ByChannel<Estimate> = channels.collect();
        fault.relative_error = Some(relative);
    }
    report.notes.extend(out_of_reach(&tested));
    let mut decided = decided(tested).into_iter();
    for fault in &mut report.faults {
        let channels = fault.relative_error.as_ref().map(ByChannel::keys);
        fault.difference = channels.map(|channels| channels.cloned().zip(&mut decided).collect());
    }
    report.reference = Some(model_provenance(reference)?);
    report.provenance.frames_decoded += found.provenance.frames_decoded;
    Ok(())
}

/// Reason why two models are not compared on `channel`: one has no skill, so faults cannot add to its error. `None` if both may have skill.
fn without_skill(
    channel: &str,
    own: &ByChannel<CleanScore>,
    reference: &ByChannel<CleanScore>,
) -> Option<&'static str> {
    let lacks_skill = |of: &ByChannel<CleanScore>| {
        let score = of.get(channel);
        score.is_some_and(|score| score.skill.is_above_zero() == Some(false))
    };
    if lacks_skill(own) {
        return Some("the model has no skill even without a fault");
    }
    lacks_skill(reference).then_some("the reference model has no skill even without a fault")
}

/// Errors of a channel without a fault, and at those severities of a fault that are compared.
struct Excess<'a> {
    clean: &'a Errors,
    cells: Vec<&'a Errors>,
}

impl<'a> Excess<'a> {
    /// Errors of `channel` with `fault`, at the severities that `other` also has; `None` if the channel is not scored.
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

    /// Sum over the severities of the mean error with the fault minus the mean error without a fault; `None` for no errors.
    fn sum(&self) -> Option<f64> {
        let clean = self.clean.mean()?;
        let added = self.cells.iter().map(|of| Some(of.mean()? - clean));
        added.sum()
    }

    /// Same as `sum`, without the samples of the cluster with the index `left`.
    fn without(&self, left: usize) -> f64 {
        let clean = self.clean.mean_without(left);
        let added = self.cells.iter().map(|of| of.mean_without(left) - clean);
        added.sum()
    }

    /// True if the errors have `count` clusters at every severity.
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

/// Error that a fault adds to the model minus the error that it adds to the reference model. A paired sign-flip test over clusters tests it.
fn difference(own: &Excess<'_>, reference: &Excess<'_>, seed: u64) -> Result<Difference, String> {
    if own.cells.is_empty() {
        return Err(Undefined::NoSeverity.to_string());
    }
    if own.clean.clusters().is_none() {
        return Err(Undefined::NoClusters.to_string());
    }
    let [Some(a), Some(b)] = [own, reference].map(|of| of.clean.added_by(&of.cells)) else {
        return Err("the samples of a contact point differ between severities".to_owned());
    };
    let sums = Sides { a: &a, b: &b };
    let tested = SignFlip::default().with_seed(seed).test(sums);
    tested.map_err(|reason| reason.to_string())
}

/// Note for tests that can find no difference whatever the values, because so few clusters have too few patterns of signs; `None` for other tests.
fn out_of_reach(tested: &[Result<Difference, String>]) -> Option<String> {
    let least = tested.iter().flatten().map(|of| of.test.least_p());
    let least: Vec<f64> = least.collect();
    let adjusted = holm(&least).ok()?;
    let smallest = adjusted.iter().copied().reduce(f64::min)?;
    (smallest > LEVEL).then(|| {
        format!(
            "No difference from the reference model can be shown: the smallest possible p is {smallest:.2} by Holm over {}; score more contact points or name fewer faults.",
            counted(least.len(), "difference")
        )
    })
}

/// 95 % interval of `value` by the jackknife over clusters. `left_out` returns the value without a cluster. `sizes` has, for each cluster, the number
/// of all errors divided by the number of its errors.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Errors of two samples at each of six contact points: 1 N plus the value of the contact point in `added`.
    fn errors(added: [f64; 6]) -> Errors {
        let rows = || added.iter().flat_map(|added| [added, added]).enumerate();
        let names: Vec<String> = rows().map(|(row, _)| format!("p{}", row / 2)).collect();
        let errors: Vec<Option<f64>> = rows().map(|(_, added)| Some(1.0 + added)).collect();
        Errors::of(&errors, Some(&names))
    }

    #[test]
    fn the_difference_of_added_errors_is_a_mean_over_severities_and_flips_signs_of_points() {
        let (none, own) = (errors([0.0; 6]), errors([2.0, 4.0, 6.0, 8.0, 10.0, 0.0]));
        let reference = errors([0.0, 0.0, 0.0, 0.0, 0.0, 12.0]);
        let of = |fault| Excess {
            clean: &none,
            cells: vec![fault, &none],
        };
        // Differences 1, 2, 3, 4, 5, −6: 28 of 64 patterns of signs have a sum of at least 9.
        let found = difference(&of(&own), &of(&reference), 1).expect("six points");
        assert_eq!((found.value, found.p), (1.5, 28.0 / 64.0));
        let back = difference(&of(&reference), &of(&own), 1).expect("six points");
        assert_eq!((back.value, back.p), (-1.5, found.p));
    }

    #[test]
    fn a_family_that_is_too_large_for_its_points_is_noted() {
        let (none, own) = (errors([0.0; 6]), errors([2.0; 6]));
        let of = |fault| Excess {
            clean: &none,
            cells: vec![fault],
        };
        let tested = || Ok(difference(&of(&own), &of(&none), 1).expect("six points"));
        assert_eq!(out_of_reach(&[Err("no skill".to_owned())]), None);
        // Six points have 64 patterns of signs: the least p is 1/32.
        assert_eq!(out_of_reach(&[tested()]), None);
        let said = out_of_reach(&[tested(), tested()]).expect("a note");
        assert!(
            said.contains("p is 0.06 by Holm over 2 differences"),
            "{said}"
        );
    }

    #[test]
    fn errors_without_points_or_of_other_samples_have_no_difference() {
        let (whole, unnamed) = (errors([0.0; 6]), Errors::of(&[Some(1.0); 12], None));
        let points: Vec<String> = (0..6).map(|point| format!("p{point}")).collect();
        let fewer = Errors::of(&[Some(1.0); 6], Some(&points));
        let refused = |clean, cell| {
            let cells = vec![cell];
            let of = Excess { clean, cells };
            difference(&of, &of, 1).expect_err("no difference")
        };
        assert_eq!(refused(&unnamed, &whole), "no contact points");
        let said = refused(&whole, &fewer);
        assert!(said.contains("differ between severities"), "{said}");
    }
}
