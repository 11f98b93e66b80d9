//! Export of a dataset for other programs: its table as CSV, or the whole dataset with an import map.

mod cells;
mod content;
mod csv;
mod form;
mod hdf5;
mod hugging_face;
mod lerobot;
mod map;
mod maps;
mod picture;
mod tasks;

use std::io::{self, Write};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::Progress;

use taceva_dataset::Dataset;
use taceva_dataset::internal::{
    Cells, column_kind, layout, staging::Place, staging::StagedFolder, write_durable,
};

use content::Exported;
use picture::Pictures;

use crate::error::ImportError;

pub use form::ExportForm;

/// File name of the map in an export folder.
const MAP: &str = "map.toml";

/// Result of an export.
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
    /// Number of samples.
    pub samples: u64,
    /// Number of pictures in all views; some samples may have no picture.
    pub pictures: u64,
    /// Number of pictures that were encoded again. Their bytes differ from the dataset, but their pixels are equal.
    pub encoded_anew: u64,
    /// Facts of the dataset that the map of the export cannot state, in words.
    pub left_out: Vec<String>,
    /// True if TacEva can import the export with its map. False if only some samples have a picture.
    pub is_importable: bool,
    /// Path of the map for importing the export.
    pub map: PathBuf,
}

/// Export of a dataset that has at least one sample.
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
    /// Plans an export of `dataset` in `form`.
    ///
    /// # Errors
    /// [`ImportError::Dataset`] if the dataset has no sample.
    pub fn new(dataset: &'a Dataset, form: ExportForm) -> Result<ExportPlan<'a>, ImportError> {
        match dataset.table().rows() {
            0 => Err(ImportError::request(
                dataset.path(),
                "no samples: there is nothing to export",
            )),
            _ => Ok(ExportPlan { dataset, form }),
        }
    }

    /// Writes the new folder `target` on `jobs` threads, with a `map.toml`. An import with that map restores samples, labels, times, signals, the origin of
    /// each row, and pictures with equal pixels. Equal datasets give equal bytes on any number of threads.
    ///
    /// # Units
    /// Each channel has the unit of the dataset, which the map states.
    ///
    /// # Errors
    /// [`ImportError::Dataset`] with `TargetExists`; `Sample` if the form cannot represent a sample; `Image` or `Digest` for a damaged picture; `Cancelled`;
    /// `Io`. After an error `target` does not exist.
    pub fn run(
        self,
        target: &Path,
        jobs: NonZeroUsize,
        progress: &dyn Progress,
    ) -> Result<ExportReport, ImportError> {
        let ExportPlan { dataset, form } = self;
        let table = dataset.table();
        let staged = StagedFolder::create(target, Place::Free)?;
        let maps = maps::write(dataset, &staged)?;
        let mut columns = table.columns();
        for column in &mut columns {
            if let Some(own) = maps.iter().find(|own| own.column == column.name) {
                column.cells = Cells::Text(&own.files);
            }
        }
        // An import measures the brightness of each picture again, and the view selected here is no fact of the dataset.
        columns.retain(|column| {
            let is_seen = column.name == "source_frame" && !table.views().is_empty();
            column_kind(column.name) != "intensity"
                && !is_seen
                && !matches!(
                    column.cells,
                    Cells::FramePath(_) | Cells::FrameDigest(_) | Cells::MapDigest(_)
                )
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
        progress.begin("export samples", Some(table.rows() as u64));
        let written = match form {
            ExportForm::Csv => csv::write(&exported, &staged),
            ExportForm::HuggingFace => hugging_face::write(&exported, &staged),
            ExportForm::Hdf5 => hdf5::write(&exported, &staged),
            ExportForm::LeRobot => lerobot::write(&exported, &staged),
        };
        progress.end();
        let (map, mut folders) = written?;
        if !maps.is_empty() {
            folders.push(layout::MAPS.to_owned());
        }
        folders.extend(maps.iter().map(|own| own.folder.clone()));
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

/// Writes the labels of `dataset` as CSV: one row per sample, channel names without units, an empty cell for a missing value.
///
/// Numbers have the shortest form that parses back to the same binary64; the header of the dataset states the units. The column `frame` is relative to the
/// folder of the dataset.
///
/// # Errors
/// Errors of `writer`.
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
