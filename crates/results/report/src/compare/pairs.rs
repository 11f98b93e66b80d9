//! Compares two predictions of the same samples in pairs.

use std::collections::BTreeMap;

use taceva_metrics::{
    ClusterSums, ComparisonError, Difference, Sides, SignFlip, TrainingSpread,
    paired_over_trainings, plane_axes,
};

use crate::results::{BY_GROUP, Study};
use taceva_results::{Interval, SampleChannel, Samples, Score};

/// Compares mean absolute errors in pairs, or returns the reason why this is impossible.
///
/// Pairing requires four conditions. Both results name the same truth, or neither names a truth. Both results have the same ids with bit-equal truth.
/// Both results assign each sample to the same cluster. The mean of the sample errors equals the score, otherwise the table belongs to other results.
/// Two sensors pressed by the same plan share ids and commanded positions, but not samples.
///
/// Uses a paired t test with the variance between trainings if either model has several trainings with different errors, otherwise the sign-flip
/// test.
///
/// # Errors
/// The reason if both results name the same truth, or have equal samples in different clusters; otherwise `None`.
pub(super) fn difference(
    scores: Sides<&Score>,
    studies: Sides<&Study>,
    names: Sides<&str>,
    seed: u64,
) -> Result<Result<Difference, ComparisonError>, Option<String>> {
    let truth = truth(studies.a);
    if truth != self::truth(studies.b) {
        return Err(None);
    }
    let known = |reason: String| truth.map(|_| reason);
    let of = |study, score, name: &str| {
        Errors::of(study, score).map_err(|reason| known(format!("{reason} of {name}")))
    };
    let a = of(studies.a, scores.a, names.a)?;
    let b = of(studies.b, scores.b, names.b)?;
    if a.truths != b.truths {
        return Err(known(
            "the two models predicted different samples".to_owned(),
        ));
    }
    let is_alike = a.grouping.column == b.grouping.column;
    if is_alike && a.clusters != b.clusters {
        let name = a.grouping.name;
        return Err(Some(format!(
            "their equal samples have different {name}; give both results the same {name}"
        )));
    }
    let sums = Sides {
        a: &a.sums,
        b: &b.sums,
    };
    let sides = [(studies.a, scores.a), (studies.b, scores.b)].into_iter();
    let spreads = sides.filter_map(|(study, score)| study.trainings(score));
    let spreads: Vec<TrainingSpread> = spreads.filter(TrainingSpread::varies).collect();
    Ok(match spreads.is_empty() {
        true => SignFlip::default().with_seed(seed).test(sums),
        false => paired_over_trainings(sums, &spreads),
    })
}

/// Digest of the truth: of the predicted dataset or of the truth table, if the result states it.
fn truth(study: &Study) -> Option<&str> {
    study.stated("dataset").or(study.made.truth.as_deref())
}

/// |truth − prediction| of each sample, by cluster.
struct Errors<'a> {
    /// Truth of each sample as bits, one number for each axis.
    truths: BTreeMap<&'a str, Vec<u64>>,
    /// Cluster of each sample.
    clusters: BTreeMap<&'a str, &'a str>,
    grouping: Clusters,
    sums: ClusterSums,
}

impl<'a> Errors<'a> {
    /// Prediction errors of the samples of `score`, or the reason why they are unknown. The error of a plane is the mean over its axes, like the score of a
    /// plane.
    fn of(study: &'a Study, score: &Score) -> Result<Errors<'a>, String> {
        let samples = study
            .samples
            .as_ref()
            .ok_or("a table of samples is missing beside the result")?;
        let strange = || {
            format!(
                "the table of samples does not give the {} {}",
                score.metric, score.channel
            )
        };
        let axes = match plane_axes(&score.channel) {
            Some(axes) => axes.to_vec(),
            None => vec![score.channel.as_str()],
        };
        let channels = axes.into_iter().map(|axis| samples.channel(axis));
        let channels: Vec<SampleChannel<'_>> =
            channels.collect::<Option<_>>().ok_or_else(strange)?;
        let rows = scored(samples, &channels, score.n).ok_or_else(strange)?;
        let grouping = Clusters::of(score);
        let (mut truths, mut clusters) = (BTreeMap::new(), BTreeMap::new());
        let mut sums = ClusterSums::default();
        let (mut sum, mut count) = (0.0, 0.0);
        for row in rows {
            let pairs = channels.iter().map(|channel| channel.pair(row));
            let pairs: Vec<[f64; 2]> = pairs.collect::<Option<_>>().ok_or_else(strange)?;
            let key = samples
                .word(Samples::KEY, row)
                .ok_or("sample names are missing in the table of samples")?;
            let cluster = samples.word(grouping.column, row);
            let cluster = cluster
                .ok_or_else(|| format!("{} are missing in the table of samples", grouping.name))?;
            clusters.insert(key, cluster);
            let truth: Vec<u64> = pairs.iter().map(|[truth, _]| truth.to_bits()).collect();
            if truths.insert(key, truth).is_some() {
                return Err("a sample occurs twice in the table of samples".to_owned());
            }
            let errors = pairs.iter().map(|[truth, found]| (truth - found).abs());
            let error = errors.sum::<f64>() / pairs.len() as f64;
            sums.try_add(cluster, error).map_err(|_| strange())?;
            sum += error;
            count += 1.0;
        }
        let value = score.value.number().ok_or_else(strange)?;
        match (sum / count - value).abs() <= 1e-9 * sum / count {
            true => Ok(Errors {
                truths,
                clusters,
                grouping,
                sums,
            }),
            false => Err(strange()),
        }
    }
}

/// Column of the clusters by which errors are summed, as for the interval of a score.
struct Clusters {
    name: &'static str,
    column: &'static str,
}

impl Clusters {
    /// Clusters of `score`, by the method of its interval; contact points by default.
    fn of(score: &Score) -> Clusters {
        let method = score.interval.as_ref().and_then(Interval::method);
        let method = method.unwrap_or_default();
        let (name, column) = if method.contains("samples taken as independent") {
            ("sample names", Samples::KEY)
        } else if method.contains(BY_GROUP) {
            ("groups", Samples::GROUP)
        } else if method.contains(" by recording") {
            ("recordings", "recording")
        } else {
            ("contact points", "point_id")
        };
        Clusters { name, column }
    }
}

/// Rows of the `n` samples of a score: all rows with truth and prediction of each channel, or only rows of the calibration. `None` if neither
/// number of rows equals `n`.
fn scored(samples: &Samples, channels: &[SampleChannel<'_>], n: u64) -> Option<Vec<usize>> {
    let paired = |rows: Vec<usize>| -> Vec<usize> {
        let mut rows = rows;
        let is_paired = |row: usize| channels.iter().all(|channel| channel.pair(row).is_some());
        rows.retain(|row| is_paired(*row));
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
