//! Rows of a dataset to predict.

use taceva_core::{Field, shown};
use taceva_dataset::Dataset;
use taceva_models::Model;

use crate::error::EvaluateError;
use crate::rows::{DataPart, Divided, Need, require_samples, usable};

/// Rejects frames of a view other than the view of the model, because wrong predictions would look plausible.
fn check_view(dataset: &Dataset, model: &Model) -> Result<(), EvaluateError> {
    let fitted_on = model.card().provenance.view.as_deref();
    match (fitted_on, dataset.view()) {
        (Some(own), Some(seen)) if own != seen => Err(EvaluateError::Unsuited(format!(
            "the model was fitted on the view `{}`, but the pictures are of the view `{}`: omit --view, or fit a model on the view of the pictures",
            shown(&own),
            shown(&seen)
        ))),
        _ => Ok(()),
    }
}

/// Rows to predict, and their division.
#[derive(Debug)]
pub struct Target {
    /// Part of the dataset.
    pub part: DataPart,
    /// Rows to predict, ascending.
    pub rows: Vec<usize>,
    /// Division of the dataset, if the dataset is divided.
    pub divided: Option<Divided>,
    /// Number of rows of the part that lack the input of the model.
    pub left_out: usize,
}

impl Target {
    /// Target of a fitted model. On the dataset of the model's fit, the division of the fit is repeated.
    pub fn new(
        dataset: &Dataset,
        model: &Model,
        part: Option<DataPart>,
    ) -> Result<Target, EvaluateError> {
        require_samples(dataset)?;
        check_view(dataset, model)?;
        let divided = Divided::by_model(dataset, model)?;
        Target::of(dataset, divided, part, model.reads_frames())
    }

    /// Target of the rows of `part` of a division, or of the whole dataset.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] for a part without rows.
    pub fn of(
        dataset: &Dataset,
        divided: Option<Divided>,
        part: Option<DataPart>,
        reads_frames: bool,
    ) -> Result<Target, EvaluateError> {
        if reads_frames {
            dataset.require_view()?;
        }
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
                return Err(EvaluateError::Request(format!(
                    "part `{}`: the model was fitted on another dataset, so this dataset has only the part `all`",
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
        let fields = dataset.fields();
        let has_input = fields.contains(Field::Frame) || fields.contains(Field::Signals);
        if rows.is_empty() && !has_input {
            return Err(EvaluateError::Request(
                "the dataset has neither pictures nor signals: name the pictures by [frame] of its map and import the folder again; \
                 `taceva init recording FOLDER` drafts the map"
                    .to_owned(),
            ));
        }
        if rows.is_empty() {
            return Err(EvaluateError::Request(format!(
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
