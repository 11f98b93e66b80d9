//! Collects samples into columns.

use super::{Batch, Column, LABELS, Labels, NUMBERS};
use crate::channel::Channels;
use crate::field::{Field, FieldSet};
use crate::grating::GratingKind;
use crate::nanometre::Nanometre;
use crate::phase::Phase;
use crate::sample::{Readings, Sample};

/// Collects samples into batches that contain only selected fields.
///
/// ```
/// use taceva_core::{BatchBuilder, Channel, Channels, FieldSet, Readings, Sample};
/// let mut builder = BatchBuilder::new(Channels::new([Channel::FZ])?, FieldSet::PAIRS);
/// builder.push(&Sample::new("press 1").with_truth(Readings::from_values([0.5])));
/// assert_eq!(builder.take().truth(0).get(0), Some(0.5));
/// # Ok::<(), taceva_core::ChannelError>(())
/// ```
#[derive(Debug)]
pub struct BatchBuilder {
    fields: FieldSet,
    batch: Batch,
}

impl BatchBuilder {
    /// A builder for samples with one reading per channel, in the order of `channels`. The batch contains only `fields`.
    pub fn new(channels: Channels, fields: FieldSet) -> BatchBuilder {
        BatchBuilder {
            fields,
            batch: empty(channels, fields),
        }
    }

    /// Adds one sample. If any sample of a batch has no `point_id`, [`Batch::points`] of that batch is `None`.
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

    /// Number of collected samples.
    pub fn rows(&self) -> usize {
        self.batch.rows
    }

    /// The collected samples as a batch. The builder keeps these samples.
    ///
    /// ```
    /// use taceva_core::{BatchBuilder, Channel, Channels, FieldSet, Sample};
    /// let mut builder = BatchBuilder::new(Channels::new([Channel::FZ])?, FieldSet::PAIRS);
    /// builder.push(&Sample::default());
    /// assert_eq!((builder.so_far().rows(), builder.rows()), (1, 1));
    /// # Ok::<(), taceva_core::ChannelError>(())
    /// ```
    pub fn so_far(&self) -> &Batch {
        &self.batch
    }

    /// Returns the collected samples and empties the builder.
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
        recordings: None,
        samples: None,
        labels: labels.map(|field| (field, Labels::default())).collect(),
        numbers: numbers.map(|field| (field, Column::default())).collect(),
        channels,
    }
}

/// The text of `field` in `sample`; `None` if the sample has none.
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

/// The number of `field` in `sample`; `None` if the sample has none.
fn number(sample: &Sample, field: Field) -> Option<f64> {
    match field {
        Field::DepthStep => sample.depth_step.map(f64::from),
        Field::Repeat => sample.repeat.map(f64::from),
        Field::Stamp => sample.stamp.map(|stamp| stamp.valid_s),
        Field::Spacing => sample.spacing.map(Nanometre::to_f64),
        Field::PredictedSpacing => sample.predicted_spacing.map(Nanometre::to_f64),
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
