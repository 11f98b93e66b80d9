//! Notes on the samples and the model behind scores: data here, sentences in a report.

mod division;

use std::fmt;

use taceva_core::shown;
use taceva_dataset::{Extension, FramesInfo};
use taceva_results::OPTIMISTIC;

pub use division::{Division, Independence, Neighbours, SampleOrder};

/// Number of recordings below which an interval by recording states that number: Student's t has too few degrees of freedom to be narrow.
const CLUSTERS_MANY: usize = 10;

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
    /// Frames that differ from what the camera gave.
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
    /// A warning of the import of a recording, or what the import took from labels.
    Imported {
        /// The recording, if several were joined.
        recording: Option<String>,
        /// The message of the import.
        words: String,
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
    /// The noise of untouched frames as a force, which is not a detection limit.
    DetectionLimit,
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

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Note::Split(words) | Note::Sessions(words) => f.write_str(words),
            Note::Neighbours { found, division } => division::write(found, division, f),
            Note::Independent(Independence::Stated) => f.write_str(
                "the caller declared the samples independent, so each counts as one contact point; intervals are too narrow if samples \
                 depend on each other",
            ),
            Note::Independent(Independence::Found) => f.write_str(
                "each sample counts as one contact point: no point_id repeats, and neighbouring samples are dissimilar",
            ),
            Note::Clusters {
                recordings,
                points,
                least,
            } => clusters(*recordings, *points, *least, f),
            Note::FewPoints(points) => write!(
                f,
                "scored on {points} contact points, too few for intervals; test on more of them: --split 'by-point 50/10/40'"
            ),
            Note::Extended {
                recording,
                added,
                extension,
            } => write!(
                f,
                "{}{added} samples were added to {} on {} from {}; each sample before kept its part",
                of(recording),
                extension.rows,
                extension.date,
                shown(&extension.from)
            ),
            Note::Reduced { recording, frames } => {
                write!(f, "{}frames were kept as {}", of(recording), frames.info)?;
                match &frames.reduced {
                    Some(reduced) => write!(f, ": {}, of {}", shown(&reduced.by), reduced.from),
                    None => Ok(()),
                }
            }
            Note::View {
                recording,
                view,
                of: all,
            } => write!(
                f,
                "{}each sample has several pictures ({}); the model sees those of {}{}",
                of(recording),
                shown(all),
                shown(view),
                if view.contains('+') { ", side by side" } else { "" }
            ),
            Note::Imported { recording, words } => {
                write!(f, "{}import: {}", of(recording), shown(words))
            }
            Note::Rotation {
                channels,
                samples,
                mean,
                most,
            } => write!(
                f,
                "rotation {}: mean angle between predictions and truth {mean:.2} degrees over {samples} samples, 95 % below {most:.2}; \
                 scores of single components depend on how the rotation is written",
                channels.join(", ")
            ),
            Note::Seen(part) => write!(
                f,
                "scored on the part `{part}`, which the model was fitted on: this is not a test"
            ),
            Note::FittedElsewhere(digest) => write!(
                f,
                "every sample is scored, because the model was fitted on other data, {digest}; samples that are in both, as after an \
                 export or a second import, are not detected"
            ),
            Note::Copies { copies, of } => write!(
                f,
                "{copies} of {of} pictures of the test part are byte for byte in the fit too: {OPTIMISTIC} (taceva check, \
                 TAC002 and TAC007)"
            ),
            Note::FittedBefore { rows, now } => write!(
                f,
                "the model was fitted when the dataset had {rows} of its {now} samples; the parts are those of the dataset as it is now"
            ),
            Note::LeftOut { part, count } => write!(
                f,
                "{count} samples of the part {part} lack a label or a frame and were left out"
            ),
            Note::Bounded(shares) => {
                let shares: Vec<String> = shares
                    .iter()
                    .map(|(channel, share)| format!("{channel} {:.1} %", 100.0 * share))
                    .collect();
                write!(
                    f,
                    "shares of all predictions outside the bounds of the model (the range of labels, extended by a quarter on each side): \
                     {}; a score marked `bounded` gives the share among its own samples; robustness uses predictions as they are, every \
                     other score uses clipped predictions",
                    shares.join(", ")
                )
            }
            Note::Calibration(channels) => {
                let shares: Vec<String> = channels.iter().map(ToString::to_string).collect();
                write!(
                    f,
                    "share of samples within 1.96 predicted standard deviations of the truth: {}; calibrated deviations give 95 %",
                    shares.join(", ")
                )
            }
            Note::Chosen { fold: None, choice } => f.write_str(choice),
            Note::Chosen {
                fold: Some(fold),
                choice,
            } => write!(f, "without {fold}: {choice}"),
            Note::EveryRow { metrics, rows } => write!(
                f,
                "no predictions are used for {}: computed over all {rows} samples, of every part",
                metrics.join(", ")
            ),
            Note::CallersModel(learning) => f.write_str(match learning {
                Learning::Here => {
                    "the model is the caller's own, fitted here on the training part only"
                }
                Learning::Stated => {
                    "the model is the caller's own; the caller states that it was fitted on the training part of this split only"
                }
                Learning::Unknown => {
                    "the model is the caller's own; its training data are unknown and may include these samples"
                }
            }),
            Note::Unbounded => f.write_str(
                "predictions were not clipped to the bounds of the training labels, as those of other models are",
            ),
            Note::States(count) => write!(f, "{count} states merged"),
            Note::Shards([own, all]) => write!(
                f,
                "{own} of {all} rows: the others are in shards that were not merged"
            ),
            Note::Shard {
                shard,
                rows: [first, end],
                of,
            } => write!(f, "shard {shard}: rows {first} (from 0) up to but excluding {end}, of {of}"),
            Note::Paired(by) => write!(f, "rows were paired {by}"),
            Note::SameBytes => f.write_str(
                "truth and predictions are byte-identical files: every error is 0, which no sensor reaches",
            ),
            Note::NotPlanned { what, reason } => write!(f, "{what}: {reason}"),
            Note::Untaken { count, of } => write!(
                f,
                "{count} of {of} planned samples were not recorded: their presses reached a limit of the gel, or missed it"
            ),
            Note::MeasuredUnit { unit, metrics, of } => write!(
                f,
                "every score is for unit {}, except {} for units {}",
                shown(unit),
                metrics.join(", "),
                shown(&of.join(", "))
            ),
            Note::DetectionLimit => f.write_str(
                "detection limit: not verified; noise_equivalent_force uses untouched frames only; light presses at many places would \
                 verify a limit",
            ),
            Note::Spacings(way) => f.write_str(way),
            Note::FramesRetried(count) => write!(
                f,
                "{count} frames were lost, damaged or older than their contact, and were recorded again"
            ),
        }
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

/// The name of a recording, as the prefix of a note on it.
fn of(recording: &Option<String>) -> String {
    recording
        .as_ref()
        .map_or_else(String::new, |name| format!("{name}: "))
}

fn clusters(
    recordings: usize,
    points: usize,
    least: usize,
    f: &mut fmt::Formatter<'_>,
) -> fmt::Result {
    if recordings < least {
        return write!(
            f,
            "scored on {points} contact points of {recordings} recordings; intervals by contact point do not show how scores vary between \
             recordings; that takes {least} recordings with scored samples"
        );
    }
    write!(
        f,
        "intervals of errors, R² and skill are by recording ({recordings} recordings with {points} contact points): they show how scores \
         vary between recordings"
    )?;
    if recordings < CLUSTERS_MANY {
        write!(
            f,
            "; {recordings} are few: one more recording may change an interval much, since it has only {} degrees of freedom",
            recordings - 1
        )?;
    }
    Ok(())
}

#[cfg(test)]
mod tests;
