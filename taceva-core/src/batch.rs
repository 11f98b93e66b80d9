//! Samples as columns: what metrics eat.

use std::collections::{BTreeMap, HashMap};
use std::ops::Range;

use crate::channel::Channels;
use crate::field::{Field, FieldSet};
use crate::grating::GratingKind;
use crate::nanometre::Nanometre;
use crate::phase::Phase;
use crate::sample::{Readings, Sample};

/// Some samples as columns of one length; what no metric asked for is not filled.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Batch {
    rows: usize,
    channels: Channels,
    truth: Vec<Column>,
    prediction: Vec<Column>,
    points: Option<Labels>,
    labels: BTreeMap<Field, Labels>,
    numbers: BTreeMap<Field, Column>,
}

impl Batch {
    /// A batch of ready columns.
    ///
    /// # Shapes
    /// `truth`, `prediction`: a column a channel, all of one length; `points`: of that length.
    /// # Panics
    /// If the shapes differ, which is a mistake of the caller's code, not of its data.
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
                .is_none_or(|points| points.index.len() == rows),
            "a point for each row"
        );
        Batch {
            rows,
            channels,
            truth,
            prediction,
            points,
            labels: BTreeMap::new(),
            numbers: BTreeMap::new(),
        }
    }

    /// The same batch with the texts of `field`: scene, unit, phase, kind of grating or digest of the frame.
    ///
    /// # Panics
    /// If there is not one for each row, or the field holds no text.
    #[must_use]
    pub fn with_labels(mut self, field: Field, labels: Labels) -> Batch {
        assert_eq!(labels.index.len(), self.rows, "a label for each row");
        assert!(LABELS.contains(&field), "`{field}` holds no text");
        self.labels.insert(field, labels);
        self
    }

    /// The same batch with the numbers of `field`: depth step, repeat, time in s, spacings in whole nm, intensity.
    ///
    /// # Panics
    /// If there is not one for each row, or the field holds no number.
    #[must_use]
    pub fn with_numbers(mut self, field: Field, numbers: Column) -> Batch {
        assert_eq!(numbers.len(), self.rows, "a number for each row");
        assert!(NUMBERS.contains(&field), "`{field}` holds no number");
        self.numbers.insert(field, numbers);
        self
    }

    /// Number of samples.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The channels of the columns.
    pub fn channels(&self) -> &Channels {
        &self.channels
    }

    /// What the reference instruments say, of the channel at `position`.
    pub fn truth(&self, position: usize) -> &Column {
        &self.truth[position]
    }

    /// What the model says, of the channel at `position`.
    pub fn prediction(&self, position: usize) -> &Column {
        &self.prediction[position]
    }

    /// The contact location of each sample, if samples name one.
    pub fn points(&self) -> Option<&Labels> {
        self.points.as_ref()
    }

    /// The texts of `field`, if the batch carries them: scene, unit, phase, kind of grating or digest of the frame.
    pub fn labels(&self, field: Field) -> Option<&Labels> {
        self.labels.get(&field)
    }

    /// The numbers of `field`, if the batch carries them: depth step, repeat, time in s, spacings in whole nm (exact in
    /// binary64), intensity.
    pub fn numbers(&self, field: Field) -> Option<&Column> {
        self.numbers.get(&field)
    }
}

/// Fields that are texts.
const LABELS: [Field; 5] = [
    Field::Scene,
    Field::UnitId,
    Field::Phase,
    Field::Kind,
    Field::FrameDigest,
];

/// Fields that are numbers.
const NUMBERS: [Field; 6] = [
    Field::DepthStep,
    Field::Repeat,
    Field::Stamp,
    Field::Spacing,
    Field::PredictedSpacing,
    Field::Intensity,
];

/// The values of one channel; where a sample has none, a mask says so.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Column {
    values: Vec<f64>,
    present: Option<Vec<bool>>,
}

impl Column {
    /// A column in which every sample has a value.
    pub fn full(values: Vec<f64>) -> Column {
        Column {
            values,
            present: None,
        }
    }

    /// Adds a value, or the fact that there is none.
    pub fn push(&mut self, value: Option<f64>) {
        if value.is_none() && self.present.is_none() {
            self.present = Some(vec![true; self.values.len()]);
        }
        if let Some(present) = &mut self.present {
            present.push(value.is_some());
        }
        self.values.push(value.unwrap_or(0.0));
    }

    /// The value at `row`, if there is one.
    pub fn get(&self, row: usize) -> Option<f64> {
        let present = self.present.as_ref().is_none_or(|present| present[row]);
        present.then(|| self.values[row])
    }

    /// All values in one slice; where [`present`](Column::present) says no, the number means nothing.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Which rows have a value; `None` if all have.
    pub fn present(&self) -> Option<&[bool]> {
        self.present.as_deref()
    }

    /// The rows of `range` as a column of their own.
    ///
    /// # Panics
    /// If the range reaches beyond the last row.
    pub fn slice(&self, range: Range<usize>) -> Column {
        let present = self
            .present
            .as_ref()
            .map(|present| present[range.clone()].to_vec());
        Column {
            values: self.values[range].to_vec(),
            present,
        }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }
}

/// A name a row, each distinct name kept once; a row may have none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Labels {
    names: Vec<String>,
    index: Vec<u32>,
    lookup: HashMap<String, u32>,
}

impl Labels {
    /// Adds a row called `name`.
    ///
    /// # Panics
    /// Beyond 2³² distinct names, which no memory holds.
    pub fn push(&mut self, name: &str) {
        let index = match self.lookup.get(name) {
            Some(&index) => index,
            None => {
                let index = u32::try_from(self.names.len())
                    .ok()
                    .filter(|index| *index != Labels::ABSENT)
                    .expect("fewer than 2^32 distinct names fit in memory");
                self.names.push(name.to_owned());
                self.lookup.insert(name.to_owned(), index);
                index
            }
        };
        self.index.push(index);
    }

    /// Adds a row without a name.
    pub fn push_absent(&mut self) {
        self.index.push(Labels::ABSENT);
    }

    /// What [`index`](Labels::index) says of a row without a name.
    pub const ABSENT: u32 = u32::MAX;

    /// The distinct names, in the order of their first row.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// For each row, which of the names it has; [`ABSENT`](Labels::ABSENT) for none.
    pub fn index(&self) -> &[u32] {
        &self.index
    }

    /// The name of `row`, if it has one.
    pub fn get(&self, row: usize) -> Option<&str> {
        let index = self.index[row];
        (index != Labels::ABSENT).then(|| self.names[index as usize].as_str())
    }
}

/// Collects samples into batches, filling only the fields somebody reads.
#[derive(Debug)]
pub struct BatchBuilder {
    fields: FieldSet,
    batch: Batch,
}

impl BatchBuilder {
    /// A builder for samples whose readings follow `channels`.
    pub fn new(channels: Channels, fields: FieldSet) -> BatchBuilder {
        BatchBuilder {
            fields,
            batch: empty(channels, fields),
        }
    }

    /// Adds one sample. A sample without `point_id` ends the clusters of its batch: a partly named batch has none.
    pub fn push(&mut self, sample: &Sample) {
        let batch = &mut self.batch;
        let nothing = Readings::default();
        let kept = |field, readings| {
            if self.fields.contains(field) {
                readings
            } else {
                &nothing
            }
        };
        let truth = kept(Field::Truth, &sample.truth);
        let prediction = kept(
            Field::Prediction,
            sample.prediction.as_ref().unwrap_or(&nothing),
        );
        for (position, column) in batch.truth.iter_mut().enumerate() {
            column.push(truth.get(position));
        }
        for (position, column) in batch.prediction.iter_mut().enumerate() {
            column.push(prediction.get(position));
        }
        match sample
            .point_id
            .as_ref()
            .filter(|_| self.fields.contains(Field::Point))
        {
            Some(point) if batch.rows == 0 || batch.points.is_some() => {
                batch.points.get_or_insert_default().push(point);
            }
            _ => batch.points = None,
        }
        for (field, labels) in &mut batch.labels {
            match text(sample, *field) {
                Some(name) => labels.push(name),
                None => labels.push_absent(),
            }
        }
        for (field, numbers) in &mut batch.numbers {
            numbers.push(number(sample, *field));
        }
        batch.rows += 1;
    }

    /// Number of samples collected so far.
    pub fn rows(&self) -> usize {
        self.batch.rows
    }

    /// The batch so far; the builder starts anew.
    pub fn take(&mut self) -> Batch {
        let fresh = empty(self.batch.channels.clone(), self.fields);
        std::mem::replace(&mut self.batch, fresh)
    }
}

fn empty(channels: Channels, fields: FieldSet) -> Batch {
    let columns = vec![Column::default(); channels.len()];
    let labels = LABELS.into_iter().filter(|field| fields.contains(*field));
    let numbers = NUMBERS.into_iter().filter(|field| fields.contains(*field));
    Batch {
        rows: 0,
        truth: columns.clone(),
        prediction: columns,
        points: None,
        labels: labels.map(|field| (field, Labels::default())).collect(),
        numbers: numbers.map(|field| (field, Column::default())).collect(),
        channels,
    }
}

/// What `sample` says in the text field.
fn text(sample: &Sample, field: Field) -> Option<&str> {
    match field {
        Field::Scene => sample.scene_id.as_deref(),
        Field::UnitId => sample.unit_id.as_deref(),
        Field::Phase => sample.phase.map(Phase::name),
        Field::Kind => sample.kind.map(GratingKind::name),
        Field::FrameDigest => sample.frame_digest.as_deref(),
        _ => None,
    }
}

/// What `sample` says in the number field.
fn number(sample: &Sample, field: Field) -> Option<f64> {
    let nanometres = |length: Nanometre| {
        #[expect(
            clippy::cast_precision_loss,
            reason = "lengths up to 2^53 nm are exact"
        )]
        let exact = length.0 as f64;
        exact
    };
    match field {
        Field::DepthStep => sample.depth_step.map(f64::from),
        Field::Repeat => sample.repeat.map(f64::from),
        Field::Stamp => sample.stamp.map(|stamp| stamp.valid_s),
        Field::Spacing => sample.spacing.map(nanometres),
        Field::PredictedSpacing => sample.predicted_spacing.map(nanometres),
        Field::Intensity => sample.intensity,
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::channel::Channel;

    fn sample(point: Option<&str>, truth: Option<f64>) -> Sample {
        Sample {
            point_id: point.map(str::to_owned),
            truth: Readings::new(vec![truth]),
            prediction: Some(Readings::from_values([1.0])),
            ..Sample::default()
        }
    }

    fn builder(fields: FieldSet) -> BatchBuilder {
        BatchBuilder::new(Channels::new([Channel::FZ]).expect("one channel"), fields)
    }

    #[test]
    fn an_absent_value_stays_absent_and_shifts_nothing() {
        let mut builder = builder(FieldSet::PAIRS);
        for truth in [Some(2.0), None, Some(3.0)] {
            builder.push(&sample(Some("a"), truth));
        }
        let batch = builder.take();
        let column = batch.truth(0);
        assert_eq!(
            [column.get(0), column.get(1), column.get(2)],
            [Some(2.0), None, Some(3.0)]
        );
        assert_eq!(batch.prediction(0).present(), None);
    }

    #[test]
    fn each_point_name_is_kept_once() {
        let mut builder = builder(FieldSet::PAIRS);
        for point in ["b", "a", "b"] {
            builder.push(&sample(Some(point), Some(0.0)));
        }
        let batch = builder.take();
        let points = batch.points().expect("every sample has a point");
        assert_eq!((points.names().len(), points.index()), (2, &[0, 1, 0][..]));
    }

    #[test]
    fn a_partly_named_batch_has_no_points() {
        let mut builder = builder(FieldSet::PAIRS);
        builder.push(&sample(Some("a"), Some(0.0)));
        builder.push(&sample(None, Some(0.0)));
        builder.push(&sample(Some("a"), Some(0.0)));
        assert_eq!(builder.take().points(), None);
        assert_eq!(builder.rows(), 0);
    }

    #[test]
    fn a_field_that_some_samples_lack_is_absent_there_and_nowhere_else() {
        let mut builder = builder(FieldSet::EMPTY.with(Field::Scene).with(Field::Spacing));
        for (scene, spacing) in [(Some("S1"), None), (None, Some(Nanometre(350_000)))] {
            builder.push(&Sample {
                scene_id: scene.map(str::to_owned),
                spacing,
                ..sample(None, None)
            });
        }
        let batch = builder.take();
        let scenes = batch.labels(Field::Scene).expect("asked for");
        assert_eq!((scenes.get(0), scenes.get(1)), (Some("S1"), None));
        let spacings = batch.numbers(Field::Spacing).expect("asked for");
        assert_eq!((spacings.get(0), spacings.get(1)), (None, Some(350_000.0)));
        assert_eq!(batch.labels(Field::Phase), None);
    }

    #[test]
    fn fields_nobody_reads_are_not_filled() {
        let mut builder = builder(FieldSet::EMPTY.with(Field::Truth));
        builder.push(&sample(Some("a"), Some(2.0)));
        let batch = builder.take();
        assert_eq!((batch.prediction(0).get(0), batch.points()), (None, None));
    }
}
