//! Sentence of each note for the reader of scores.

use std::fmt;

use taceva_core::{Channel, Unit, by_count, counted, shown};
use taceva_results::OPTIMISTIC;

use super::{Independence, Learning, Note, division};

/// Minimum number of recordings for which the note omits their number. With fewer recordings, Student's t widens the interval.
const CLUSTERS_MANY: usize = 10;

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Note::Split(words) | Note::Sessions(words) => f.write_str(words),
            Note::Neighbours { found, division } => division::write(found, division, f),
            Note::Independent(Independence::Stated) => f.write_str(
                "the caller declared the samples independent, so each counts as one contact point; intervals are too narrow if samples \
                 depend on each other",
            ),
            Note::Independent(Independence::Found { has_places }) => {
                f.write_str(
                    "each sample counts as one contact point, because neighbouring samples are dissimilar",
                )?;
                match has_places {
                    true => Ok(()),
                    false => f.write_str(
                        "; the recording names no places, so it is unknown if the tested places were seen in training: name them by \
                         point_id or Px, Py in the map",
                    ),
                }
            }
            Note::Clusters {
                recordings,
                points,
                least,
            } => clusters(*recordings, *points, *least, f),
            Note::Within(within) => write!(f, "{within}"),
            Note::FewClusters(few) => write!(f, "{few}"),
            Note::Extended {
                recording,
                added,
                extension,
            } => write!(
                f,
                "{}{} {} added to {} on {} from {}; earlier samples kept their parts",
                of(recording),
                counted(*added, "sample"),
                by_count(*added, "was", "were"),
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
                "{}each sample has several pictures ({}); the model sees the pictures of {}{}",
                of(recording),
                shown(all),
                shown(view),
                if view.contains('+') { ", side by side" } else { "" }
            ),
            Note::Imported { recording, words } => {
                write!(f, "{}import: {}", of(recording), shown(words))
            }
            Note::Device { recording, words } => {
                write!(f, "{}warning of a device: {}", of(recording), shown(words))
            }
            Note::DepthZeros {
                recording,
                median_mm,
                most_mm,
                without,
                of: all,
            } => {
                write!(
                    f,
                    "{}Pz counts from the surface of the gel, fitted for each press: standard uncertainty {median_mm:.3} mm (median), \
                     at most {most_mm:.3} mm",
                    of(recording)
                )?;
                match without {
                    0 => Ok(()),
                    without => write!(
                        f,
                        "; {without} of {all} samples count from the first reading in contact, with unknown uncertainty"
                    ),
                }
            }
            Note::Rotation {
                channels,
                samples,
                mean,
                most,
            } => write!(
                f,
                "rotation {}: mean angle between predictions and truth {mean:.2} degrees over {}, 95 % below {most:.2}; \
                 scores of single components depend on how the rotation is written",
                channels.join(", "),
                counted(*samples, "sample")
            ),
            Note::Seen(part) => write!(
                f,
                "scored on the part `{part}`, which the model was fitted on: these scores are not a test"
            ),
            Note::FittedElsewhere(digest) => write!(
                f,
                "every sample is scored, because the model was fitted on other data, {digest}; samples that are in both, as after an \
                 export or a second import, are not detected"
            ),
            Note::Copies { copies, of } => write!(
                f,
                "{copies} of {of} pictures of the test part are byte-identical to pictures of the fit: {OPTIMISTIC} (taceva check, \
                 TAC002 and TAC007)"
            ),
            Note::FittedBefore { rows, now } => write!(
                f,
                "the model was fitted when the dataset had {rows} of its {now} samples; the parts are those of the present dataset"
            ),
            Note::LeftOut { part, count } => write!(
                f,
                "{} of the part {part} {} a label or a frame and {} left out: see `taceva check` (TAC011)",
                counted(*count, "sample"),
                by_count(*count, "lacks", "lack"),
                by_count(*count, "was", "were")
            ),
            Note::Bounded(shares) => {
                let shares: Vec<String> = shares
                    .iter()
                    .map(|(channel, share)| format!("{channel} {:.1} %", 100.0 * share))
                    .collect();
                write!(
                    f,
                    "shares of all predictions outside the bounds of the model (the range of labels, extended by a quarter on each side): {}. A score marked `bounded` gives the share among its own samples. Robustness uses unclipped predictions, every other score uses clipped predictions",
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
            Note::Dominant { channel, sample } => write!(
                f,
                "{channel}: {sample}: look at the picture and the labels of this sample, then run `taceva check`"
            ),
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
                "predictions were scored unclipped; other models are clipped to the bounds of the training labels",
            ),
            Note::States(count) => write!(f, "{} merged", counted(*count, "state")),
            Note::Shards([own, all]) => write!(
                f,
                "{own} of {all} rows: other rows are in shards that were not merged"
            ),
            Note::Shard {
                shard,
                rows: [first, end],
                of,
            } => write!(f, "shard {shard}: rows {first} (from 0) up to but excluding {end}, of {of}"),
            Note::Paired(by) => write!(f, "rows were paired {by}"),
            Note::UnitOfOne(names) => unit_of_one(names, f),
            Note::LikelyRadians { channel, period } => write!(
                f,
                "{0}: all values lie within ±{1:.2}, as angles in radians do, but are scored as degrees with a period of {period}, because no \
                 unit is stated; give --periods {0}={2}pi for radians, or --units {0}=deg for degrees",
                shown(channel),
                f64::from(*period).to_radians(),
                f64::from(*period) / 180.0
            ),
            Note::LikelyUnit {
                channel,
                unit,
                is_small,
            } => write!(
                f,
                "{0}: predictions follow the truth at about {1} its size, as numbers in m and mm do; write the truth and the predictions of \
                 {0} in {2}",
                shown(channel),
                if *is_small { "a thousandth of" } else { "a thousand times" },
                if *unit == Unit::One { "one unit" } else { unit.symbol() }
            ),
            Note::SameBytes => f.write_str(
                "truth and predictions are byte-identical files: every error is 0, which no sensor reaches",
            ),
            Note::NotPlanned { what, reason } => write!(f, "{what}: {reason}"),
            Note::Untaken { count, of } => write!(
                f,
                "{count} of {of} planned samples were not recorded: their presses reached a limit of the gel, or missed the gel"
            ),
            Note::MeasuredUnit { unit, metrics, of } => write!(
                f,
                "every score is for unit {}, except {} for units {}",
                shown(unit),
                metrics.join(", "),
                shown(&of.join(", "))
            ),
            Note::DetectionLimit(detection) => write!(f, "{detection}"),
            Note::Spacings(way) => f.write_str(way),
            Note::FramesRetried(count) => write!(
                f,
                "{} {were} lost or damaged, and {were} recorded again",
                counted(*count, "frame"),
                were = by_count(*count, "was", "were")
            ),
            Note::FramesFrozen(count) => write!(
                f,
                "the camera froze: {} repeated the previous frame although the force changed, {} aborted and repeated",
                counted(*count, "frame"),
                by_count(*count, "and its press was", "and their presses were")
            ),
        }
    }
}

/// Prefix of a note on one recording: its name and a colon; empty without a name.
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
            "scored on {} of {}. Intervals by contact point do not show how scores vary between recordings. Intervals by recording need {least} recordings with scored samples",
            counted(points, "contact point"),
            counted(recordings, "recording")
        );
    }
    write!(
        f,
        "intervals of errors, R² and skill are by recording ({} with {}): they show how scores \
         vary between recordings",
        counted(recordings, "recording"),
        counted(points, "contact point")
    )?;
    if recordings < CLUSTERS_MANY {
        write!(
            f,
            "; {recordings} are few: one more recording may change an interval much, since it has only {} of freedom",
            counted(recordings.saturating_sub(1), "degree")
        )?;
    }
    Ok(())
}

/// Writes columns of unit 1, each with a remedy. For instance, `Fz_N` may mean `Fz`.
fn unit_of_one(names: &[String], f: &mut fmt::Formatter<'_>) -> fmt::Result {
    for (at, name) in names.iter().enumerate() {
        let separator = if at == 0 { "" } else { "; " };
        let (start, unit) = name.split_once('_').unwrap_or((name.as_str(), ""));
        let mut six = Channel::SIX.into_iter();
        // `Fz_mN` is not `Fz` in N.
        let meant = six.find(|channel| {
            channel.name().eq_ignore_ascii_case(start)
                && (unit.is_empty() || unit == channel.unit().symbol())
        });
        let name = shown(name);
        write!(
            f,
            "{separator}{name}: not one of Px Py Pz Fx Fy Fz; scored as a channel with the unit 1; "
        )?;
        match meant {
            Some(channel) => write!(
                f,
                "rename it {}, or give --units {name}={}",
                channel.name(),
                channel.unit().symbol()
            )?,
            None => write!(f, "to state its unit, give --units {name}=UNIT")?,
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_of_a_thing_is_counted_as_one() {
        let left_out = |count| Note::LeftOut {
            part: "test".to_owned(),
            count,
        };
        for (note, said) in [
            (
                Note::FramesRetried(1),
                "1 frame was lost or damaged, and was recorded again",
            ),
            (
                Note::FramesRetried(2),
                "2 frames were lost or damaged, and were recorded again",
            ),
            (
                Note::FramesFrozen(1),
                "the camera froze: 1 frame repeated the previous frame although the force changed, and its press was aborted and repeated",
            ),
            (
                left_out(1),
                "1 sample of the part test lacks a label or a frame and was left out: see `taceva check` (TAC011)",
            ),
            (
                left_out(9),
                "9 samples of the part test lack a label or a frame and were left out: see `taceva check` (TAC011)",
            ),
            (Note::States(1), "1 state merged"),
        ] {
            assert_eq!(note.to_string(), said);
        }
    }
}
