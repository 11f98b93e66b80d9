//! Several recordings joined as one: the recording of each row, the rows that a model has seen, and intervals across recordings.

mod joins;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use taceva_core::{Labels, shown};
use taceva_dataset::{Dataset, Header};
use taceva_metrics::LEAST_CLUSTERS;
use taceva_models::Model;
use taceva_results::RecordingProvenance;

use crate::error::EvaluateError;
use crate::note::Note;
use crate::row_ledger::Taken;

/// Provenance of each recording that was joined into `dataset`; empty for a single recording.
pub(crate) fn provenance(dataset: &Dataset) -> Vec<RecordingProvenance> {
    let joined = dataset.recordings().iter();
    joined
        .map(|own| RecordingProvenance {
            name: own.name().to_owned(),
            digest: own.dataset().digest().to_string(),
            samples: own.rows().len(),
        })
        .collect()
}

/// Paths of all joined recordings, or of the single recording.
pub(crate) fn paths(dataset: &Dataset) -> Vec<PathBuf> {
    match dataset.recordings() {
        [] => vec![dataset.path().to_owned()],
        joined => {
            let paths = joined.iter().map(|own| own.dataset().path());
            paths.map(Path::to_owned).collect()
        }
    }
}

/// Name of the recording of each of `rows`; `None` for a single recording.
pub(crate) fn names(dataset: &Dataset, rows: &[usize]) -> Option<Vec<String>> {
    let joined = dataset.recordings();
    let name = |row: &usize| joined[at(dataset, *row)].name().to_owned();
    (!joined.is_empty()).then(|| rows.iter().map(name).collect())
}

/// Digest of the recording of each of `rows`, to name the clusters of intervals. Digests are the same in every shard, even if folder names differ.
pub(crate) fn labels(dataset: &Dataset, rows: impl Iterator<Item = usize>) -> Labels {
    let joined = dataset.recordings();
    let digests = joined.iter().map(|own| own.dataset().digest().to_string());
    let digests: Vec<String> = digests.collect();
    let mut labels = Labels::default();
    rows.for_each(|row| labels.push(&digests[at(dataset, row)]));
    labels
}

/// Index of the joined recording that contains `row`.
fn at(dataset: &Dataset, row: usize) -> usize {
    let joined = dataset.recordings();
    joined.partition_point(|own| own.rows().end <= row)
}

/// Indices into the ascending `rows` at which a recording or added rows begin, except the first index.
pub(crate) fn sections(dataset: &Dataset, rows: &[usize]) -> Vec<usize> {
    let mut starts = BTreeSet::new();
    let mut add = |recording: &Dataset, first: usize| {
        starts.insert(first);
        let extended = recording.header().extended.iter();
        let added = extended.filter_map(|before| usize::try_from(before.rows).ok());
        starts.extend(added.map(|row| first + row));
    };
    match dataset.recordings() {
        [] => add(dataset, 0),
        joined => joined
            .iter()
            .for_each(|own| add(own.dataset(), own.rows().start)),
    }
    let positions = starts
        .into_iter()
        .map(|start| rows.partition_point(|row| *row < start));
    let positions: BTreeSet<usize> = positions
        .filter(|position| (1..rows.len()).contains(position))
        .collect();
    positions.into_iter().collect()
}

/// Splits `rows` where the recording changes, in order. Each piece has its recording and the row numbers within this recording.
pub(crate) fn runs<'a>(dataset: &'a Dataset, rows: &[usize]) -> Vec<(&'a Dataset, Vec<usize>)> {
    if dataset.recordings().is_empty() {
        return vec![(dataset, rows.to_vec())];
    }
    let joined = dataset.recordings();
    let chunks = rows.chunk_by(|one, next| at(dataset, *one) == at(dataset, *next));
    let run = |chunk: &[usize]| {
        let own = &joined[at(dataset, chunk[0])];
        let start = own.rows().start;
        (own.dataset(), chunk.iter().map(|row| row - start).collect())
    };
    chunks.map(run).collect()
}

/// Records `rows` under the digest of the version of the recording that first contained them. Added rows have the digest of the extended recording, and earlier
/// rows the digest before the extension.
pub(crate) fn taken(dataset: &Dataset, rows: &[usize]) -> Vec<Taken> {
    let mut taken = Vec::new();
    for (recording, own) in runs(dataset, rows) {
        let mut before = 0;
        for (digest, end) in recording.header().stages() {
            let end = usize::try_from(end).unwrap_or(usize::MAX);
            let of_stage = own
                .iter()
                .copied()
                .filter(|row| (before..end).contains(row));
            let of_stage: Vec<usize> = of_stage.collect();
            if !of_stage.is_empty() {
                taken.push(Taken::rows_of(digest.to_string(), &of_stage));
            }
            before = end;
        }
    }
    taken
}

/// Notes on rows that were added to recordings after their import.
pub(crate) fn extended(dataset: &Dataset) -> Vec<Note> {
    let of = |recording: &Dataset, name: Option<&str>| -> Vec<Note> {
        let mut stages = recording.header().stages().skip(1);
        let extended = recording.header().extended.iter();
        let notes = extended.filter_map(|extension| {
            let (_, rows) = stages.next()?;
            Some(Note::Extended {
                recording: name.map(str::to_owned),
                added: rows.saturating_sub(extension.rows),
                extension: extension.clone(),
            })
        });
        notes.collect()
    };
    of_each(dataset, of)
}

/// Notes on imports: warnings, the zero and gravity subtracted from labels, and joined tables.
pub(crate) fn imported(dataset: &Dataset) -> Vec<Note> {
    of_each(dataset, |recording, name| {
        let header = recording.header();
        let taken = header.columns.iter().flat_map(|column| {
            let rules = [&column.zero, &column.gravity].into_iter().flatten();
            rules.map(|rule| format!("{} minus the {rule}", column.label))
        });
        let warnings = header.warnings.iter().filter(|_| is_imported(header));
        let words = warnings.cloned().chain(taken);
        let words = words.chain(joins::of(header));
        let notes = words.map(|words| Note::Imported {
            recording: name.map(str::to_owned),
            words,
        });
        notes.collect()
    })
}

/// Warnings of the devices that made recordings of a run or a capture.
pub fn device_warnings(dataset: &Dataset) -> Vec<Note> {
    of_each(dataset, |recording, name| {
        let header = recording.header();
        let warnings = header.warnings.iter().filter(|_| !is_imported(header));
        let notes = warnings.map(|words| Note::Device {
            recording: name.map(str::to_owned),
            words: words.clone(),
        });
        notes.collect()
    })
}

/// True if an import made the recording.
fn is_imported(header: &Header) -> bool {
    header.sources.is_some()
}

/// Notes on recordings whose frames were reduced before storage.
pub fn reduced(dataset: &Dataset) -> Vec<Note> {
    of_each(dataset, |recording, name| {
        let frames = recording.header().frames.as_ref();
        let reduced = frames.filter(|frames| frames.reduced.is_some());
        let note = reduced.map(|frames| Note::Reduced {
            recording: name.map(str::to_owned),
            frames: frames.clone(),
        });
        note.into_iter().collect()
    })
}

/// Notes on the uncertainty of the heights relative to which depths are measured, for recordings whose depths refer to a fitted surface.
pub fn depth_zeros(dataset: &Dataset) -> Vec<Note> {
    of_each(dataset, |recording, name| {
        depth_zero(recording, name).into_iter().collect()
    })
}

fn depth_zero(recording: &Dataset, name: Option<&str>) -> Option<Note> {
    let table = recording.table();
    let depths = table.truth(table.channels().position("Pz")?);
    let with_depth = (0..table.rows()).filter(|row| depths.get(*row).is_some());
    let deviations: Vec<Option<f64>> = with_depth.map(|row| table.zero_u_mm()[row]).collect();
    let mut stated: Vec<f64> = deviations.iter().copied().flatten().collect();
    stated.sort_by(f64::total_cmp);
    Some(Note::DepthZeros {
        recording: name.map(str::to_owned),
        median_mm: *stated.get(stated.len() / 2)?,
        most_mm: *stated.last()?,
        without: deviations.len() - stated.len(),
        of: deviations.len(),
    })
}

/// Notes on the view that was used, for recordings whose samples have several pictures.
pub(crate) fn viewed(dataset: &Dataset) -> Vec<Note> {
    of_each(dataset, |recording, name| {
        let note = recording.view().map(|view| Note::View {
            recording: name.map(str::to_owned),
            view,
            of: recording.views().join(", "),
        });
        note.into_iter().collect()
    })
}

/// Notes on each recording. If there are several, the notes name the recording.
fn of_each(dataset: &Dataset, of: impl Fn(&Dataset, Option<&str>) -> Vec<Note>) -> Vec<Note> {
    match dataset.recordings() {
        [] => of(dataset, None),
        joined => {
            let joined = joined.iter();
            joined
                .flat_map(|own| of(own.dataset(), Some(own.name())))
                .collect()
        }
    }
}

/// True if `model` was fitted on `dataset`: on each of its recordings, or before rows were added.
///
/// # Errors
/// [`EvaluateError::Request`] if the model was fitted on only some of the recordings, because the unseen samples are then unknown.
pub(crate) fn is_fitted_on(model: &Model, dataset: &Dataset) -> Result<bool, EvaluateError> {
    let provenance = &model.card().provenance;
    let fitted_on: Vec<&str> = match &provenance.recordings[..] {
        [] => provenance.data.iter().map(String::as_str).collect(),
        recordings => recordings.iter().map(String::as_str).collect(),
    };
    let recordings: Vec<&Dataset> = match dataset.recordings() {
        [] => vec![dataset],
        joined => joined.iter().map(|own| own.dataset()).collect(),
    };
    let was = |recording: &Dataset, digest: &str| {
        let mut stages = recording.header().stages();
        stages.any(|(stage, _)| stage.to_string() == digest)
    };
    if fitted_on.len() == recordings.len() {
        let mut pairs = recordings.iter().zip(&fitted_on);
        if pairs.all(|(recording, digest)| was(recording, digest)) {
            return Ok(true);
        }
    }
    let seen = recordings
        .iter()
        .find(|recording| fitted_on.iter().any(|digest| was(recording, digest)));
    match seen {
        None => Ok(false),
        Some(seen) => Err(EvaluateError::Request(format!(
            "{}: the model was fitted on this recording and others, {} recordings together; score it on all these recordings in the \
             order of the fit, or on other recordings",
            shown(seen.path()),
            fitted_on.len()
        ))),
    }
}

/// Kind of clusters for intervals, for the scored rows of joined recordings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Clusters {
    recordings: usize,
    points: usize,
}

impl Clusters {
    /// Clusters of `rows`; `None` for a single recording.
    pub(crate) fn of(dataset: &Dataset, rows: &[usize]) -> Option<Clusters> {
        if dataset.recordings().is_empty() {
            return None;
        }
        let own: BTreeSet<usize> = rows.iter().map(|row| at(dataset, *row)).collect();
        let points = dataset.table().point_id();
        let points: BTreeSet<&str> = rows
            .iter()
            .filter_map(|row| points[*row].as_deref())
            .collect();
        Some(Clusters {
            recordings: own.len(),
            points: points.len(),
        })
    }

    /// True if there are enough recordings for intervals by recording.
    pub(crate) fn are_recordings(self) -> bool {
        self.recordings >= LEAST_CLUSTERS
    }

    /// Note on the clusters of the intervals.
    pub(crate) fn note(self) -> Note {
        Note::Clusters {
            recordings: self.recordings,
            points: self.points,
            least: LEAST_CLUSTERS,
        }
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::{Channel, Channels, Clock, PressOutcome, Readings, Sample};
    use taceva_dataset::{Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};

    use super::*;

    /// Test note on a recording of presses 1 mm deep, whose zeros have the standard uncertainties `zeros_u_mm`, in mm.
    fn note(channel: Channel, zeros_u_mm: &[Option<f64>]) -> Vec<Note> {
        pressed(channel, zeros_u_mm, depth_zeros)
    }

    /// Result of `act` on a recording of presses whose zeros have the standard uncertainties `zeros_u_mm`, in mm.
    fn pressed<T>(
        channel: Channel,
        zeros_u_mm: &[Option<f64>],
        act: impl FnOnce(&Dataset) -> T,
    ) -> T {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("pressed");
        let facts = RecordingFacts::new(
            Source::Synthetic,
            Clock::Monotonic,
            SensorFacts::new("a drawn gel"),
        );
        let spec = RecordingSpec::new(facts, Channels::new([channel]).expect("one"));
        let mut recorder = Recorder::create(&path, &spec).expect("new");
        let samples: Vec<Sample> = zeros_u_mm
            .iter()
            .enumerate()
            .map(|(number, zero_u_mm)| {
                Sample::new(format!("{number}"))
                    .with_truth(Readings::from_values([1.0]))
                    .with_zero_u_mm(*zero_u_mm)
            })
            .collect();
        let recorded = recorder.append_press("press", PressOutcome::Complete, &samples);
        recorded.expect("recorded");
        recorder.close().expect("closed");
        act(&Dataset::open(&path).expect("a dataset"))
    }

    #[test]
    fn samples_of_depths_state_the_uncertainty_of_their_zeros_if_any_is_fitted() {
        let zeros_u_mm = [Some(0.02), None, Some(0.004)];
        let column = |channel, zeros_u_mm: &[Option<f64>]| {
            pressed(channel, zeros_u_mm, |dataset| {
                let rows: Vec<usize> = (0..zeros_u_mm.len()).collect();
                let samples = crate::samples::of(dataset, &rows).expect("samples");
                let stated = rows.iter().map(|&row| samples.number("zero_u_mm", row));
                samples.has("zero_u_mm").then(|| stated.collect::<Vec<_>>())
            })
        };
        assert_eq!(column(Channel::PZ, &zeros_u_mm), Some(zeros_u_mm.to_vec()));
        assert_eq!(column(Channel::FZ, &zeros_u_mm), None);
        assert_eq!(column(Channel::PZ, &[None, None]), None);
    }

    #[test]
    fn fitted_zeros_are_noted_with_their_median_and_the_samples_without() {
        let expected = Note::DepthZeros {
            recording: None,
            median_mm: 0.005,
            most_mm: 0.02,
            without: 1,
            of: 4,
        };
        let found = note(Channel::PZ, &[Some(0.02), None, Some(0.004), Some(0.005)]);
        assert_eq!(found, [expected]);
    }

    #[test]
    fn without_fitted_zeros_or_depths_nothing_is_noted() {
        assert_eq!(note(Channel::PZ, &[None, None]), []);
        assert_eq!(note(Channel::FZ, &[Some(0.004)]), []);
    }
}
