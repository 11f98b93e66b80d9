//! Pareto front of models, by processor time of the fit and by error.
//!
//! A faster model beats a slower model on a channel, unless the slower model is shown to be more accurate. Accuracy is shown if the 95 % interval of
//! the difference of mean absolute errors, paired by contact point, is below 0.

use taceva_metrics::ClusterSums;

use super::models::ModelTrial;
use super::paired_errors::difference;

/// A model of a benchmark. For each channel, it has the sums of absolute errors by contact point; `None` for a channel without contact points.
pub(super) type Raced = (ModelTrial, Vec<Option<ClusterSums>>);

/// Records for each model and channel the names of the models that beat it there. Records none if the system does not report processor time.
pub(super) fn mark(race: &mut [Raced]) {
    let marks: Vec<Vec<Vec<String>>> = race
        .iter()
        .map(|own| {
            let channels = 0..own.0.errors.len();
            channels.map(|at| beaten_by(race, own, at)).collect()
        })
        .collect();
    for ((trial, _), marks) in race.iter_mut().zip(marks) {
        for (error, beaten_by) in trial.errors.iter_mut().zip(marks) {
            error.beaten_by = beaten_by;
        }
    }
}

/// Names of the models that beat the model `own` on the channel with index `at`.
fn beaten_by(race: &[Raced], (own, sums): &Raced, at: usize) -> Vec<String> {
    let error = &own.errors[at];
    let beats = |(other, other_sums): &&Raced| {
        let time = other.fit_cpu_s.zip(own.fit_cpu_s);
        let is_faster = time.is_some_and(|(other, own)| other < own);
        let mut channels = other.errors.iter();
        let Some(place) = channels.position(|one| one.channel == error.channel) else {
            return false;
        };
        let sides = [sums[at].as_ref(), other_sums[place].as_ref()];
        let is_shown_nearer =
            difference(sides).is_some_and(|difference| difference.interval[1] < 0.0);
        is_faster && !is_shown_nearer
    };
    let models = race.iter().filter(beats);
    models.map(|(other, _)| other.words()).collect()
}

#[cfg(test)]
mod tests {
    use taceva_core::Unit;

    use super::super::models::TrialError;
    use super::*;

    /// Test model with the error `errors(point)` at each of ten contact points.
    fn raced(model: &str, fit_cpu_s: f64, errors: impl Fn(u8) -> f64) -> Raced {
        let mut sums = ClusterSums::default();
        for point in 0..10_u8 {
            let added = sums.try_add(&point.to_string(), errors(point));
            added.expect("finite");
        }
        let error = TrialError {
            channel: "Fz".to_owned(),
            unit: Unit::Newton,
            mae: (0..10).map(&errors).sum::<f64>() / 10.0,
            ci95: None,
            n: 10,
            beaten_by: Vec::new(),
        };
        let trial = ModelTrial {
            model: model.to_owned(),
            settings: Vec::new(),
            fit_s: fit_cpu_s,
            fit_cpu_s: Some(fit_cpu_s),
            predict_s: 0.0,
            latency_s: 0.0,
            errors: vec![error],
            failed: None,
        };
        (trial, vec![Some(sums)])
    }

    #[test]
    fn a_slower_model_is_on_the_front_where_it_is_shown_to_be_nearer() {
        let spread = |point: u8| 0.01 * f64::from(point);
        let mut race = [
            raced("fast", 1.0, |point| 1.0 + spread(point)),
            raced("near", 2.0, |point| 0.5 + spread(point)),
            // Equal in the mean; better at some points and worse at others.
            raced("late", 3.0, |point| {
                0.5 + spread(point) + 0.1 * f64::from(point % 2) - 0.06
            }),
        ];
        mark(&mut race);
        let beaten: Vec<&[String]> = race
            .iter()
            .map(|(trial, _)| &*trial.errors[0].beaten_by)
            .collect();
        assert_eq!(beaten, [&[][..], &[], &["near".to_owned()]]);
    }
}
