//! Two predictions of the same samples, sample by sample.

use std::collections::BTreeMap;

use taceva_metrics::{ClusterSums, ComparisonError, Difference, Sides, SignFlip};

use crate::results::Study;
use taceva_results::Score;
use taceva_results::{SampleChannel, Samples};

/// The difference of both mean absolute errors; `None` if the two do not predict the same samples of one recording.
///
/// They do if their results name the same dataset, or none, if each has the ids of the other with the same truth, bit by bit, and if the errors of
/// the samples have the mean that the score says: otherwise the table belongs to something else. Two sensors that press the same plan have ids and
/// commanded places in common, and are not the same samples.
pub(super) fn difference(
    scores: Sides<&Score>,
    studies: Sides<&Study>,
    seed: u64,
) -> Option<Result<Difference, ComparisonError>> {
    if dataset(studies.a) != dataset(studies.b) {
        return None;
    }
    let a = Errors::of(studies.a, scores.a)?;
    let b = Errors::of(studies.b, scores.b)?;
    let is_same = a.truths.len() == b.truths.len()
        && a.truths
            .iter()
            .zip(&b.truths)
            .all(|(left, right)| left == right);
    if !is_same {
        return None;
    }
    let test = SignFlip::default().with_seed(seed);
    Some(test.test(Sides {
        a: &a.sums,
        b: &b.sums,
    }))
}

/// The digest of the dataset whose samples were predicted, where the result says so.
fn dataset(study: &Study) -> Option<&str> {
    let mut provenance = study.provenance.iter();
    let dataset = provenance.find(|(term, _)| term == "dataset");
    dataset.map(|(_, digest)| digest.as_str())
}

/// |truth − prediction| of each sample, by contact point.
struct Errors<'a> {
    /// The bits of the truth of each sample.
    truths: BTreeMap<&'a str, u64>,
    sums: ClusterSums,
}

impl<'a> Errors<'a> {
    fn of(study: &'a Study, score: &Score) -> Option<Errors<'a>> {
        let samples = study.samples.as_ref()?;
        let channel = samples.channel(&score.channel)?;
        let rows = scored(samples, channel, score.n)?;
        let mut truths = BTreeMap::new();
        let mut sums = ClusterSums::default();
        let (mut sum, mut count) = (0.0, 0.0);
        for row in rows {
            let [truth, prediction] = channel.pair(row)?;
            truths.insert(samples.word(Samples::KEY, row)?, truth.to_bits());
            let error = (truth - prediction).abs();
            sums.try_add(samples.word("point_id", row)?, error).ok()?;
            sum += error;
            count += 1.0;
        }
        let is_its_own = (sum / count - score.value.number()?).abs() <= 1e-9 * sum / count;
        is_its_own.then_some(Errors { truths, sums })
    }
}

/// The rows that a score of `n` samples was made of: all with a prediction, or those of the calibration.
fn scored(samples: &Samples, channel: SampleChannel<'_>, n: u64) -> Option<Vec<usize>> {
    let paired = |rows: Vec<usize>| -> Vec<usize> {
        let mut rows = rows;
        rows.retain(|row| channel.pair(*row).is_some());
        rows
    };
    let candidates = [
        paired((0..samples.rows()).collect()),
        paired(samples.of_protocol("calibration")),
    ];
    candidates
        .into_iter()
        .find(|rows| !rows.is_empty() && u64::try_from(rows.len()) == Ok(n))
}
