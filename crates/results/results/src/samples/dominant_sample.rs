//! Detects a single sample that causes at least a quarter of the summed squared error of a channel.

use std::fmt;

use taceva_core::shown;
use taceva_metrics::plane_axes;

use super::{SampleChannel, Samples};

/// Least number of predicted samples for reporting a dominant sample. Among fewer samples, one sample may cause a quarter of the squared error by
/// chance.
const LEAST_SAMPLES: usize = 50;
/// Least share of the summed squared error at which a sample is reported.
const LEAST_SHARE: f64 = 0.25;

/// Sample that causes at least a quarter of the squared error of a channel, summed over samples. `Display` writes a clause with name and share.
///
/// ```
/// use taceva_results::Samples;
/// let rows: String = (0..60).map(|row| format!("s{row},0.5,{}\n", if row == 7 { 9.5 } else { 1.5 })).collect();
/// let samples = Samples::read(&format!("sample,Fz,Fz_predicted\n{rows}"))?;
/// let sample = samples.dominant("Fz").expect("81 of 140 squared N");
/// assert_eq!(sample.to_string(), "sample s7 makes 58 % of the squared error");
/// # Ok::<(), taceva_results::SamplesError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct DominantSample {
    /// Name of the sample.
    pub name: String,
    /// Share of the squared error caused by the sample, from 0 to 1. The total is the sum over all predicted samples.
    pub share: f64,
}

impl Samples {
    /// Sample that causes at least a quarter of the squared error of a channel or plane, summed over samples. `None` without such a sample, or if
    /// fewer than 50 samples have truth and prediction.
    pub fn dominant(&self, channel: &str) -> Option<DominantSample> {
        let axes = plane_axes(channel).map_or_else(|| vec![channel], |axes| axes.to_vec());
        let channels = axes.into_iter().map(|axis| self.channel(axis));
        let channels: Vec<SampleChannel<'_>> = channels.collect::<Option<_>>()?;
        let error = |row: usize| -> Option<f64> {
            let pairs = channels.iter().map(|channel| channel.pair(row));
            let squares = pairs.map(|pair| pair.map(|[truth, found]| (truth - found).powi(2)));
            squares.sum()
        };
        let rows = 0..self.rows();
        let errors: Vec<(usize, f64)> = rows.filter_map(|row| Some((row, error(row)?))).collect();
        if errors.len() < LEAST_SAMPLES {
            return None;
        }
        let all: f64 = errors.iter().map(|(_, error)| error).sum();
        let greatest = errors.iter().max_by(|one, other| one.1.total_cmp(&other.1));
        let (row, most) = greatest.copied()?;
        let name = self.word(Samples::KEY, row)?.to_owned();
        let share = most / all;
        (share >= LEAST_SHARE).then_some(DominantSample { name, share })
    }
}

impl fmt::Display for DominantSample {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let DominantSample { name, share } = self;
        let percent = 100.0 * share;
        write!(
            f,
            "sample {} makes {percent:.0} % of the squared error",
            shown(name)
        )
    }
}
