//! Sinks, which receive samples one by one from a live rig or a recording.

use crate::field::{Field, FieldSet};
use crate::sample::Sample;

/// Error of a sink that cannot accept a sample.
///
/// ```
/// use taceva_core::SinkError;
/// let error: SinkError = "the disk is full".into();
/// assert_eq!(error.to_string(), "the disk is full");
/// ```
pub type SinkError = Box<dyn std::error::Error + Send + Sync>;

/// Receives samples from a live rig or from a recording through the same interface.
///
/// ```
/// use taceva_core::{FieldSet, Sample, SampleSink, SinkError};
///
/// /// Counts the samples that have a prediction.
/// #[derive(Default)]
/// struct Predicted(u64);
///
/// impl SampleSink for Predicted {
///     fn fields(&self) -> FieldSet {
///         FieldSet::PAIRS
///     }
///     fn accept(&mut self, sample: &Sample) -> Result<(), SinkError> {
///         self.0 += u64::from(sample.prediction.is_some());
///         Ok(())
///     }
/// }
///
/// let mut sink = Predicted::default();
/// sink.accept(&Sample::new("press 1"))?;
/// assert_eq!(sink.0, 0);
/// # Ok::<(), SinkError>(())
/// ```
pub trait SampleSink {
    /// Fields that the sink reads. A source may leave other fields empty.
    fn fields(&self) -> FieldSet;

    /// Accepts one sample.
    ///
    /// # Errors
    /// An error of the sink. The source stops and returns this error.
    fn accept(&mut self, sample: &Sample) -> Result<(), SinkError>;
}

impl<S: SampleSink + ?Sized> SampleSink for &mut S {
    fn fields(&self) -> FieldSet {
        (**self).fields()
    }
    fn accept(&mut self, sample: &Sample) -> Result<(), SinkError> {
        (**self).accept(sample)
    }
}

/// Two sinks that receive the same samples, for example to record and evaluate them in one pass. A plain pair, which gets no further fields.
///
/// ```
/// # use taceva_core::{FieldSet, SampleSink, SinkError};
/// # #[derive(Default)]
/// # struct Count(u64);
/// # impl SampleSink for Count {
/// #     fn fields(&self) -> FieldSet {
/// #         FieldSet::PAIRS
/// #     }
/// #     fn accept(&mut self, _: &Sample) -> Result<(), SinkError> {
/// #         self.0 += 1;
/// #         Ok(())
/// #     }
/// # }
/// use taceva_core::{Sample, Tee};
/// let mut tee = Tee { first: Count::default(), second: Count::default() };
/// tee.accept(&Sample::new("press 1"))?;
/// assert_eq!((tee.first.0, tee.second.0), (1, 1));
/// # Ok::<(), SinkError>(())
/// ```
#[derive(Debug)]
pub struct Tee<A, B> {
    /// Sink that receives each sample first.
    pub first: A,
    /// Sink that receives the samples accepted by `first`.
    pub second: B,
}

impl<A: SampleSink, B: SampleSink> SampleSink for Tee<A, B> {
    fn fields(&self) -> FieldSet {
        self.first.fields() | self.second.fields()
    }
    fn accept(&mut self, sample: &Sample) -> Result<(), SinkError> {
        self.first.accept(sample)?;
        self.second.accept(sample)
    }
}

/// A sink that requests only some of the fields that an inner sink reads, and empties the other fields.
///
/// ```
/// # use taceva_core::{FieldSet, SampleSink, SinkError};
/// # #[derive(Default)]
/// # struct Count(u64);
/// # impl SampleSink for Count {
/// #     fn fields(&self) -> FieldSet {
/// #         FieldSet::PAIRS
/// #     }
/// #     fn accept(&mut self, _: &Sample) -> Result<(), SinkError> {
/// #         self.0 += 1;
/// #         Ok(())
/// #     }
/// # }
/// use taceva_core::{Field, Sample, Select};
/// let without_predictions = Select::new(Count::default(), FieldSet::EMPTY.with(Field::Truth));
/// assert_eq!(without_predictions.fields(), FieldSet::EMPTY.with(Field::Truth));
/// ```
#[derive(Debug)]
pub struct Select<S> {
    inner: S,
    kept: FieldSet,
}

impl<S: SampleSink> Select<S> {
    /// A sink that passes to `inner` only the fields in `kept`, and data that no [`Field`] names, such as the id.
    pub fn new(inner: S, kept: FieldSet) -> Select<S> {
        Select { inner, kept }
    }
}

impl<S: SampleSink> SampleSink for Select<S> {
    fn fields(&self) -> FieldSet {
        self.inner
            .fields()
            .iter()
            .filter(|field| self.kept.contains(*field))
            .collect()
    }
    fn accept(&mut self, sample: &Sample) -> Result<(), SinkError> {
        let kept = |field| self.kept.contains(field);
        let selected = Sample {
            id: sample.id.clone(),
            sensor_id: sample.sensor_id.clone(),
            unit_id: sample.unit_id.clone().filter(|_| kept(Field::UnitId)),
            scene_id: sample.scene_id.clone().filter(|_| kept(Field::Scene)),
            point_id: sample.point_id.clone().filter(|_| kept(Field::Point)),
            depth_step: sample.depth_step.filter(|_| kept(Field::DepthStep)),
            repeat: sample.repeat.filter(|_| kept(Field::Repeat)),
            phase: sample.phase.filter(|_| kept(Field::Phase)),
            // These fields are always kept: like the id, they have no `Field`.
            limited_by: sample.limited_by,
            zero_u_mm: sample.zero_u_mm,
            stamp: sample.stamp.filter(|_| kept(Field::Stamp)),
            kind: sample.kind.filter(|_| kept(Field::Kind)),
            spacing: sample.spacing.filter(|_| kept(Field::Spacing)),
            predicted_spacing: sample
                .predicted_spacing
                .filter(|_| kept(Field::PredictedSpacing)),
            intensity: sample.intensity.filter(|_| kept(Field::Intensity)),
            frame_digest: sample
                .frame_digest
                .clone()
                .filter(|_| kept(Field::FrameDigest)),
            frame: sample.frame.clone().filter(|_| kept(Field::Frame)),
            signals: sample.signals.clone().filter(|_| kept(Field::Signals)),
            truth: if kept(Field::Truth) {
                sample.truth.clone()
            } else {
                Default::default()
            },
            prediction: sample
                .prediction
                .clone()
                .filter(|_| kept(Field::Prediction)),
        };
        self.inner.accept(&selected)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Keep(Vec<Sample>);

    impl SampleSink for Keep {
        fn fields(&self) -> FieldSet {
            FieldSet::PAIRS.with(Field::Repeat)
        }
        fn accept(&mut self, sample: &Sample) -> Result<(), SinkError> {
            self.0.push(sample.clone());
            Ok(())
        }
    }

    #[test]
    fn a_tee_asks_for_what_either_reads_and_feeds_both() {
        let mut tee = Tee {
            first: Keep(Vec::new()),
            second: Select::new(Keep(Vec::new()), FieldSet::EMPTY),
        };
        assert_eq!(tee.fields(), FieldSet::PAIRS.with(Field::Repeat));
        tee.accept(&Sample {
            id: "a".into(),
            repeat: Some(3),
            ..Sample::default()
        })
        .expect("kept");
        assert_eq!(tee.first.0[0].repeat, Some(3));
        assert_eq!(tee.second.inner.0[0].repeat, None);
    }
}
