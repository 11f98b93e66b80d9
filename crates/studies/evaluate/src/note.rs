//! Notes on the samples and the model behind scores: stored as data, printed as sentences.

mod detection;
mod division;
mod few_clusters;
mod sentence;
mod within;

use std::fmt;

use taceva_core::shown;
use taceva_dataset::{Extension, FramesInfo};
use taceva_results::DominantSample;

pub use detection::Detection;
pub use division::{Division, Independence, Neighbours, SampleOrder};
pub use few_clusters::FewClusters;
pub use within::Within;

/// A note for the reader of scores; `Display` gives its sentence.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// Division of the rows, as the split describes it.
    Split(String),
    /// Neighbouring samples that resemble each other, and their division.
    Neighbours {
        /// The finding.
        found: Neighbours,
        /// The resulting division.
        division: Division,
    },
    /// Samples treated as independent, each as one contact point.
    Independent(Independence),
    /// The clusters of intervals, if recordings were joined.
    Clusters {
        /// Recordings with scored rows.
        recordings: usize,
        /// Contact points within them.
        points: usize,
        /// Least number of recordings for intervals by recording.
        least: usize,
    },
    /// Tested groups that lie within larger groups, which the models may have seen.
    Within(Within),
    /// Contact points or groups, too few for any interval.
    FewClusters(FewClusters),
    /// Rows that were added to a recording later.
    Extended {
        /// The recording, if several were joined.
        recording: Option<String>,
        /// Number of added rows.
        added: u64,
        /// Number of earlier rows, day and folder of the extension.
        extension: Extension,
    },
    /// Frames that were reduced before storage.
    Reduced {
        /// The recording, if several were joined.
        recording: Option<String>,
        /// The frames as stored.
        frames: FramesInfo,
    },
    /// View in use, for a recording whose samples have several pictures.
    View {
        /// The recording, if several were joined.
        recording: Option<String>,
        /// The view: `left`, or `left+right` side by side.
        view: String,
        /// All views, as text.
        of: String,
    },
    /// A warning of an import, the zero or gravity that it subtracted from labels, or a table that it joined.
    Imported {
        /// The recording, if several were joined.
        recording: Option<String>,
        /// The message of the import.
        words: String,
    },
    /// Standard uncertainty of the heights from which depths count.
    DepthZeros {
        /// The recording, if several were joined.
        recording: Option<String>,
        /// Median over the samples with one, mm.
        median_mm: f64,
        /// The greatest, mm.
        most_mm: f64,
        /// Samples with a depth that have none.
        without: usize,
        /// Samples with a depth.
        of: usize,
    },
    /// Angles between predicted and true rotations.
    Rotation {
        /// The channels of the rotation.
        channels: Vec<String>,
        /// Samples with both rotations.
        samples: usize,
        /// Mean angle, in degrees.
        mean: f64,
        /// 95th percentile of the angle, in degrees.
        most: f64,
    },
    /// A scored part on which the model was fitted.
    Seen(&'static str),
    /// A model fitted on other data, with the digest of that data.
    FittedElsewhere(String),
    /// Frames of the test part that are also in the training part.
    Copies {
        /// Number of such pictures.
        copies: usize,
        /// Number of scored rows.
        of: usize,
    },
    /// A model fitted before rows were added.
    FittedBefore {
        /// Rows at the time of the fit.
        rows: u64,
        /// Rows now.
        now: u64,
    },
    /// Samples without a label or a frame.
    LeftOut {
        /// Their part of the split.
        part: String,
        /// Their number.
        count: usize,
    },
    /// Shares of predictions beyond the bounds of the model, by channel.
    Bounded(Vec<(String, f64)>),
    /// Shares of samples within 1.96 predicted standard deviations, by channel.
    Calibration(Vec<Coverage>),
    /// A sample that makes a great part of the squared error of a channel.
    Dominant {
        /// The channel.
        channel: String,
        /// The sample.
        sample: DominantSample,
    },
    /// A setting that the fit chose, as the model card describes it.
    Chosen {
        /// The recording that the fold leaves out, if there are folds.
        fold: Option<String>,
        /// The choice.
        choice: String,
    },
    /// Metrics of the truth alone, which use every row.
    EveryRow {
        /// Their ids.
        metrics: Vec<&'static str>,
        /// Number of rows.
        rows: usize,
    },
    /// A model of the caller.
    CallersModel(Learning),
    /// Predictions of a model of the caller, scored unclipped.
    Unbounded,
    /// Number of merged states.
    States(usize),
    /// Number of rows in merged shards, and in the input, if some shards are missing.
    Shards([usize; 2]),
    /// Scored shard of two tables.
    Shard {
        /// Shard number and number of shards.
        shard: String,
        /// First row, and the row after the last.
        rows: [u64; 2],
        /// Number of rows of the tables.
        of: u64,
    },
    /// Method that paired the rows of two tables.
    Paired(PairedBy),
    /// Columns of tables that are taken as channels of unit 1, because no unit is stated.
    UnitOfOne(Vec<String>),
    /// An angle without a stated unit whose values all lie within its period in radians.
    LikelyRadians {
        /// The channel.
        channel: String,
        /// Period that was taken, in degrees.
        period: u16,
    },
    /// Byte-identical tables of truth and predictions.
    SameBytes,
    /// An item that a plan leaves out.
    NotPlanned {
        /// The item.
        what: String,
        /// The reason.
        reason: String,
    },
    /// Planned samples that were not recorded.
    Untaken {
        /// Their number.
        count: usize,
        /// Number of planned samples.
        of: usize,
    },
    /// The measured sensor unit, if metrics between units also used others.
    MeasuredUnit {
        /// The serial number of the unit.
        unit: String,
        /// Metrics that compare units.
        metrics: Vec<&'static str>,
        /// The serial numbers of all units.
        of: Vec<String>,
    },
    /// Detection limit of the normal force, or the reason why there is none.
    DetectionLimit(Detection),
    /// Method that predicted the spacings of gratings.
    Spacings(&'static str),
    /// Sessions on a real rig that made a recording.
    Sessions(String),
    /// Number of frames that were captured again.
    FramesRetried(u64),
    /// Number of frozen frames whose presses were broken off.
    FramesFrozen(u64),
}

/// Pairing of the rows of truth and predictions. Its `Display` ends the sentence "rows were paired".
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PairedBy {
    /// By row number, because the tables share no key.
    Order,
    /// By row number, as the caller requested.
    ChosenOrder,
    /// By equal labels in the index of a data frame.
    Index,
    /// By equal keys.
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
    /// The training part, fitted in this call.
    Here,
    /// The training part, as the caller states.
    Stated,
    /// Unknown.
    Unknown,
}

/// Share of the samples of a channel whose truth lies within 1.96 predicted standard deviations.
#[derive(Clone, Debug, PartialEq)]
pub struct Coverage {
    /// The channel.
    pub channel: String,
    /// The share, in percent.
    pub percent: f64,
    /// 95 % interval of the share by contact point, in percent.
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
