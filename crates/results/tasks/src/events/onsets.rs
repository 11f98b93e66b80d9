//! Onsets, and pairs of true and predicted onsets.

/// Microseconds in a second. Distances are compared in whole microseconds, so that decimals match at the tolerance.
const MICROSECONDS: f64 = 1e6;

/// A true and a predicted onset that match. A plain pair of indices, which gets no further field.
///
/// ```
/// use taceva_tasks::events::{OnsetPair, match_onsets};
/// let pairs = match_onsets(&[1.0, 2.0], &[1.1], 0.2);
/// assert_eq!(pairs, [OnsetPair { truth: 0, prediction: 0 }]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OnsetPair {
    /// Index of the true onset.
    pub truth: usize,
    /// Index of the predicted onset.
    pub prediction: usize,
}

/// Two onsets within the tolerance.
struct Candidate {
    pair: OnsetPair,
    /// Distance between the two onsets, in whole microseconds.
    distance: f64,
}

/// Pairs of onsets at most `tolerance_s` apart, one to one, in the order of true onsets.
///
/// The nearest pair matches first. Among equally near pairs, the pair with the earlier true onset matches first, then the pair with the earlier
/// predicted onset. Times are finite.
#[must_use]
pub fn match_onsets(truth_s: &[f64], predicted_s: &[f64], tolerance_s: f64) -> Vec<OnsetPair> {
    let tolerance = (tolerance_s * MICROSECONDS).round();
    // Wider than the tolerance, because distances are rounded to microseconds.
    let reach = tolerance_s + 2.0 / MICROSECONDS;
    let mut by_time: Vec<usize> = (0..predicted_s.len()).collect();
    by_time.sort_by(|left, right| predicted_s[*left].total_cmp(&predicted_s[*right]));
    let mut candidates = Vec::new();
    for (truth, true_s) in truth_s.iter().enumerate() {
        let apart = |prediction: usize| predicted_s[prediction] - true_s;
        let first = by_time.partition_point(|prediction| apart(*prediction) < -reach);
        for prediction in by_time[first..].iter().copied() {
            if apart(prediction) > reach {
                break;
            }
            let distance = (apart(prediction) * MICROSECONDS).round().abs();
            if distance <= tolerance {
                let pair = OnsetPair { truth, prediction };
                candidates.push(Candidate { pair, distance });
            }
        }
    }
    let times = |pair: OnsetPair| (truth_s[pair.truth], predicted_s[pair.prediction]);
    candidates.sort_by(|left, right| {
        let (left_true, left_predicted) = times(left.pair);
        let (right_true, right_predicted) = times(right.pair);
        let by_distance = left.distance.total_cmp(&right.distance);
        by_distance
            .then(left_true.total_cmp(&right_true))
            .then(left_predicted.total_cmp(&right_predicted))
    });
    let mut is_free = [vec![true; truth_s.len()], vec![true; predicted_s.len()]];
    let mut pairs = Vec::new();
    for Candidate { pair, .. } in candidates {
        if is_free[0][pair.truth] && is_free[1][pair.prediction] {
            is_free[0][pair.truth] = false;
            is_free[1][pair.prediction] = false;
            pairs.push(pair);
        }
    }
    pairs.sort_by_key(|pair| pair.truth);
    pairs
}

/// Times of frames with a true label after a frame with a false label. A true label at the start of a sequence is not an onset.
pub(super) fn onset_times(labels: &[bool], times_s: &[f64]) -> Vec<f64> {
    let steps = labels.windows(2).zip(times_s.iter().skip(1));
    let onsets = steps.filter(|(step, _)| !step[0] && step[1]);
    onsets.map(|(_, time_s)| *time_s).collect()
}
