//! Notes on the samples and the model behind scores. They are stored as data and printed as sentences.

mod detection;
mod division;
mod few_clusters;
mod likely_unit;
mod sentence;
mod within;

use std::fmt;

use taceva_core::{Unit, shown};
use taceva_dataset::{Extension, FramesInfo};
use taceva_results::DominantSample;

pub use detection::Detection;
pub use division::{Division, Independence, Neighbours, SampleOrder};
pub use few_clusters::FewClusters;
pub use within::Within;

/// A note for the reader of scores. `Display` writes its sentence.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// Division of the rows, as the split describes it.
    Split(String),
    /// Neighbouring samples that resemble each other, and their division.
    Neighbours {
        /// Findings on the neighbours.
        found: Neighbours,
        /// Division that results from the findings.
        division: Division,
    },
    /// Samples are treated as independent, each as one contact point.
    Independent(Independence),
    /// The clusters of intervals, if recordings were joined.
    Clusters {
        /// Number of recordings with scored rows.
        recordings: usize,
        /// Number of contact points in the recordings with scored rows.
        points: usize,
        /// Minimum number of recordings for intervals by recording.
        least: usize,
    },
    /// Tested groups are within larger groups, which the models may have seen.
    Within(Within),
    /// There are too few contact points or groups for any interval.
    FewClusters(FewClusters),
    /// Rows that were added to a recording later.
    Extended {
        /// Name of the recording, if several were joined.
        recording: Option<String>,
        /// Number of added rows.
        added: u64,
        /// Number of earlier rows, and day and folder of the extension.
        extension: Extension,
    },
    /// Frames that were reduced before storage.
    Reduced {
        /// Name of the recording, if several were joined.
        recording: Option<String>,
        /// The frames as stored.
        frames: FramesInfo,
    },
    /// View in use, for a recording whose samples have several pictures.
    View {
        /// Name of the recording, if several were joined.
        recording: Option<String>,
        /// Name of the view: `left`, or `left+right` side by side.
        view: String,
        /// All views, as text.
        of: String,
    },
    /// Message of an import: a warning, the zero or gravity subtracted from labels, or a joined table.
    Imported {
        /// Name of the recording, if several were joined.
        recording: Option<String>,
        /// The message of the import.
        words: String,
    },
    /// Warning of a device that made a recording.
    Device {
        /// Name of the recording, if several were joined.
        recording: Option<String>,
        /// The warning.
        words: String,
    },
    /// Standard uncertainty of the heights relative to which depths are measured.
    DepthZeros {
        /// Name of the recording, if several were joined.
        recording: Option<String>,
        /// Median uncertainty over the samples with an uncertainty, in mm.
        median_mm: f64,
        /// Greatest uncertainty of any sample, in mm.
        most_mm: f64,
        /// Number of samples with a depth but without an uncertainty.
        without: usize,
        /// Number of samples with a depth.
        of: usize,
    },
    /// Angles between predicted and true rotations.
    Rotation {
        /// The channels of the rotation.
        channels: Vec<String>,
        /// Number of samples with a predicted and a true rotation.
        samples: usize,
        /// Mean angle over the samples, in degrees.
        mean: f64,
        /// 95th percentile of the angle over the samples, in degrees.
        most: f64,
    },
    /// The model was fitted on the scored part.
    Seen(&'static str),
    /// The model was fitted on other data with this digest.
    FittedElsewhere(String),
    /// Frames of the test part that are also in the training or validation part.
    Copies {
        /// Number of copied frames in the test part.
        copies: usize,
        /// Number of scored rows.
        of: usize,
    },
    /// The model was fitted before rows were added.
    FittedBefore {
        /// Number of rows at the time of the fit.
        rows: u64,
        /// Number of rows now.
        now: u64,
    },
    /// Samples without a label or a frame.
    LeftOut {
        /// Part of the split that contains the samples.
        part: String,
        /// Number of samples without a label or a frame.
        count: usize,
    },
    /// Shares of predictions beyond the label bounds of the model, by channel.
    Bounded(Vec<(String, f64)>),
    /// Shares of samples within 1.96 predicted standard deviations, by channel.
    Calibration(Vec<Coverage>),
    /// One sample is responsible for a great part of the squared error of a channel.
    Dominant {
        /// Name of the channel.
        channel: String,
        /// The sample, with its share of the squared error.
        sample: DominantSample,
    },
    /// A setting that the fit chose, as the model card describes it.
    Chosen {
        /// Recording that the fold leaves out, if there are folds.
        fold: Option<String>,
        /// Description of the choice.
        choice: String,
    },
    /// Metrics that read only the truth use every row.
    EveryRow {
        /// Ids of the metrics.
        metrics: Vec<&'static str>,
        /// Number of rows of the dataset.
        rows: usize,
    },
    /// A caller's own model, with the facts that are known about its training data.
    CallersModel(Learning),
    /// Predictions of a caller's own model were scored without clipping.
    Unbounded,
    /// Number of merged states.
    States(usize),
    /// Number of rows in merged shards, and number of rows in the input, if some shards are missing.
    Shards([usize; 2]),
    /// Scored shard of two tables.
    Shard {
        /// Shard number and number of shards.
        shard: String,
        /// Index of the first row, and index after the last row.
        rows: [u64; 2],
        /// Number of rows of the tables.
        of: u64,
    },
    /// Method that paired the rows of two tables.
    Paired(PairedBy),
    /// Columns that are read as channels of unit 1, because no unit is stated.
    UnitOfOne(Vec<String>),
    /// An angle without a stated unit, whose values are all within its period in radians.
    LikelyRadians {
        /// Name of the channel.
        channel: String,
        /// Period that was assumed, in degrees.
        period: u16,
    },
    /// A channel whose predictions are about 1000 times the truth, or 1/1000 of the truth.
    LikelyUnit {
        /// Name of the channel.
        channel: String,
        /// Unit of the channel.
        unit: Unit,
        /// True for the factor 1/1000, false for the factor 1000.
        is_small: bool,
    },
    /// The tables of truth and predictions are byte-identical.
    SameBytes,
    /// An item that a plan leaves out.
    NotPlanned {
        /// Name of the item.
        what: String,
        /// Reason why the item is left out.
        reason: String,
    },
    /// Planned samples that were not recorded.
    Untaken {
        /// Number of samples that were not recorded.
        count: usize,
        /// Number of planned samples.
        of: usize,
    },
    /// The only measured sensor unit, although the plan contained several.
    MeasuredUnit {
        /// Serial number of the measured unit.
        unit: String,
        /// Metrics that compare units.
        metrics: Vec<&'static str>,
        /// Serial numbers of all planned units.
        of: Vec<String>,
    },
    /// Detection limit of the normal force, or the reason why there is no limit.
    DetectionLimit(Detection),
    /// Method that predicted the spacings of gratings.
    Spacings(&'static str),
    /// Sessions on a real rig in which a recording was made.
    Sessions(String),
    /// Number of frames that were captured again.
    FramesRetried(u64),
    /// Number of frozen frames, whose presses were aborted.
    FramesFrozen(u64),
}

/// Pairing of the rows of truth and predictions. Its `Display` ends the sentence "rows were paired".
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PairedBy {
    /// Rows were paired by number, because the tables share no key.
    Order,
    /// Rows were paired by number, as the caller requested.
    ChosenOrder,
    /// Rows with equal labels in the index of a data frame were paired.
    Index,
    /// Rows with equal keys were paired.
    Key {
        /// Key column of the truth.
        truth: String,
        /// Key column of the predictions.
        prediction: String,
    },
}

/// Training data of a model of the caller, as far as known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Learning {
    /// The training part, on which the caller fitted the model in this call.
    Here,
    /// The training part, according to the caller.
    Stated,
    /// The training data is unknown.
    Unknown,
}

/// Share of the samples of a channel whose truth lies within 1.96 predicted standard deviations.
#[derive(Clone, Debug, PartialEq)]
pub struct Coverage {
    /// Name of the channel.
    pub channel: String,
    /// Share of the samples, in percent.
    pub percent: f64,
    /// 95 % interval of the share by contact point, in percent; `None` for too few points.
    pub interval: Option<[f64; 2]>,
    /// Number of samples.
    pub n: u64,
}

impl Note {
    /// Note on samples of `part` without a label or a frame, if there are any.
    pub(crate) fn left_out(part: &str, count: usize) -> Option<Note> {
        let part = part.to_owned();
        (count > 0).then_some(Note::LeftOut { part, count })
    }
}

impl fmt::Display for PairedBy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |name: &str| match name {
            "" => "the unnamed column".to_owned(),
            name => format!("`{}`", shown(name)),
        };
        match self {
            PairedBy::Order => f.write_str("by order, because the tables share no key column"),
            PairedBy::Index => f.write_str("by the index of both data frames"),
            PairedBy::ChosenOrder => f.write_str("by order, as requested"),
            PairedBy::Key { truth, prediction } if truth == prediction => {
                write!(f, "by {}", name(truth))
            }
            PairedBy::Key { truth, prediction } => write!(
                f,
                "by {} of the truth and {} of the predictions",
                name(truth),
                name(prediction)
            ),
        }
    }
}

impl fmt::Display for Coverage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {:.1} % (", self.channel, self.percent)?;
        if let Some([low, high]) = self.interval {
            write!(f, "{low:.1} … {high:.1} %, ")?;
        }
        write!(f, "n {})", self.n)
    }
}

#[cfg(test)]
mod tests;
