//! Input that a model reads from a recording: frames or signals.

use taceva_core::{Field, Frame, FrameInfo, Input, InputInfo, SignalInfo, Signals};
use taceva_dataset::{Dataset, DatasetError};
use taceva_models::{FeatureSpec, RecordedFrames};

/// The frames or signals of a recording, with the contact-free reference if requested.
pub(crate) enum Sight {
    Frames(FrameInfo, Option<Frame>),
    Signals(SignalInfo, Option<Signals>),
}

impl Sight {
    /// Selects the frames or signals of `dataset` that `spec` needs. If this input is missing, returns its name.
    ///
    /// # Errors
    /// Errors of reading the contact-free reference.
    pub(crate) fn of(
        dataset: &Dataset,
        spec: &FeatureSpec,
    ) -> Result<Result<Sight, &'static str>, DatasetError> {
        let (frame, signals) = kinds(dataset);
        let is_compared = spec.asks_for_reference().is_some();
        Ok(match (spec.channels.is_some(), frame, signals) {
            (false, Some(info), _) => {
                let reference = is_compared.then(|| dataset.reference()).transpose()?;
                Ok(Sight::Frames(info, reference.flatten()))
            }
            (true, _, Some(info)) => {
                let rest = is_compared.then(|| dataset.rest()).transpose()?;
                Ok(Sight::Signals(info, rest.flatten()))
            }
            (false, None, _) => Err("frames"),
            (true, _, None) => Err(Field::Signals.name()),
        })
    }

    /// Kind and size of the input.
    pub(crate) fn info(&self) -> InputInfo {
        match self {
            Sight::Frames(info, _) => (*info).into(),
            Sight::Signals(info, _) => (*info).into(),
        }
    }

    /// Contact-free reference, if requested and known.
    pub(crate) fn reference(&self) -> Option<Input<'_>> {
        match self {
            Sight::Frames(_, reference) => reference.as_ref().map(Input::from),
            Sight::Signals(_, rest) => rest.as_ref().map(Input::from),
        }
    }
}

/// Facts of the frames of `dataset` that affect features. Joined recordings have a reference only if every recording has a contact-free reference.
pub(crate) fn recorded_frames(dataset: &Dataset) -> Option<RecordedFrames> {
    let (frame, _) = kinds(dataset);
    let has_reference = |own: &Dataset| {
        let frames = own.header().frames.as_ref();
        frames.is_some_and(|frames| frames.reference.is_some())
    };
    let has_reference = match dataset.recordings() {
        [] => has_reference(dataset),
        joined => joined.iter().all(|own| has_reference(own.dataset())),
    };
    frame.map(|info| RecordedFrames {
        info,
        has_reference,
    })
}

/// Kinds of the frames and signals of `dataset`, if present.
pub(crate) fn kinds(dataset: &Dataset) -> (Option<FrameInfo>, Option<SignalInfo>) {
    let header = dataset.header();
    let frame = header.frames.as_ref().map(|frames| frames.info);
    let signals = header.signals.as_ref().map(|signals| signals.spec.info);
    (frame, signals)
}
