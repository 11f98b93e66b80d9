//! Samples as columns: the input of metrics.

mod builder;
mod column;
mod labels;

pub use builder::BatchBuilder;
pub use column::Column;
pub use labels::Labels;

use std::collections::BTreeMap;

use crate::channel::Channels;
use crate::field::Field;

/// Samples as columns of equal length, one row per sample. A field that no requested metric needs may have no values.
///
/// ```
/// use taceva_core::{Batch, Channel, Channels, Column};
/// let channels = Channels::new([Channel::FZ])?;
/// let batch = Batch::from_columns(channels, vec![Column::full(vec![0.5])], vec![Column::full(vec![0.25])], None);
/// assert_eq!((batch.rows(), batch.prediction(0).get(0)), (1, Some(0.25)));
/// # Ok::<(), taceva_core::ChannelError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Batch {
    rows: usize,
    channels: Channels,
    truth: Vec<Column>,
    prediction: Vec<Column>,
    points: Option<Labels>,
    recordings: Option<Labels>,
    samples: Option<Labels>,
    labels: BTreeMap<Field, Labels>,
    numbers: BTreeMap<Field, Column>,
}

impl Batch {
    /// A batch from columns of true and predicted values, and the contact point of each row.
    ///
    /// # Shapes
    /// `truth`, `prediction`: one column per channel, all of one length; `points`: of that length.
    /// # Panics
    /// If the shapes differ. This is a bug in the caller.
    pub fn from_columns(
        channels: Channels,
        truth: Vec<Column>,
        prediction: Vec<Column>,
        points: Option<Labels>,
    ) -> Batch {
        let rows = truth.first().map_or(0, Column::len);
        assert_eq!(
            truth.len(),
            channels.len(),
            "a truth column for each channel"
        );
        assert_eq!(
            prediction.len(),
            channels.len(),
            "a prediction column for each channel"
        );
        assert!(
            truth
                .iter()
                .chain(&prediction)
                .all(|column| column.len() == rows),
            "columns of one length"
        );
        assert!(
            points
                .as_ref()
                .is_none_or(|points| points.index().len() == rows),
            "a point for each row"
        );
        Batch {
            rows,
            channels,
            truth,
            prediction,
            // If any row has no point, the whole batch has no clusters, as in `BatchBuilder`.
            points: points.filter(Labels::all_named),
            recordings: None,
            samples: None,
            labels: BTreeMap::new(),
            numbers: BTreeMap::new(),
        }
    }

    /// The same batch with texts for `field`: lighting scene, sensor unit, phase, kind of grating or digest of the frame.
    ///
    /// # Panics
    /// If the length of `labels` differs from the number of rows, or the values of the field are not text.
    #[must_use]
    pub fn with_labels(mut self, field: Field, labels: Labels) -> Batch {
        assert_eq!(labels.index().len(), self.rows, "a label for each row");
        assert!(LABELS.contains(&field), "`{field}` holds no text");
        self.labels.insert(field, labels);
        self
    }

    /// The same batch with the recording of each sample, for samples of several recordings.
    ///
    /// # Panics
    /// If the length of `recordings` differs from the number of rows, or a row has no name.
    ///
    /// ```
    /// use taceva_core::{Batch, Channel, Channels, Column, Labels};
    /// let column = || vec![Column::full(vec![0.5])];
    /// let mut recordings = Labels::default();
    /// recordings.push("monday");
    /// let batch = Batch::from_columns(Channels::new([Channel::FZ])?, column(), column(), None).with_recordings(recordings);
    /// assert_eq!(batch.recordings().and_then(|recordings| recordings.get(0)), Some("monday"));
    /// # Ok::<(), taceva_core::ChannelError>(())
    /// ```
    #[must_use]
    pub fn with_recordings(self, recordings: Labels) -> Batch {
        assert!(
            recordings.index().len() == self.rows && recordings.all_named(),
            "a recording for each row"
        );
        Batch {
            recordings: Some(recordings),
            ..self
        }
    }

    /// The same batch with the name of each sample, for confidence intervals that treat every sample as independent.
    ///
    /// # Panics
    /// If the length of `samples` differs from the number of rows, or a row has no name.
    ///
    /// ```
    /// use taceva_core::{Batch, Channel, Channels, Column, Labels};
    /// let column = || vec![Column::full(vec![0.5])];
    /// let mut samples = Labels::default();
    /// samples.push("press 1");
    /// let batch = Batch::from_columns(Channels::new([Channel::FZ])?, column(), column(), None).with_samples(samples);
    /// assert_eq!(batch.samples().and_then(|samples| samples.get(0)), Some("press 1"));
    /// # Ok::<(), taceva_core::ChannelError>(())
    /// ```
    #[must_use]
    pub fn with_samples(self, samples: Labels) -> Batch {
        assert!(
            samples.index().len() == self.rows && samples.all_named(),
            "a name for each row"
        );
        Batch {
            samples: Some(samples),
            ..self
        }
    }

    /// The same batch with numbers for `field`: depth level, number of the repeat, time in s, grating spacing in whole nm, or mean brightness.
    ///
    /// # Panics
    /// If the length of `numbers` differs from the number of rows, or the values of the field are not numbers.
    #[must_use]
    pub fn with_numbers(mut self, field: Field, numbers: Column) -> Batch {
        assert_eq!(numbers.len(), self.rows, "a number for each row");
        assert!(NUMBERS.contains(&field), "`{field}` holds no number");
        self.numbers.insert(field, numbers);
        self
    }

    /// The same samples in the order of the row indices `rows`, each row once.
    ///
    /// ```
    /// use taceva_core::{Batch, Channel, Channels, Column};
    /// let column = |values: [f64; 2]| vec![Column::full(values.into())];
    /// let batch = Batch::from_columns(Channels::new([Channel::FZ])?, column([0.5, 1.5]), column([0.25, 1.25]), None);
    /// let turned = batch.in_order(&[1, 0]);
    /// assert_eq!((turned.truth(0).get(0), turned.prediction(0).get(1)), (Some(1.5), Some(0.25)));
    /// # Ok::<(), taceva_core::ChannelError>(())
    /// ```
    ///
    /// # Panics
    /// If the number of indices differs from the number of rows, or an index is out of range.
    #[must_use]
    pub fn in_order(&self, rows: &[u32]) -> Batch {
        assert_eq!(rows.len(), self.rows, "each row once");
        let columns = |columns: &[Column]| columns.iter().map(|of| of.in_order(rows)).collect();
        let labels = |labels: &Labels| labels.in_order(rows);
        let of_labels = self.labels.iter();
        let of_numbers = self.numbers.iter();
        Batch {
            rows: self.rows,
            channels: self.channels.clone(),
            truth: columns(&self.truth),
            prediction: columns(&self.prediction),
            points: self.points.as_ref().map(labels),
            recordings: self.recordings.as_ref().map(labels),
            samples: self.samples.as_ref().map(labels),
            labels: of_labels.map(|(field, of)| (*field, labels(of))).collect(),
            numbers: of_numbers
                .map(|(field, of)| (*field, of.in_order(rows)))
                .collect(),
        }
    }

    /// The batch with periodic angles shifted by whole periods. `centres` has one value per channel name. Each true value moves as
    /// near as possible to the centre of its channel, or stays without one. Each prediction moves as near as possible to its true value.
    ///
    /// `None` if no channel has a period, so that the batch needs no change.
    ///
    /// ```
    /// use std::collections::BTreeMap;
    /// use taceva_core::{Batch, Channel, Channels, Column, Unit};
    /// let yaw = Channel::named("yaw", Unit::Degree)?.with_period(360)?;
    /// let channels = Channels::new([yaw])?;
    /// let [truth, prediction] = [vec![179.0], vec![-178.0]].map(Column::full);
    /// let batch = Batch::from_columns(channels, vec![truth], vec![prediction], None);
    /// let moved = batch.unwrapped(&BTreeMap::new()).ok_or("no period")?;
    /// assert_eq!(moved.prediction(0).get(0), Some(182.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn unwrapped(&self, centres: &BTreeMap<String, f64>) -> Option<Batch> {
        let mut channels = self.channels.iter();
        if channels.all(|channel| channel.period().is_none()) {
            return None;
        }
        let mut moved = self.clone();
        for (position, channel) in self.channels.iter().enumerate() {
            if channel.period().is_none() {
                continue;
            }
            let beside = |column: &Column, reference: &dyn Fn(usize) -> Option<f64>| -> Column {
                let cells = (0..column.len()).map(|row| {
                    let value = column.get(row)?;
                    Some(match reference(row) {
                        Some(reference) => channel.nearest(value, reference),
                        None => value,
                    })
                });
                cells.collect()
            };
            let centre = centres.get(channel.name()).copied();
            let truth = beside(&self.truth[position], &|_| centre);
            moved.prediction[position] = beside(&self.prediction[position], &|row| truth.get(row));
            moved.truth[position] = truth;
        }
        Some(moved)
    }

    /// Number of samples.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The channels of the columns.
    pub fn channels(&self) -> &Channels {
        &self.channels
    }

    /// True values of the channel at index `position` of [`channels`](Batch::channels).
    pub fn truth(&self, position: usize) -> &Column {
        &self.truth[position]
    }

    /// The predictions of the channel at index `position` of [`channels`](Batch::channels).
    pub fn prediction(&self, position: usize) -> &Column {
        &self.prediction[position]
    }

    /// The contact point of each sample; `None` if at least one sample has no point.
    pub fn points(&self) -> Option<&Labels> {
        self.points.as_ref()
    }

    /// The recording of each sample; `None` unless the batch combines several recordings.
    pub fn recordings(&self) -> Option<&Labels> {
        self.recordings.as_ref()
    }

    /// The name of each sample; `None` if the batch has no names.
    pub fn samples(&self) -> Option<&Labels> {
        self.samples.as_ref()
    }

    /// The texts of `field`: lighting scene, sensor unit, phase, kind of grating or digest of the frame. `None` if the batch lacks this field.
    pub fn labels(&self, field: Field) -> Option<&Labels> {
        self.labels.get(&field)
    }

    /// The numbers of `field`: depth level, number of the repeat, time in s, grating spacing in whole nm, or mean brightness from 0 to 255.
    /// `None` if the batch lacks this field.
    pub fn numbers(&self, field: Field) -> Option<&Column> {
        self.numbers.get(&field)
    }
}

/// Fields with text values.
const LABELS: [Field; 5] = [
    Field::Scene,
    Field::UnitId,
    Field::Phase,
    Field::Kind,
    Field::FrameDigest,
];

/// Fields with numbers.
const NUMBERS: [Field; 6] = [
    Field::DepthStep,
    Field::Repeat,
    Field::Stamp,
    Field::Spacing,
    Field::PredictedSpacing,
    Field::Intensity,
];
