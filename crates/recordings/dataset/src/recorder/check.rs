//! Checks of samples before anything is written.

use taceva_core::{Frame, MAGNITUDE_MAX, Sample, SignalInfo, Signals, is_scorable};

use super::Recorder;
use crate::error::DatasetError;

impl Recorder {
    pub(super) fn check(&self, sample: &Sample) -> Result<(), DatasetError> {
        let refused = |problem: String| DatasetError::sample(&sample.id, problem);
        if sample.id.is_empty() || self.has(&sample.id) {
            return Err(refused("the name is empty or taken".to_owned()));
        }
        let (values, channels) = (sample.truth.as_slice(), self.table.channels());
        if values.len() > channels.len() {
            return Err(refused(format!(
                "{} values, expected at most {}, one per channel",
                values.len(),
                channels.len()
            )));
        }
        let times = sample.stamp.iter().map(|stamp| stamp.valid_s);
        let numbers = values.iter().copied().flatten().chain(times);
        let mut numbers = numbers.chain(sample.zero_u_mm);
        if let Some(number) = numbers.find(|number| !is_scorable(*number)) {
            return Err(refused(format!(
                "{number:e} is not a finite number up to {MAGNITUDE_MAX:.3e}"
            )));
        }
        let expected = self.signals.as_ref().map(|writer| writer.spec().info);
        let found = sample.signals.as_ref().map(Signals::info);
        if expected != found {
            let named = |info: Option<SignalInfo>| match info {
                Some(info) => format!("signals of {info}"),
                None => "no signals".to_owned(),
            };
            return Err(refused(format!(
                "{}, expected {} as in the recording",
                named(found),
                named(expected)
            )));
        }
        match &sample.frame {
            Some(frame) => self.check_frame(&sample.id, frame),
            None => Ok(()),
        }
    }

    pub(super) fn check_frame(&self, id: &str, frame: &Frame) -> Result<(), DatasetError> {
        let refused = |problem: String| Err(DatasetError::sample(id, problem));
        if let Some(reduced) = &self.reduced
            && !reduced.may_give(frame.info())
        {
            let (found, from) = (frame.info(), reduced.from);
            let eight_bits = from.format.of_eight_bits().name();
            return refused(format!(
                "a frame of {found}, expected a frame reduced from {from}: no larger, and in {eight_bits}"
            ));
        }
        match self.frame_info {
            Some(expected) if expected != frame.info() => refused(format!(
                "a frame of {}, expected {expected}, as in the first frame",
                frame.info()
            )),
            _ => Ok(()),
        }
    }
}
