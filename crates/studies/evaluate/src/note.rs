//! Notes on the samples and the model behind scores: data here, sentences in a report.

mod division;

use std::fmt;

use taceva_core::shown;
use taceva_dataset::{Extension, FramesInfo};

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
                "each sample is taken as a point of its own, by the word of the caller: intervals are too narrow if samples depend on each other",
            ),
            Note::Independent(Independence::Found) => f.write_str(
                "each sample is taken as a point of its own: no point_id repeats, and neighbouring samples do not resemble each other",
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
                "{}each sample has several pictures ({}), and those of {} are seen{}",
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
                "rotation {}: predictions are turned from the truth by {mean:.2} degrees in the mean of {samples} samples, 95 % by less than {most:.2}; scores of \
                 single parts depend on how the rotation is written",
                channels.join(", ")
            ),
            Note::Seen(part) => write!(
                f,
                "scored on the part `{part}`, which the model has seen: this is no test"
            ),
            Note::FittedElsewhere(digest) => write!(
                f,
                "every sample is scored, because the model was fitted on other data, {digest}; samples that both hold, as an export or a second import of one recording does, are not distinguished"
            ),
            Note::Copies { copies, of } => write!(
                f,
                "{copies} of {of} pictures of the test part are, byte for byte, also fitted on: the scores flatter (taceva check, TAC002 and TAC007)"
            ),
            Note::FittedBefore { rows, now } => write!(
                f,
                "the model was fitted when the dataset had {rows} of its {now} samples; the parts are those of now"
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
                    "of the predictions of all samples together, these shares lie beyond the bounds of the model, a quarter of the range of labels \
                     on either side: {}; a score marked `bounded` gives the share among its own samples; robustness is of predictions as \
                     they are, every other score of those brought back",
                    shares.join(", ")
                )
            }
            Note::Calibration(channels) => {
                let shares: Vec<String> = channels.iter().map(ToString::to_string).collect();
                write!(
                    f,
                    "within 1.96 predicted standard deviations of the truth lie {}; 95 % would if the deviations were calibrated",
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
                "no prediction enters {}: all {rows} samples count there, in every part",
                metrics.join(", ")
            ),
            Note::CallersModel(learning) => f.write_str(match learning {
                Learning::Here => {
                    "the model is one that the caller holds, fitted here on the training part alone"
                }
                Learning::Stated => {
                    "the model is one that the caller holds; that it has learnt from the training part of this split alone is the caller's word"
                }
                Learning::Unknown => {
                    "the model is one that the caller holds; what it has learnt from is not known, so these samples may be among it"
                }
            }),
            Note::Unbounded => f.write_str(
                "predictions were not brought within the bounds of the labels that were learnt, as those of other models are",
            ),
            Note::States(count) => write!(f, "{count} states joined"),
            Note::Shards([own, all]) => write!(
                f,
                "{own} of {all} rows: the others are in no shard that was joined"
            ),
            Note::Shard {
                shard,
                rows: [first, end],
                of,
            } => write!(f, "shard {shard}: rows {first} to before {end} of {of}, from 0"),
            Note::Paired(by) => write!(f, "rows were paired {by}"),
            Note::SameBytes => f.write_str(
                "truth and predictions are the same bytes: every error is 0, which no sensor reaches",
            ),
            Note::NotPlanned { what, reason } => write!(f, "{what}: {reason}"),
            Note::Untaken { count, of } => write!(
                f,
                "{count} of {of} planned samples were not taken: their presses met a limit of the gel, or no gel"
            ),
            Note::MeasuredUnit { unit, metrics, of } => write!(
                f,
                "every score is of unit {}, but {} of units {}",
                shown(unit),
                metrics.join(", "),
                shown(&of.join(", "))
            ),
            Note::DetectionLimit => f.write_str(
                "detection limit: not verified; noise_equivalent_force is of untouched frames alone, and only light presses at many places verify a limit",
            ),
            Note::Spacings(way) => f.write_str(way),
            Note::FramesRetried(count) => write!(
                f,
                "{count} frames were lost, damaged or older than their contact, and were taken again"
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
            PairedBy::Order => {
                f.write_str("by order, because no key of rows stands in both tables")
            }
            PairedBy::Index => f.write_str("by the index of both data frames"),
            PairedBy::ChosenOrder => f.write_str("by order, as was asked for"),
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
            "scored on {points} contact points of {recordings} recordings; an interval by contact point within these recordings does not say \
             how scores vary from recording to recording, which takes {least} recordings with scored samples"
        );
    }
    write!(
        f,
        "intervals of errors, R² and skill are by recording, {recordings} of them with {points} contact points: they say how scores vary from \
         recording to recording"
    )?;
    if recordings < CLUSTERS_MANY {
        write!(
            f,
            "; {recordings} are few: one recording more or less may change an interval much, and it is as wide as {} degrees of freedom make it",
            recordings - 1
        )?;
    }
    Ok(())
}

#[cfg(test)]
mod tests;
