//! Notes on the samples and the model behind scores: data here, sentences in a report.

mod detection;
mod division;
mod sentence;

use std::fmt;

use taceva_core::shown;
use taceva_dataset::{Extension, FramesInfo};

pub use detection::Detection;
pub use division::{Division, Independence, Neighbours, SampleOrder};

/// One note for a reader of scores; `Display` gives its sentence.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// The division of the rows, in the words of the split.
    Split(String),
    /// Neighbouring samples that resemble each other, and how they were divided.
    Neighbours {
        /// The finding.
        found: Neighbours,
        /// The division that follows from it.
        division: Division,
    },
    /// Samples treated as independent, each as a point of its own.
    Independent(Independence),
    /// The clusters of intervals, if recordings were joined.
    Clusters {
        /// Recordings with scored rows.
        recordings: usize,
        /// Contact points within them.
        points: usize,
        /// Minimum recordings for intervals by recording.
        least: usize,
    },
    /// Too few contact points for any interval.
    FewPoints(usize),
    /// Rows that were added to a recording later.
    Extended {
        /// The recording, if several were joined.
        recording: Option<String>,
        /// Rows that were added.
        added: u64,
        /// Rows before, day and folder of the extension.
        extension: Extension,
    },
    /// Frames that were reduced before they were stored.
    Reduced {
        /// The recording, if several were joined.
        recording: Option<String>,
        /// The frames as stored.
        frames: FramesInfo,
    },
    /// The view used, in a recording whose samples have several pictures.
    View {
        /// The recording, if several were joined.
        recording: Option<String>,
        /// The view: `left`, or `left+right` side by side.
        view: String,
        /// All views, in words.
        of: String,
    },
    /// A warning of an import, or the zero or gravity that it subtracted from labels.
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
        /// Samples with both.
        samples: usize,
        /// Mean angle, degrees.
        mean: f64,
        /// 95th percentile of the angle, degrees.
        most: f64,
    },
    /// A scored part that the model was fitted on.
    Seen(&'static str),
    /// A model fitted on other data, with the digest of that data.
    FittedElsewhere(String),
    /// Pictures of the test part that the model was also fitted on.
    Copies {
        /// Number of such pictures.
        copies: usize,
        /// Number of scored rows.
        of: usize,
    },
    /// A model that was fitted before rows were added.
    FittedBefore {
        /// Rows at the time of the fit.
        rows: u64,
        /// Rows now.
        now: u64,
    },
    /// Samples without a label or a frame.
    LeftOut {
        /// Their part.
        part: String,
        /// Their number.
        count: usize,
    },
    /// Shares of predictions beyond the bounds of the model, by channel.
    Bounded(Vec<(String, f64)>),
    /// Shares of samples within 1.96 predicted standard deviations, by channel.
    Calibration(Vec<Coverage>),
    /// A setting that the user left open, in the words of the model's card.
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
        /// The rows.
        rows: usize,
    },
    /// A model that a caller holds.
    CallersModel(Learning),
    /// Predictions of such a model that were scored unclipped.
    Unbounded,
    /// Number of merged states.
    States(usize),
    /// Rows of an input, some of which are in no merged shard.
    Shards([usize; 2]),
    /// The shard of two tables that was scored.
    Shard {
        /// Number of the shard and of all shards.
        shard: String,
        /// First row, and the row after the last.
        rows: [u64; 2],
        /// Rows of the tables.
        of: u64,
    },
    /// The way in which rows of two tables were paired.
    Paired(PairedBy),
    /// Columns of tables that are taken as channels of unit 1, because nobody states their unit.
    UnitOfOne(Vec<String>),
    /// Tables of truth and predictions with the same bytes.
    SameBytes,
    /// Something that a plan leaves out.
    NotPlanned {
        /// The thing.
        what: String,
        /// The reason.
        reason: String,
    },
    /// Planned samples that were not recorded.
    Untaken {
        /// Their number.
        count: usize,
        /// Planned samples.
        of: usize,
    },
    /// The unit of the sensor that was measured, if metrics between units used others too.
    MeasuredUnit {
        /// The serial number of the unit.
        unit: String,
        /// Metrics of several units.
        metrics: Vec<&'static str>,
        /// The serial numbers of all units.
        of: Vec<String>,
    },
    /// The detection limit of normal force, or the reason that there is none.
    DetectionLimit(Detection),
    /// The way in which spacings of gratings were predicted.
    Spacings(&'static str),
    /// The sessions on a real rig in which a recording was made.
    Sessions(String),
    /// Frames that were recorded again.
    FramesRetried(u64),
}

/// Pairing of the rows of truth and predictions; its `Display` ends the sentence "rows were paired".
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PairedBy {
    /// The first row with the first, because the tables share no key.
    Order,
    /// The first row with the first, as the caller requested.
    ChosenOrder,
    /// The rows with the same label in the index of a data frame.
    Index,
    /// The rows with the same key.
    Key {
        /// The column of the truth.
        truth: String,
        /// The column of the predictions.
        prediction: String,
    },
}

/// Training data of a model that a caller holds, as far as known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Learning {
    /// The training part, in this call.
    Here,
    /// The training part, as the caller states.
    Stated,
    /// Unknown samples.
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
    /// Samples.
    pub n: u64,
}

impl Note {
    /// Samples of `part` without a label or a frame, if there are any.
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
