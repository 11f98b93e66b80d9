//! Content of a task's report page besides its scores.

/// Maximum number of samples in [`TaskEvidence::worst`].
const MOST_WORST: usize = 10;

/// Content of a task's report page besides its scores: a curve, delays, and the samples with the greatest errors.
///
/// ```
/// use taceva_tasks::{TaskEvidence, WorstSample};
/// let mut evidence = TaskEvidence::default();
/// for (sample, error) in [("a", 0.1), ("b", 0.3)] {
///     evidence.add_worst(WorstSample::new(0, sample, "press 1", error, "mm"));
/// }
/// assert_eq!(evidence.worst[0].sample, "b");
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TaskEvidence {
    /// Points of the curve of precision and recall, in order of descending threshold; empty without scores.
    pub curve: Vec<CurvePoint>,
    /// Share of positive samples; `None` without a curve.
    pub prevalence: Option<f64>,
    /// Delays of matched onsets in s, in ascending order.
    pub delays_s: Vec<f64>,
    /// Samples with the greatest errors, the greatest first.
    pub worst: Vec<WorstSample>,
}

/// Precision and recall above one threshold.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// Share of positive samples with a score above the threshold.
    pub recall: f64,
    /// Share of positive samples among the samples above the threshold.
    pub precision: f64,
}

/// Sample with a great error.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq)]
pub struct WorstSample {
    /// Row of the table or dataset, from 0.
    pub row: usize,
    /// Name of the sample.
    pub sample: String,
    /// Cluster of the sample.
    pub cluster: String,
    /// Error in `unit`.
    pub error: f64,
    /// Unit of the error, or the meaning of the number.
    pub unit: &'static str,
    /// Labels in words, such as `slip as no_slip`; empty for measured errors.
    pub words: String,
}

impl WorstSample {
    /// Sample of row `row` with an error.
    #[must_use]
    pub fn new(
        row: usize,
        sample: impl Into<String>,
        cluster: impl Into<String>,
        error: f64,
        unit: &'static str,
    ) -> WorstSample {
        WorstSample {
            row,
            sample: sample.into(),
            cluster: cluster.into(),
            error,
            unit,
            words: String::new(),
        }
    }
}

impl TaskEvidence {
    /// Adds a sample if its error is among the greatest errors. Among equal errors, the sample added first comes first.
    pub fn add_worst(&mut self, sample: WorstSample) {
        let behind = |own: &WorstSample| own.error.total_cmp(&sample.error).is_ge();
        let at = self.worst.iter().take_while(|own| behind(own)).count();
        self.worst.insert(at, sample);
        self.worst.truncate(MOST_WORST);
    }
}

/// Points of the curve of precision and recall, from counts of positive and negative samples at descending scores.
pub(crate) fn curve_of(levels: impl Iterator<Item = [u64; 2]>, positives: u64) -> Vec<CurvePoint> {
    let (mut found, mut wrong) = (0_u64, 0_u64);
    let point = |[own, other]: [u64; 2]| {
        found += own;
        wrong += other;
        CurvePoint {
            recall: found as f64 / positives as f64,
            precision: found as f64 / (found + wrong) as f64,
        }
    };
    levels.map(point).collect()
}
