//! Checks of limits on the scores of a study.

use taceva_core::shown;
use taceva_metrics::Standing;
use taceva_metrology::conformity::{Decision, Limits, Measurement, Word, decide};
use taceva_results::{Interval, Score, full_name};

use super::interval::LimitInterval;
use super::limits_file::{Limit, LimitsFile};
use super::process::ProcessRisk;
use super::reason;
use super::subject::{Subject, other_unit};
use crate::number::numeral;
use crate::results::Study;

/// Result of checking one limit.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitCheck {
    /// Checked limit.
    pub limit: Limit,
    /// Value of the score; `None` if missing.
    pub value: Option<f64>,
    /// Ends of the confidence interval of the score; `None` if the score has no interval.
    pub ends: Option<[f64; 2]>,
    /// Number of trainings of the model whose variance the interval includes; 0 if the model was trained once.
    pub trainings: usize,
    /// Number of samples of the score.
    pub n: u64,
    /// Decision by the rule of the limit, with the uncertainty of the value. `None` without a value in the unit of the limit.
    pub decision: Option<Decision>,
    /// Effect of the guard band on the limit, such as `the limit divided by 1.57`. `None` without a guard band, or if its width is in the unit of the
    /// value.
    pub guard: Option<String>,
    /// Result in one word: the word of the decision, or pass or fail without a decision rule.
    pub verdict: Word,
    /// True if the score meets the limit.
    pub is_kept: bool,
    /// Reason why the score does not meet the limit, or a remark that the score meets the limit without an interval.
    pub reason: Option<String>,
    /// Risks of wrong decisions among units of one process, or the reason why they are unknown. `None` if no units are given.
    pub process: Option<Result<ProcessRisk, String>>,
    /// Standing of the score. A limit on a score that is excluded from verdicts counts as not met.
    pub standing: Standing,
}

/// Error of a check of a result against limits.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AcceptError {
    /// A value outside its confidence interval.
    #[error(
        "{} {}: the value {} {unit} is outside its own interval {} … {} {unit}; compute the result again with `taceva evaluate` or `taceva score`",
        shown(.metric), shown(.channel), numeral(*.value), numeral(.ends[0]), numeral(.ends[1])
    )]
    OutsideInterval {
        /// Metric, with its variant.
        metric: String,
        /// Channel or plane of the score, such as `Fz` or `Fxy`.
        channel: String,
        /// Symbol of the unit.
        unit: &'static str,
        /// Value of the score.
        value: f64,
        /// Both ends of the interval.
        ends: [f64; 2],
    },
}

/// Checks each limit against the scores of `study`, in the order of the limits. A limit on a missing score or value counts as not met.
///
/// If the model was trained several times, the interval includes the variance between trainings as well as between clusters.
///
/// # Errors
/// [`AcceptError::OutsideInterval`] for a checked score whose value is outside its confidence interval.
pub fn accept(study: &Study, limits: &LimitsFile) -> Result<Vec<LimitCheck>, AcceptError> {
    let each = limits.limits.iter();
    each.map(|limit| hold(study, limits, limit)).collect()
}

fn hold(study: &Study, limits: &LimitsFile, limit: &Limit) -> Result<LimitCheck, AcceptError> {
    let mut check = LimitCheck {
        limit: limit.clone(),
        value: None,
        ends: None,
        trainings: 0,
        n: 0,
        decision: None,
        guard: None,
        verdict: match limits.is_by_rules() {
            true => Word::Undecided,
            false => Word::Fail,
        },
        is_kept: false,
        reason: None,
        process: None,
        standing: Standing::Counts,
    };
    let subject = match Subject::find(study, limit) {
        Ok(subject) => subject,
        Err(reason) => {
            check.reason = Some(reason);
            return Ok(check);
        }
    };
    check.n = subject.whole.n;
    check.standing = subject.whole.standing_of(subject.variant);
    let asked = match subject.score() {
        Ok(asked) => asked,
        Err(reason) => {
            check.reason = Some(reason);
            return Ok(check);
        }
    };
    let Some(number) = asked.value.number() else {
        check.reason = asked
            .value
            .reason()
            .or_else(|| Some("not a single number".to_owned()));
        return Ok(check);
    };
    check_within(&asked, subject.variant, number)?;
    check.value = Some(number);
    let interval = LimitInterval::of(study, &asked, subject.variant);
    check.ends = interval.ends;
    check.trainings = interval.trainings;
    let other_unit = other_unit(&asked, limit);
    if other_unit.is_none() {
        check.decision = decided(limit, number, &interval);
        let decision = check.decision.as_ref();
        check.guard = decision.and_then(|decision| reason::guard(decision, &interval));
    }
    let barred = check.standing.reason().map(str::to_owned);
    match limits.is_by_rules() {
        true => match barred.or(other_unit) {
            Some(reason) => check.reason = Some(reason),
            None => check.take_word(&interval, limits.counts_conditional_passes()),
        },
        false => {
            let broken = barred.or(other_unit);
            check.take_value(broken.or_else(|| reason::broken(limit, number, interval.ends)));
        }
    }
    Ok(check)
}

/// Rejects a value outside its confidence interval.
fn check_within(score: &Score, variant: Option<&str>, value: f64) -> Result<(), AcceptError> {
    let ends = score.interval.as_ref().and_then(Interval::ends);
    match ends {
        Some(ends) if !(ends[0] <= value && value <= ends[1]) => {
            Err(AcceptError::OutsideInterval {
                metric: full_name(&score.metric, variant),
                channel: score.channel.clone(),
                unit: score.unit.symbol(),
                value,
                ends,
            })
        }
        _ => Ok(()),
    }
}

/// Decision on `value` by the rule of `limit`; `None` if the bounds exclude every value.
fn decided(limit: &Limit, value: f64, interval: &LimitInterval) -> Option<Decision> {
    let measured = match &interval.measured {
        Ok(measured) => *measured,
        Err(_) => Measurement::without_uncertainty(value).ok()?,
    };
    let bounds = Limits::of(limit.least, limit.most).ok()?;
    decide(&measured, &bounds, &limit.decided_by).ok()
}

impl LimitCheck {
    /// Rule of the limit in words, with the scale and the effect of its guard band.
    pub(super) fn rule(&self) -> String {
        let rule = self.limit.decided_by;
        match &self.guard {
            Some(guard) => format!("{rule}{}{guard}", reason::ON_SCALE),
            None => rule.to_string(),
        }
    }

    /// Sets the verdict and the reason of the check from a decision by a rule.
    fn take_word(&mut self, interval: &LimitInterval, counts_conditional: bool) {
        let Some(decision) = &self.decision else {
            return;
        };
        self.verdict = decision.word;
        self.is_kept = match decision.word {
            Word::ConditionalPass => counts_conditional,
            word => word.is_pass(),
        };
        self.reason = reason::of_decision(&self.limit, decision, interval);
    }

    /// Sets the result for a limit without a decision rule. `broken` is the reason why the value does not meet the limit.
    fn take_value(&mut self, broken: Option<String>) {
        self.is_kept = broken.is_none();
        self.reason = broken;
        if self.is_kept {
            self.verdict = Word::Pass;
            self.reason = reason::by_value_only(&self.limit, self.ends);
        }
    }
}
