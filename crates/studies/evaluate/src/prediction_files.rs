//! Files of recordings that a model reads to predict the samples of a table again, for bundles with pictures.

use std::collections::BTreeSet;
use std::path::PathBuf;

use taceva_dataset::internal::layout;
use taceva_dataset::{Dataset, FrameEntry, ViewFrames};
use taceva_results::{Provenance, Samples};

use crate::error::EvaluateError;
use crate::prediction_check::dataset_of;

/// Files of one recording that a model reads to predict samples again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PredictionFiles {
    /// Folder of the recording.
    pub folder: PathBuf,
    /// Header, table, and files with pictures or signals, relative to the folder, ascending.
    pub files: Vec<String>,
}

/// Files behind the predictions in `samples`, for each recording whose digest `provenance` states: one of `datasets`, or all of them joined.
///
/// A pack of frames is a single file, and may contain frames that the model does not read.
///
/// # Errors
/// [`EvaluateError::Request`] if no recording has the digest. Otherwise errors of opening a recording.
pub fn prediction_files(
    datasets: &[PathBuf],
    provenance: &Provenance,
    samples: &Samples,
) -> Result<Vec<PredictionFiles>, EvaluateError> {
    let dataset = dataset_of(datasets, provenance)?;
    let channels = samples.channels();
    let is_predicted = |row: &usize| {
        let mut channels = channels.iter();
        channels.any(|channel| channel.prediction(*row).is_some())
    };
    let predicted = (0..samples.rows()).filter(is_predicted);
    let names = predicted.filter_map(|row| samples.word(Samples::KEY, row));
    Ok(match dataset.recordings() {
        [] => {
            let names: BTreeSet<&str> = names.collect();
            vec![files_of(&dataset, &names)]
        }
        joined => {
            // A joined recording is named after its folder, which may have another name here.
            let names = names.filter_map(|name| Some(name.split_once('/')?.1));
            let names: BTreeSet<&str> = names.collect();
            let files = joined.iter().map(|own| files_of(own.dataset(), &names));
            files.collect()
        }
    })
}

/// Files of `dataset` behind the samples called `names`.
fn files_of(dataset: &Dataset, names: &BTreeSet<&str>) -> PredictionFiles {
    let (header, table) = (dataset.header(), dataset.table());
    let mut files = BTreeSet::from([layout::HEADER.to_owned(), layout::SAMPLES.to_owned()]);
    files.extend(header.signals.iter().map(|_| layout::SIGNALS.to_owned()));
    let of_views = header.views.iter().map(|view| &view.frames);
    let references = header.frames.iter().chain(of_views);
    let references = references.filter_map(|frames| frames.reference.as_ref());
    files.extend(references.map(|reference| reference.path.clone()));
    // Views side by side have no file of their own.
    let columns: Vec<&[Option<FrameEntry>]> = match table.views() {
        [] => vec![table.frames()],
        views => views.iter().map(ViewFrames::frames).collect(),
    };
    for (row, name) in table.samples().iter().enumerate() {
        if names.contains(name.as_str()) {
            let entries = columns.iter().filter_map(|frames| frames[row].as_ref());
            files.extend(entries.map(|entry| entry.path.clone()));
        }
    }
    PredictionFiles {
        folder: dataset.path().to_owned(),
        files: files.into_iter().collect(),
    }
}
