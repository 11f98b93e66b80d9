//! Which rows of a dataset are predicted.

use taceva_dataset::Dataset;
use taceva_models::Model;

use crate::error::StudyError;
use crate::rows::{DataPart, Divided, Need, require_samples, usable};

/// The rows that are predicted, and how that was decided.
#[derive(Debug)]
pub(crate) struct Target {
    pub(crate) part: DataPart,
    pub(crate) rows: Vec<usize>,
    pub(crate) divided: Option<Divided>,
    pub(crate) left_out: usize,
}

impl Target {
    /// Decides for a fitted model: on the dataset it was fitted on, its own split is made again.
    pub(crate) fn new(
        dataset: &Dataset,
        model: &Model,
        part: Option<DataPart>,
    ) -> Result<Target, StudyError> {
        require_samples(dataset)?;
        let divided = Divided::by_model(dataset, model)?;
        Target::of(dataset, divided, part, model.reads_frames())
    }

    pub(crate) fn of(
        dataset: &Dataset,
        divided: Option<Divided>,
        part: Option<DataPart>,
        reads_frames: bool,
    ) -> Result<Target, StudyError> {
        if let (Some(divided), None) = (&divided, part) {
            divided.require_test()?;
        }
        let part = part.unwrap_or(if divided.is_some() {
            DataPart::Test
        } else {
            DataPart::All
        });
        let all = match (&divided, part) {
            (Some(divided), part) => divided.rows(part),
            (None, DataPart::All) => dataset.all_rows(),
            (None, part) => {
                return Err(StudyError::Request(format!(
                    "part `{}`: the model was fitted on another dataset, only `all` of this one can be taken",
                    part.name()
                )));
            }
        };
        let rows = usable(
            dataset,
            &all,
            Need {
                frame: reads_frames,
                labels: None,
            },
        );
        if rows.is_empty() {
            return Err(StudyError::Request(format!(
                "the part `{}` has no sample that can be predicted",
                part.name()
            )));
        }
        Ok(Target {
            part,
            left_out: all.len() - rows.len(),
            rows,
            divided,
        })
    }
}
