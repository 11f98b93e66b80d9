//! Named scores of tasks.

use serde::{Serialize, Serializer};
use taceva_metrics::{Better, Interval};

use crate::estimate::Estimate;

/// A named score of a task.
///
/// ```
/// use taceva_tasks::Classes;
/// let grasp = Classes::new(["lost", "held"], Some("held"))?;
/// let accuracy = &grasp.scores()[0];
/// assert_eq!(accuracy.metric, "class_accuracy");
/// assert_eq!(accuracy.definition, "share of samples with the right class");
/// # Ok::<(), taceva_tasks::TaskError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TaskScore {
    /// Name of the metric, such as `f1`.
    pub metric: &'static str,
    /// Second number of the metric, such as `in_truth`, or the class; `None` for the metric itself.
    pub variant: Option<String>,
    /// Unit of the value; `None` for a pure number.
    pub unit: Option<&'static str>,
    /// Definition in words, with the rules that were applied to the predictions.
    pub definition: String,
    /// Value, interval and counts.
    pub estimate: Estimate,
    /// Interval of a share as if frames were independent, for comparison with `estimate`; `None` for other scores.
    pub if_frames_were_independent: Option<Interval>,
    /// Properties of the samples that limit the score.
    pub flags: Vec<ScoreFlag>,
}

impl TaskScore {
    /// Names of all metrics of tasks.
    ///
    /// ```
    /// use taceva_tasks::TaskScore;
    /// assert!(TaskScore::METRICS.contains(&"f1") && !TaskScore::METRICS.contains(&"mae"));
    /// ```
    pub const METRICS: &[&str] = &[
        "class_accuracy",
        "balanced_accuracy",
        "f1_macro",
        "kappa",
        "mcc",
        "f1",
        "precision",
        "recall",
        "specificity",
        "roc_auc",
        "average_precision",
        "brier",
        "log_loss",
        "ece",
        "top_k",
        "onset_f1",
        "onset_delay",
        "false_alarms",
        "pose_translation",
        "pose_axis",
        "pose_rotation",
        "pose_class",
        "add",
        "add_s",
        "depth_mae",
        "depth_rmse",
        "depth_bias",
        "depth_max",
        "contact_iou",
        "normal_angle",
        "chamfer",
    ];

    /// Direction in which values of the score improve.
    #[must_use]
    pub fn better(&self) -> Better {
        TaskScore::direction(self.metric, self.unit)
    }

    /// Direction in which values of `metric` improve. `unit` is the unit of the values, `None` for a pure number.
    ///
    /// ```
    /// use taceva_metrics::Better;
    /// use taceva_tasks::TaskScore;
    /// assert_eq!(TaskScore::direction("f1", None), Better::Higher);
    /// assert_eq!(TaskScore::direction("pose_rotation", Some("deg")), Better::Lower);
    /// ```
    #[must_use]
    pub fn direction(metric: &str, unit: Option<&str>) -> Better {
        match (metric, unit) {
            ("depth_bias" | "onset_delay", _) => Better::NearZero,
            ("brier" | "log_loss" | "ece", _) | (_, Some(_)) => Better::Lower,
            _ => Better::Higher,
        }
    }

    /// True if the whole interval is better than the score of the best constant.
    ///
    /// ```
    /// use taceva_tasks::Classes;
    /// let mut grasp = Classes::new(["lost", "held"], None)?;
    /// for object in 0..20 {
    ///     grasp.push(&format!("object {object}"), "held", "held")?;
    ///     grasp.push(&format!("object {object}"), "lost", "lost")?;
    /// }
    /// assert!(grasp.scores()[0].beats_constant());
    /// # Ok::<(), taceva_tasks::TaskError>(())
    /// ```
    #[must_use]
    pub fn beats_constant(&self) -> bool {
        let ends = self.estimate.interval.ends();
        match (self.better(), ends, self.estimate.of_constant) {
            (Better::Higher, Some([low, _]), Some(of_constant)) => low > of_constant,
            (Better::Lower, Some([_, high]), Some(of_constant)) => high < of_constant,
            _ => false,
        }
    }

    /// Score `estimate` of `metric`, a pure number without a variant.
    pub(crate) fn new(
        metric: &'static str,
        definition: impl Into<String>,
        estimate: Estimate,
    ) -> TaskScore {
        TaskScore {
            metric,
            variant: None,
            unit: None,
            definition: definition.into(),
            estimate,
            if_frames_were_independent: None,
            flags: Vec::new(),
        }
    }

    /// The same score as the variant `name` of its metric.
    pub(crate) fn variant(self, name: impl Into<String>) -> TaskScore {
        TaskScore {
            variant: Some(name.into()),
            ..self
        }
    }

    /// The same score with Wilson's interval of `hits` of `trials`, as if frames were independent. No such interval for 0 trials.
    pub(crate) fn beside(self, hits: u64, trials: u64) -> TaskScore {
        let wilson = (trials > 0).then(|| Interval::wilson(hits, trials));
        TaskScore {
            if_frames_were_independent: wilson,
            ..self
        }
    }

    /// The same score with `flags`.
    pub(crate) fn flagged(self, flags: &[ScoreFlag]) -> TaskScore {
        TaskScore {
            flags: flags.to_vec(),
            ..self
        }
    }
}

/// Property of the samples that limits a score; files contain its words.
///
/// ```
/// use taceva_tasks::ScoreFlag;
/// assert_eq!(ScoreFlag::AllScoresEqual.words(), "all scores equal");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ScoreFlag {
    /// All scores are equal.
    AllScoresEqual,
    /// More than 65,536 different scores, which were rounded to multiples of 2⁻¹⁶.
    ScoresOnGrid,
    /// All scores lie outside 0 to 1, as log-odds do.
    OutsideUnit,
}

impl ScoreFlag {
    /// The flag in words.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            ScoreFlag::AllScoresEqual => "all scores equal",
            ScoreFlag::ScoresOnGrid => "scores on a grid of 2^-16",
            ScoreFlag::OutsideUnit => "all scores outside 0 to 1",
        }
    }
}

impl Serialize for ScoreFlag {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.words())
    }
}
