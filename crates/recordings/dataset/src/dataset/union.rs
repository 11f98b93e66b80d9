//! Several recordings of the same kind of sensor as one dataset: one table of labels, with frames and signals in the original files.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::ops::Range;
use std::path::Path;

use taceva_core::{Channels, Clock, Traceability, counted};

use super::Dataset;
use crate::digest::{Digest, PartsDigest};
use crate::error::DatasetError;
use crate::header::{Header, Leds};
use crate::table::{FrameEntry, RowNames, Table};
use crate::task::Task;
use crate::text::shown;

mod agreement;
mod shared_tasks;

use agreement::differences;
pub use agreement::{Difference, differences_of_added};
use shared_tasks::shared_tasks;

/// Separator between the name of a recording and the name of a sample, contact point or frame. No name of a recording contains this character.
pub(super) const SEPARATOR: char = '/';

/// Recording that is part of a dataset from [`Dataset::joined`].
///
/// ```
/// # use taceva_core::{Channel, Channels, Clock, Readings, Sample};
/// # use taceva_dataset::{Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
/// # let folder = tempfile::tempdir()?;
/// # let record = |name: &str, force: f64| -> Result<std::path::PathBuf, Box<dyn std::error::Error>> {
/// #     let path = folder.path().join(name);
/// #     let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("my gel"));
/// #     let mut recorder = Recorder::create(&path, &RecordingSpec::new(facts, Channels::new([Channel::FZ])?))?;
/// #     recorder.append(&Sample::new("1").with_truth(Readings::from_values([force])))?;
/// #     recorder.close()?;
/// #     Ok(path)
/// # };
/// use taceva_dataset::Dataset;
///
/// let (monday, tuesday) = (record("monday", 0.5)?, record("tuesday", 0.75)?);
/// let both = Dataset::joined(vec![Dataset::open(&monday)?, Dataset::open(&tuesday)?])?;
/// let second = &both.recordings()[1];
/// assert_eq!((second.name(), second.rows()), ("tuesday", 1..2));
/// assert_eq!(both.table().samples(), ["monday/1", "tuesday/1"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct JoinedRecording {
    name: String,
    rows: Range<usize>,
    dataset: Box<Dataset>,
}

impl JoinedRecording {
    /// Folder name. A second folder with the same name becomes `NAME#2`.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Rows of the recording in the joined table, from 0.
    pub fn rows(&self) -> Range<usize> {
        self.rows.clone()
    }

    /// The recording as a separate dataset, with rows from 0.
    pub fn dataset(&self) -> &Dataset {
        &self.dataset
    }
}

impl Dataset {
    /// Joins `recordings` in their order. A single recording is returned unchanged.
    ///
    /// Names of samples and contact points get the name of their recording as prefix (`monday/p3`), so that equal names of different recordings remain
    /// distinct. Frames and signals are read from the original files; only labels are copied. The digest of the result is computed from the digests of the
    /// recordings, in their order. Gel, serial number, camera settings, attributes, pictures without contact and clocks may differ between recordings.
    ///
    /// # Errors
    /// [`DatasetError::Unlike`] for recordings that share samples, or that differ in source, sensor model, opacity, footprint, channels, units, kind or size
    /// of frames or signals, or the definition of a task. [`DatasetError::Request`] if `recordings` is empty.
    pub fn joined(recordings: Vec<Dataset>) -> Result<Dataset, DatasetError> {
        let mut recordings = recordings;
        if recordings.len() < 2 {
            return recordings.pop().ok_or_else(|| {
                DatasetError::request(
                    Path::new("."),
                    "no recording to join, expected at least one",
                )
            });
        }
        check_distinct(&recordings)?;
        for other in &recordings[1..] {
            check_alike(&recordings[0], other)?;
        }
        let tasks = shared_tasks(recordings.iter().map(|one| one.table.tasks()));
        let tasks = tasks.map_err(|found| {
            let [one, other] = found.recordings.map(|position| &recordings[position]);
            unlike(one, other, found.problem)
        })?;
        let names = names(recordings.iter().map(Dataset::path));
        let table = joined_table(&recordings, &names, tasks);
        let seen = recordings[0].seen.clone();
        let header = joined_header(&recordings, &table);
        let folder = recordings[0].folder.without_files();
        let mut start = 0;
        let joined = names.into_iter().zip(recordings).map(|(name, dataset)| {
            let rows = start..start + dataset.table.rows();
            start = rows.end;
            JoinedRecording {
                name,
                rows,
                dataset: Box::new(dataset),
            }
        });
        Ok(Dataset {
            joined: joined.collect(),
            seen,
            ..Dataset::of(folder, header, table)
        })
    }

    /// The joined recordings, in the order of their rows; empty for a single recording.
    pub fn recordings(&self) -> &[JoinedRecording] {
        &self.joined
    }

    /// Recording that contains `row`, and the row in that recording; `None` for a single recording.
    pub fn recording_of(&self, row: usize) -> Option<(&Dataset, usize)> {
        let at = self.joined.partition_point(|own| own.rows.end <= row);
        let own = self.joined.get(at)?;
        Some((&own.dataset, row - own.rows.start))
    }

    /// Recording that contains the frame at `entry`, and the entry in that recording.
    pub(super) fn entry_of(&self, entry: &FrameEntry) -> Option<(&Dataset, FrameEntry)> {
        let (name, path) = entry.path.split_once(SEPARATOR)?;
        let own = self.joined.iter().find(|own| own.name == name)?;
        let entry = FrameEntry {
            path: path.to_owned(),
            ..entry.clone()
        };
        Some((&own.dataset, entry))
    }
}

/// Rejects a recording that occurs twice: with the same path, with the same content, or once in a state before rows were added.
fn check_distinct(recordings: &[Dataset]) -> Result<(), DatasetError> {
    let place = |dataset: &Dataset| dataset.path().canonicalize().ok();
    for (at, other) in recordings.iter().enumerate() {
        for one in &recordings[..at] {
            let is_same_place = place(one).is_some() && place(one) == place(other);
            let shared = one.header.stages().find(|stage| {
                let mut theirs = other.header.stages();
                theirs.any(|other| other == *stage)
            });
            let problem = match shared {
                _ if is_same_place => "both paths name one folder".to_owned(),
                Some((digest, rows)) => {
                    format!("both have the same {} ({digest})", counted(rows, "sample"))
                }
                None => continue,
            };
            return Err(unlike(one, other, format!("{problem}; name it once")));
        }
    }
    check_no_overlap(recordings)
}

/// Digest of a frame, and its labels by channel name, bit for bit.
type Shared = (Digest, Vec<Option<u64>>);

/// Minimum number of shared pictures with different labels for an overlap of two recordings. No camera takes the same picture twice.
const SAME_PICTURES: usize = 3;

/// Rejects recordings that share a sample: equal frame bytes and labels, or at least [`SAME_PICTURES`] pictures under other labels, as in two imports of one
/// recording. A shared sample could be in both the training and the test part.
fn check_no_overlap(recordings: &[Dataset]) -> Result<(), DatasetError> {
    let mut known: HashMap<Shared, (usize, usize)> = HashMap::new();
    let mut pictures: HashMap<Digest, (usize, usize)> = HashMap::new();
    let mut shared: BTreeMap<(usize, usize), BTreeSet<Digest>> = BTreeMap::new();
    for (at, recording) in recordings.iter().enumerate() {
        let table = &recording.table;
        let mut channels: Vec<usize> = (0..table.channels().len()).collect();
        channels.sort_by_key(|channel| table.channels().as_slice()[*channel].name());
        for (row, frame) in table.frames().iter().enumerate() {
            let Some(frame) = frame else { continue };
            let labels = channels.iter().map(|channel| {
                let label = table.truth(*channel).get(row);
                label.map(f64::to_bits)
            });
            let place = *known
                .entry((frame.digest, labels.collect()))
                .or_insert((at, row));
            let same = |place: (usize, usize), problem: &str| {
                let problem = format!(
                    "sample `{}` of the first recording and sample `{}` of the second have {problem}: a model could learn one and be tested on the other",
                    shown(&recordings[place.0].table.samples()[place.1]),
                    shown(&table.samples()[row])
                );
                unlike(&recordings[place.0], recording, problem)
            };
            if place.0 != at {
                return Err(same(place, "the same frame and labels"));
            }
            let place = *pictures.entry(frame.digest).or_insert((at, row));
            if place.0 != at {
                let shared = shared.entry((place.0, at)).or_default();
                shared.insert(frame.digest);
                if shared.len() == SAME_PICTURES {
                    return Err(same(
                        place,
                        "the same picture with other labels, and the recordings share more pictures, as two imports of one recording do",
                    ));
                }
            }
        }
    }
    Ok(())
}

fn check_alike(one: &Dataset, other: &Dataset) -> Result<(), DatasetError> {
    match differences(&one.header, &other.header).next() {
        None => Ok(()),
        Some(Difference {
            key,
            own,
            other: found,
        }) => Err(unlike(
            one,
            other,
            format!(
                "`{key}` is {own} in the first recording and {found} in the second; evaluate them separately"
            ),
        )),
    }
}

fn unlike(one: &Dataset, other: &Dataset, problem: String) -> DatasetError {
    DatasetError::Unlike {
        one: one.path().to_owned(),
        other: other.path().to_owned(),
        problem,
    }
}

/// Names of the folders at `paths`, with a number appended if not unique.
fn names<'a>(paths: impl Iterator<Item = &'a Path>) -> Vec<String> {
    let mut taken: Vec<String> = Vec::new();
    for path in paths {
        let whole = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let own = whole.file_name().unwrap_or(whole.as_os_str());
        let own = own.to_string_lossy().replace(SEPARATOR, "_");
        let numbered = (2..).map(|number| format!("{own}#{number}"));
        let free = std::iter::once(own.clone()).chain(numbered);
        let mut free = free.filter(|name| !taken.contains(name));
        taken.push(free.next().expect("the range of numbers is unlimited"));
    }
    taken
}

/// Labels of all recordings. Names of samples, contact points and frames get the recording as prefix.
fn joined_table(recordings: &[Dataset], names: &[String], tasks: Vec<Task>) -> Table {
    let attributes = recordings
        .iter()
        .flat_map(|one| one.table.attribute_names());
    let mut seen = BTreeSet::new();
    let attributes = attributes
        .filter(|name| seen.insert(name.as_str()))
        .cloned();
    let channels: &Channels = recordings[0].table.channels();
    let mut table = Table::new(channels.clone(), attributes.collect()).with_tasks(tasks);
    for (name, recording) in names.iter().zip(recordings) {
        let own = &recording.table;
        let called = |text: &str| format!("{name}{SEPARATOR}{text}");
        for row in 0..own.rows() {
            let frame = own.frames()[row].as_ref();
            let names = RowNames {
                sample: called(&own.samples()[row]),
                point_id: own.point_id()[row].as_deref().map(called),
                frame: frame.map(|entry| FrameEntry {
                    path: called(&entry.path),
                    ..entry.clone()
                }),
            };
            table.push_of(own, row, names);
        }
    }
    table
}

/// Header of the joined dataset. If the recordings differ, clock and presses are unknown, and serial number and gel are `several`.
fn joined_header(recordings: &[Dataset], table: &Table) -> Header {
    let mut digest = PartsDigest::default();
    digest.part(b"taceva.dataset/1 of several recordings");
    let mut header = recordings[0].header.clone();
    for other in recordings {
        digest.fixed(other.header.digest.as_bytes());
    }
    for (position, other) in recordings.iter().enumerate().skip(1) {
        let other = &other.header;
        header.format = header.format.max(other.format);
        if header.clock != other.clock {
            header.clock = Clock::Unknown;
        }
        let last = |of: &Header| of.recorded_until.max(of.recorded_on);
        let until = last(&header).max(last(other));
        let begun = [header.recorded_on, other.recorded_on];
        header.recorded_on = begun.into_iter().flatten().min();
        header.recorded_until = until.filter(|_| until != header.recorded_on);
        for (own, theirs) in [
            (&mut header.sensor.serial, &other.sensor.serial),
            (&mut header.sensor.gel, &other.sensor.gel),
        ] {
            if own != theirs {
                *own = "several".to_owned();
            }
        }
        if header.sensor.presses_since_gel != other.sensor.presses_since_gel {
            header.sensor.presses_since_gel = None;
        }
        if header.sensor.leds != other.sensor.leds {
            header.sensor.leds = Leds::default();
        }
        header
            .settings
            .retain(|name, value| other.settings.get(name) == Some(value));
        header.traceability = Traceability::joined(&header.traceability, &other.traceability);
        for (outcome, count) in &other.presses {
            *header.presses.entry(*outcome).or_default() += count;
        }
        for warning in &other.warnings {
            if !header.warnings.contains(warning) {
                header.warnings.push(warning.clone());
            }
        }
        if let (Some(own), Some(theirs)) = (&mut header.frames, &other.frames) {
            own.count += theirs.count;
            if theirs.reference.is_none() {
                own.reference = None;
            }
        }
        if let (Some(own), Some(theirs)) = (&mut header.signals, &other.signals) {
            let before: usize = recordings[..position]
                .iter()
                .map(|one| one.table.rows())
                .sum();
            let runs = theirs.spec.rest.iter();
            own.spec
                .rest
                .extend(runs.map(|run| run.map(|row| row + before as u64)));
        }
    }
    header.attributes = table.attribute_names().to_vec();
    header.tasks = table.tasks().iter().map(|own| own.task().clone()).collect();
    header.unmentioned_columns.clear();
    header.stream = None;
    header.predictions = None;
    header.extended.clear();
    header.digest = digest.finish();
    header.table.rows = table.rows() as u64;
    header.table.digest = header.digest;
    header.table.sha256 = header.digest;
    header.sources = None;
    header
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_of_one_name_are_numbered_and_no_name_holds_the_separator() {
        let paths = ["a/press", "b/press", "press#2", "c/press"].map(Path::new);
        let found = names(paths.into_iter());
        assert_eq!(found, ["press", "press#2", "press#2#2", "press#3"]);
        assert!(found.iter().all(|name| !name.contains(SEPARATOR)));
    }
}
