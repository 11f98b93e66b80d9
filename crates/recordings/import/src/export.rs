//! A dataset for other programs: its table as CSV, or the whole in a form that they read, with the map that brings it back.

mod cells;
mod content;
mod csv;
mod form;
mod hdf5;
mod hugging_face;
mod lerobot;
mod map;
mod picture;

use std::io::{self, Write};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::Progress;

use taceva_dataset::internal::{
    Cells, column_kind, staging::Place, staging::StagedFolder, write_durable,
};
use taceva_dataset::{Dataset, DatasetError};

use content::Exported;
use picture::Pictures;

pub use form::ExportForm;

/// The map in the folder of an export.
const MAP: &str = "map.toml";

/// What was exported.
///
/// ```
/// # use taceva_core::{Channel, Channels, Clock, Readings, Sample};
/// # use taceva_dataset::{Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
/// # use taceva_import::{ExportForm, ExportPlan};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("recording");
/// # let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("my gel"));
/// # let mut recorder = Recorder::create(&path, &RecordingSpec::new(facts, Channels::new([Channel::FZ])?))?;
/// # recorder.append(&Sample::new("0").with_truth(Readings::from_values([0.5])))?;
/// # recorder.close()?;
/// let dataset = Dataset::open(&path)?;
/// let to = folder.path().join("exported");
/// let plan = ExportPlan::new(&dataset, ExportForm::Csv)?;
/// let report = plan.run(&to, std::num::NonZeroUsize::MIN, &taceva_core::SilentProgress)?;
/// assert_eq!((report.samples, report.pictures), (1, 0));
/// assert!(report.left_out.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ExportReport {
    /// How many samples there are.
    pub samples: u64,
    /// Number of pictures: of each view one for each sample.
    pub pictures: u64,
    /// How many pictures were encoded anew, so that their bytes are not those of the dataset; their pixels are the same.
    pub encoded_anew: u64,
    /// What the dataset says and the map of the export cannot, in words.
    pub left_out: Vec<String>,
    /// Whether the map beside it imports it again: not where some samples have a picture and others none.
    pub is_importable: bool,
    /// The map that brings the export back.
    pub map: PathBuf,
}

/// An export that can be made: the dataset has samples.
///
/// ```
/// # use taceva_core::{Channel, Channels, Clock, Readings, Sample};
/// # use taceva_dataset::{Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("recording");
/// # let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("my gel"));
/// # let mut recorder = Recorder::create(&path, &RecordingSpec::new(facts, Channels::new([Channel::FZ])?))?;
/// # recorder.append(&Sample::new("0").with_truth(Readings::from_values([0.5])))?;
/// # recorder.close()?;
/// use std::num::NonZeroUsize;
/// use taceva_core::SilentProgress;
/// use taceva_dataset::Dataset;
/// use taceva_import::{ExportForm, ExportPlan, ImportMap, ImportPlan};
///
/// let dataset = Dataset::open(&path)?;
/// let exported = folder.path().join("exported");
/// let plan = ExportPlan::new(&dataset, ExportForm::LeRobot)?;
/// let report = plan.run(&exported, NonZeroUsize::MIN, &SilentProgress)?;
///
/// let plan = ImportPlan::new(&exported, &ImportMap::read(&report.map)?)?;
/// let again = plan.run(&folder.path().join("again"), NonZeroUsize::MIN, &SilentProgress)?;
/// assert_eq!(again.digest, dataset.digest());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct ExportPlan<'a> {
    dataset: &'a Dataset,
    form: ExportForm,
}

impl<'a> ExportPlan<'a> {
    /// An export of `dataset` in `form`.
    ///
    /// # Errors
    /// [`DatasetError::Request`] if there is no sample.
    pub fn new(dataset: &'a Dataset, form: ExportForm) -> Result<ExportPlan<'a>, DatasetError> {
        match dataset.table().rows() {
            0 => Err(DatasetError::Request {
                path: dataset.path().to_owned(),
                problem: "no samples: there is nothing to export".to_owned(),
            }),
            _ => Ok(ExportPlan { dataset, form }),
        }
    }

    /// Writes the new folder `target` on `jobs` threads, and `map.toml` into it: an import of the folder by that map gives the samples, labels, times,
    /// signals and the origin of each row again, and pictures of the same pixels. The same dataset gives the same bytes, on any number of threads.
    ///
    /// # Units
    /// Each channel in the unit that the dataset keeps it in, which the map states.
    ///
    /// # Errors
    /// [`DatasetError::TargetExists`]; [`DatasetError::Sample`] if the form cannot hold one as it is; [`DatasetError::Image`] and
    /// [`DatasetError::Digest`] of a picture that is damaged; [`DatasetError::Cancelled`]; [`DatasetError::Io`]. After any of them `target` is absent.
    pub fn run(
        self,
        target: &Path,
        jobs: NonZeroUsize,
        progress: &dyn Progress,
    ) -> Result<ExportReport, DatasetError> {
        let ExportPlan { dataset, form } = self;
        let table = dataset.table();
        let mut columns = table.columns();
        // An import measures the brightness of each picture again; by which view the dataset is seen here is nothing that it says.
        columns.retain(|column| {
            let is_seen = column.name == "source_frame" && !table.views().is_empty();
            column_kind(column.name) != "intensity"
                && !is_seen
                && !matches!(column.cells, Cells::FramePath(_) | Cells::FrameDigest(_))
        });
        let views = dataset.views().into_iter();
        let views = views.map(|view| dataset.seen(view));
        let views: Vec<Dataset> = views.collect::<Result<_, _>>()?;
        let pictures: Vec<Pictures<'_>> = match views.is_empty() {
            true => Pictures::of(dataset, form).into_iter().collect(),
            false => {
                let views = views.iter();
                views.filter_map(|view| Pictures::of(view, form)).collect()
            }
        };
        let exported = Exported {
            dataset,
            columns,
            pictures,
            jobs,
            progress,
        };
        let staged = StagedFolder::create(target, Place::Free)?;
        progress.begin("export samples", Some(table.rows() as u64));
        let written = match form {
            ExportForm::Csv => csv::write(&exported, &staged),
            ExportForm::HuggingFace => hugging_face::write(&exported, &staged),
            ExportForm::Hdf5 => hdf5::write(&exported, &staged),
            ExportForm::LeRobot => lerobot::write(&exported, &staged),
        };
        progress.end();
        let (map, folders) = written?;
        let map = map::text(&exported, &map);
        write_durable(&staged.path().join(MAP), map.as_bytes())?;
        staged.put_in_place(&folders)?;
        let pictures = exported.pictures.iter();
        Ok(ExportReport {
            samples: table.rows() as u64,
            pictures: pictures.clone().map(Pictures::count).sum(),
            encoded_anew: pictures.map(Pictures::encoded_anew).sum(),
            left_out: exported.left_out(),
            is_importable: !exported.is_partly(),
            map: target.join(MAP),
        })
    }
}

/// Writes the labels of `dataset` as CSV: one row for each sample, bare channel names, an empty cell where there is no value.
///
/// Numbers are in the shortest form that reads back to the same binary64; the units are those of the header. The column
/// `frame` is relative to the folder of the dataset.
///
/// # Errors
/// Those of `writer`.
pub fn export_csv(dataset: &Dataset, writer: impl Write) -> io::Result<()> {
    let table = dataset.table();
    let columns = table.columns();
    let mut writer = ::csv::Writer::from_writer(writer);
    writer.write_record(columns.iter().map(|column| column.name))?;
    for row in 0..table.rows() {
        writer.write_record(
            columns
                .iter()
                .map(|column| column.cells.text(row).unwrap_or_default()),
        )?;
    }
    writer.flush()
}
