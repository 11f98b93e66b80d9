//! The stage that predicts, and the tables it can be written as.

use std::collections::BTreeMap;
use std::io::{self, Write};

use taceva_core::{Channels, Column, Field};
use taceva_dataset::Dataset;
use taceva_models::Model;

use crate::bounded::Bounded;
use crate::error::StudyError;
use crate::features::{blank, extract};
use crate::rows::{DataPart, Divided, Need, require_samples, usable};
use crate::work::Work;

/// Predictions of some rows of a dataset, beside what is true of them.
#[derive(Debug)]
pub struct Predicted {
    part: DataPart,
    channels: Channels,
    ids: Vec<String>,
    points: Option<Vec<String>>,
    /// What else the table says of the rows, by the name of its column.
    beside: Vec<(&'static str, Vec<Option<String>>)>,
    truth: Vec<Column>,
    /// Within the bounds of the model.
    prediction: Vec<Column>,
    /// As the model gives it.
    unbounded: Vec<Column>,
    /// The standard deviation of each prediction, of a model that knows it.
    deviation: Option<Vec<Column>>,
    /// Which predictions lie beyond the bounds of the model, channel by channel; absent of a channel without bounds.
    beyond: Vec<Option<Vec<bool>>>,
    /// The best constant answers of the model, by channel, as far as it knows them.
    constants: BTreeMap<String, f64>,
    pub(crate) frames_decoded: u64,
    pub(crate) left_out: usize,
}

impl Predicted {
    /// The part of the dataset.
    pub fn part(&self) -> &'static str {
        self.part.name()
    }

    /// Number of samples.
    pub fn rows(&self) -> usize {
        self.ids.len()
    }

    /// What was predicted.
    pub fn channels(&self) -> &Channels {
        &self.channels
    }

    /// The share of predictions that the model's bounds changed, channel by channel; `None` where there is none.
    pub(crate) fn bounded_note(&self) -> Option<String> {
        let shares = self.bounded(0..self.rows());
        let channels = self.channels.iter();
        let shares: Vec<String> = channels
            .filter_map(|channel| {
                let share = shares.share(channel.name()).filter(|share| *share > 0.0)?;
                Some(format!("{} {:.1} %", channel.name(), 100.0 * share))
            })
            .collect();
        (!shares.is_empty()).then(|| {
            format!(
                "of the predictions of all samples together, these shares lie beyond the bounds of the model, a quarter of the range of labels \
                 on either side: {}; a score marked `bounded` gives the share among its own samples; robustness is of predictions as \
                 they are, every other score of those brought back",
                shares.join(", ")
            )
        })
    }

    /// How many predictions of the samples at `positions` lie beyond the bounds of the model, by channel.
    pub(crate) fn bounded(&self, positions: impl Iterator<Item = usize> + Clone) -> Bounded {
        let mut bounded = Bounded::default();
        for (channel, beyond) in self.channels.iter().zip(&self.beyond) {
            if let Some(beyond) = beyond {
                let own = positions.clone().map(|position| beyond[position]);
                bounded.add(channel.name(), own);
            }
        }
        bounded
    }

    /// The best constant answers of the model, by channel, as far as it knows them.
    pub(crate) fn constants(&self) -> &BTreeMap<String, f64> {
        &self.constants
    }

    pub(crate) fn truth(&self) -> &[Column] {
        &self.truth
    }

    /// Predictions within the bounds of the model.
    pub(crate) fn prediction(&self) -> &[Column] {
        &self.prediction
    }

    /// Predictions as the model gives them.
    pub(crate) fn unbounded(&self) -> &[Column] {
        &self.unbounded
    }

    pub(crate) fn deviation(&self) -> Option<&[Column]> {
        self.deviation.as_deref()
    }

    pub(crate) fn points(&self) -> Option<&[String]> {
        self.points.as_deref()
    }

    /// Writes the predictions as `score` reads them: `id` and a column a channel.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_predictions(&self, out: &mut dyn Write) -> io::Result<()> {
        self.write(&self.prediction, false, out)
    }

    /// Writes the predictions as the model gives them, in the form of [`write_predictions`](Predicted::write_predictions): what `score` forms
    /// robustness from.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_unbounded_predictions(&self, out: &mut dyn Write) -> io::Result<()> {
        self.write(&self.unbounded, false, out)
    }

    /// Writes the standard deviation of each prediction, where the model knows it: `id` and a column a channel; says whether it does.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_deviations(&self, out: &mut dyn Write) -> io::Result<bool> {
        match &self.deviation {
            Some(deviation) => self.write(deviation, false, out).map(|()| true),
            None => Ok(false),
        }
    }

    /// Writes the truth of the same samples: `id`, `point_id` where every sample has one, what else is known of them (`scene`,
    /// `repeat`, `phase` and the like), and a column a channel.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_truth(&self, out: &mut dyn Write) -> io::Result<()> {
        self.write(&self.truth, true, out)
    }

    fn write(&self, columns: &[Column], is_truth: bool, out: &mut dyn Write) -> io::Result<()> {
        let points = self.points.as_ref().filter(|_| is_truth);
        let beside = if is_truth { &self.beside[..] } else { &[] };
        let mut writer = csv::Writer::from_writer(out);
        let mut head = vec!["id"];
        head.extend(points.map(|_| "point_id"));
        head.extend(beside.iter().map(|(name, _)| *name));
        head.extend(self.channels.iter().map(|channel| channel.name()));
        writer.write_record(head)?;
        for row in 0..self.rows() {
            let mut cells = vec![self.ids[row].clone()];
            cells.extend(points.map(|points| points[row].clone()));
            let texts = beside.iter().map(|(_, texts)| texts[row].clone());
            cells.extend(texts.map(Option::unwrap_or_default));
            let values = columns.iter().map(|column| column.get(row));
            let text =
                |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:?}"));
            cells.extend(values.map(text));
            writer.write_record(cells)?;
        }
        writer.flush()
    }
}

/// Predicts a part of `dataset`; by default what the model has not seen: the test part of its own dataset, all of another.
///
/// # Errors
/// [`StudyError`] if the model does not fit the dataset, or the dataset cannot be read.
pub fn predict(
    dataset: &Dataset,
    model: &Model,
    part: Option<DataPart>,
    work: Work<'_>,
) -> Result<Predicted, StudyError> {
    let target = Target::new(dataset, model, part)?;
    run(dataset, model, &target, work)
}

/// The rows that are predicted, and how that was decided.
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
        Target::of(dataset, divided, part, model.reads_features())
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

pub(crate) fn run(
    dataset: &Dataset,
    model: &Model,
    target: &Target,
    work: Work<'_>,
) -> Result<Predicted, StudyError> {
    let numbers = numbers(dataset, model, target, work)?;
    table(dataset, model, target, &numbers)
}

/// What `model` says of the rows of `target`, however far that lies from what it was taught, and, where it knows, by how much each prediction may be off.
///
/// # Shapes
/// `[rows, channels]`, row after row; behind it standard deviations in the same order, or nothing.
pub(crate) fn numbers(
    dataset: &Dataset,
    model: &Model,
    target: &Target,
    work: Work<'_>,
) -> Result<Column, StudyError> {
    let rows = &target.rows;
    let features = if model.reads_features() {
        extract(dataset, &extractor(dataset, model)?, rows, work)?
    } else {
        blank(model.card().features.shape(), rows.len())?
    };
    let mut numbers = model.predict_unbounded(&features)?;
    numbers.extend(model.deviations(&features)?.into_iter().flatten());
    Ok(Column::full(numbers))
}

/// `numbers` beside what the table of `dataset` says of the same rows.
pub(crate) fn table(
    dataset: &Dataset,
    model: &Model,
    target: &Target,
    numbers: &Column,
) -> Result<Predicted, StudyError> {
    let rows = &target.rows;
    let channels = model.channels().clone();
    let width = channels.len();
    let columns = |numbers: &[f64]| -> Vec<Column> {
        let column = |position: usize| numbers.iter().skip(position).step_by(width).copied();
        let columns = (0..width).map(|position| Column::full(column(position).collect()));
        columns.collect()
    };
    let (numbers, deviations) = numbers.values().split_at(rows.len() * width);
    let mut bounded = numbers.to_vec();
    model.bound(&mut bounded);
    let points: Option<Vec<String>> = rows
        .iter()
        .map(|&row| dataset.table().point_id()[row].clone())
        .collect();
    Ok(Predicted {
        part: target.part,
        ids: rows
            .iter()
            .map(|&row| dataset.table().samples()[row].clone())
            .collect(),
        points,
        beside: beside(dataset, rows),
        truth: channels
            .iter()
            .map(|channel| truth(dataset, channel, rows))
            .collect::<Result<_, _>>()?,
        prediction: columns(&bounded),
        unbounded: columns(numbers),
        deviation: (!deviations.is_empty()).then(|| columns(deviations)),
        beyond: (0..width)
            .map(|position| {
                let own = numbers.iter().skip(position).step_by(width);
                own.map(|value| model.is_beyond(position, *value)).collect()
            })
            .collect(),
        constants: constants(model),
        frames_decoded: if model.reads_features() {
            rows.len() as u64
        } else {
            0
        },
        left_out: target.left_out,
        channels,
    })
}

/// The best constant answers of `model`, by channel, as far as its card says them.
fn constants(model: &Model) -> BTreeMap<String, f64> {
    let channels = model.card().channels.iter();
    channels
        .filter_map(|channel| Some((channel.name.clone(), channel.mean?)))
        .collect()
}

/// What else the table says of `rows`, of the columns that `score` reads.
fn beside(dataset: &Dataset, rows: &[usize]) -> Vec<(&'static str, Vec<Option<String>>)> {
    const READ_BY_SCORE: [Field; 9] = [
        Field::UnitId,
        Field::Scene,
        Field::DepthStep,
        Field::Repeat,
        Field::Phase,
        Field::Stamp,
        Field::Kind,
        Field::Spacing,
        Field::Intensity,
    ];
    let column = |field: Field| {
        let texts = dataset.table().as_text(field.name())?;
        Some((
            field.name(),
            rows.iter().map(|&row| texts[row].clone()).collect(),
        ))
    };
    READ_BY_SCORE.into_iter().filter_map(column).collect()
}

/// The extractor of a fitted model on the frames of `dataset`.
pub(crate) fn extractor(
    dataset: &Dataset,
    model: &Model,
) -> Result<taceva_models::Extractor, StudyError> {
    let frames = dataset.header().frames.as_ref();
    let info = frames
        .ok_or_else(|| {
            StudyError::Unsuited("the dataset has no frames, the model needs them".to_owned())
        })?
        .info;
    let reference = if model.card().features.asks_for_reference().is_some() {
        dataset.reference()?
    } else {
        None
    };
    Ok(model.extractor(info, reference.as_ref())?)
}

/// What is true of `rows`; a channel that the dataset has not is absent in every row.
pub(crate) fn truth(
    dataset: &Dataset,
    channel: &taceva_core::Channel,
    rows: &[usize],
) -> Result<Column, StudyError> {
    let table = dataset.table();
    let known = table.channels().by_name(channel.name());
    if let Some(known) = known.filter(|known| known.unit() != channel.unit()) {
        return Err(StudyError::Unsuited(format!(
            "the model predicts {channel} in {}, the dataset has it in {}",
            channel.unit(),
            known.unit()
        )));
    }
    let position = table.channels().position(channel.name());
    let mut column = Column::default();
    rows.iter()
        .for_each(|&row| column.push(position.and_then(|position| table.truth(position).get(row))));
    Ok(column)
}
