//! Scores of a task of events.

use taceva_metrics::Dyadic;

use super::state::{
    DELAYS, DURATIONS, EventState, EventTotals, FRAMES, MATCHED, ONSETS, OUTSIDE, PREDICTED,
    UNTIMED,
};
use crate::estimate::share;
use crate::quotient::ratio;
use crate::score::{ScoreFlag, TaskScore};
use crate::totals::{LeaveOneOut, error, signed};
use crate::undefined::Undefined;

/// Totals of all clusters of sequences, and for each cluster the totals of all other clusters.
type Clusters<'a> = LeaveOneOut<'a, 2, 6>;

impl EventState {
    /// Scores of all sequences: F1 of onsets, delays of matched onsets, false alarms a minute.
    #[must_use]
    pub fn scores(&self) -> Vec<TaskScore> {
        let clusters = Clusters::of(&self.clusters);
        let rule = self.rule.words();
        let definition = |words: &str| format!("{words}, {rule}");
        let flags: &[ScoreFlag] = match clusters.total().counts {
            counts if counts[FRAMES] > 0 && counts[OUTSIDE] == counts[FRAMES] => {
                &[ScoreFlag::OutsideUnit]
            }
            _ => &[],
        };
        let f1 = clusters.estimate(ONSETS, share, onset_f1, None);
        let delay = clusters.estimate(MATCHED, signed, mean_delay, None);
        let most = clusters.without_interval(MATCHED, self.delay_point(clusters.total()), None);
        let alarms = clusters.estimate(FRAMES, error, false_alarms, None);
        let f1_words = "2 matched / (true + predicted onsets)";
        let scores = [
            TaskScore::new("onset_f1", definition(f1_words), f1),
            TaskScore {
                unit: Some("s"),
                ..TaskScore::new(
                    "onset_delay",
                    definition("mean delay of matched onsets"),
                    delay,
                )
            },
            TaskScore {
                unit: Some("s"),
                ..TaskScore::new(
                    "onset_delay",
                    definition("least delay that 95 % of matched onsets do not exceed"),
                    most,
                )
                .variant("p95")
            },
            TaskScore {
                unit: Some("1/min"),
                ..TaskScore::new(
                    "false_alarms",
                    definition("predicted onsets without a matching true onset, per minute"),
                    alarms,
                )
            },
        ];
        scores.map(|score| score.flagged(flags)).into()
    }

    /// 95th percentile of the delays of matched onsets, s.
    fn delay_point(&self, totals: &EventTotals) -> Result<f64, Undefined> {
        check_times(totals)?;
        let rank = (19 * self.delays.len()).div_ceil(20);
        let at = rank.checked_sub(1).ok_or(Undefined::NoMatch)?;
        self.delays.get(at).copied().ok_or(Undefined::NoMatch)
    }
}

/// Returns an error if there is no frame, or if a sequence has no times.
fn check_times(totals: &EventTotals) -> Result<(), Undefined> {
    match (totals.counts[FRAMES], totals.counts[UNTIMED]) {
        (0, _) => Err(Undefined::Empty),
        (_, 0) => Ok(()),
        _ => Err(Undefined::NoTimes),
    }
}

/// F1 of onsets, rounded once.
fn onset_f1(totals: &EventTotals) -> Result<f64, Undefined> {
    check_times(totals)?;
    let [matched, onsets] = [MATCHED, ONSETS].map(|index| u128::from(totals.counts[index]));
    match onsets {
        0 => Err(Undefined::NoOnset),
        onsets => Ok(ratio(2 * matched, onsets)),
    }
}

/// Mean delay of matched onsets, s.
fn mean_delay(totals: &EventTotals) -> Result<f64, Undefined> {
    check_times(totals)?;
    match totals.counts[MATCHED] {
        0 => Err(Undefined::NoMatch),
        _ => totals.mean(DELAYS, MATCHED),
    }
}

/// Predicted onsets without a matching true onset, per minute.
fn false_alarms(totals: &EventTotals) -> Result<f64, Undefined> {
    check_times(totals)?;
    let duration_s = totals.sums[DURATIONS].to_dyadic();
    if duration_s.is_zero() {
        return Err(Undefined::NoDuration);
    }
    let alarms = totals.counts[PREDICTED] - totals.counts[MATCHED];
    Ok((&Dyadic::from(alarms) * &Dyadic::from(60)).over(&duration_s))
}
