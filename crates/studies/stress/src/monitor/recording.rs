//! Pictures of a recording for a monitor.

use taceva_core::{Frame, shown};
use taceva_dataset::{Dataset, Pass};
use taceva_evaluate::{EvaluateError, Work};

use super::change::Alarm;
use super::limit::WINDOW;
use super::{Monitor, SETTLED, framed};
use crate::scale::{Touch, touches};

/// Number of successive pictures in each run from which a monitor learns. Pictures far apart would hide that successive pictures are alike.
const RUN: usize = SETTLED as usize;

impl Monitor {
    /// Learns from untouched pictures of `dataset`, the recording of the calibration: five evenly spaced runs of 50 successive pictures, or all
    /// untouched pictures. Returns false if the recording has fewer than [`LEAST_PICTURES`](Monitor::LEAST_PICTURES) untouched pictures. The monitor
    /// then learns from the pictures that it watches. It finds an older change only if the change exceeds that by contact.
    ///
    /// # Errors
    /// Errors of reading.
    pub fn learn_from(&mut self, dataset: &Dataset, work: Work<'_>) -> Result<bool, EvaluateError> {
        let touches = touches(dataset, &framed(dataset)).unwrap_or_default();
        let untouched: Vec<usize> = touches
            .iter()
            .filter(|of| !of.is_contact)
            .map(|of| of.row)
            .collect();
        self.calibration = Some(untouched.len());
        if untouched.len() < Monitor::LEAST_PICTURES {
            return Ok(false);
        }
        let learnt = untouched.len().min(Monitor::PICTURES) / RUN * RUN;
        for limited in [&mut self.pattern, &mut self.detail, &mut self.lines] {
            limited.want(learnt - RUN);
        }
        self.level.want(learnt - RUN);
        let last = learnt / RUN - 1;
        let chosen = (0..learnt).map(|place| {
            let first = place / RUN * (untouched.len() - RUN) / last;
            untouched[first + place % RUN]
        });
        let chosen: Vec<usize> = chosen.collect();
        let pass = Pass::new(&chosen, work.jobs, work.progress);
        dataset.map_frames(
            pass,
            |_, frame: Frame| frame,
            |_, frame| {
                drop(self.untouched(&frame)?);
                Ok(())
            },
        )?;
        // Pictures of the calibration are no change, and were not watched.
        self.found.clear();
        (self.untouched, self.compared) = (0, 0);
        self.before = None;
        Ok(true)
    }
}

/// Passes the pictures of `dataset` to `monitor`, in the order of its rows. Calls `on_alarm` with each change and the name of its sample.
///
/// # Errors
/// [`EvaluateError::Request`] if the recording has no labels of force or depth, or too few untouched pictures. Errors of reading.
pub fn watch(
    dataset: &Dataset,
    monitor: &mut Monitor,
    work: Work<'_>,
    on_alarm: &mut dyn FnMut(&str, &Alarm),
) -> Result<(), EvaluateError> {
    let refused = |words: String| {
        let path = shown(dataset.path());
        Err(EvaluateError::Request(format!("{path}: {words}")))
    };
    if !dataset.recordings().is_empty() {
        return refused("several recordings, expected one; watch them one by one".to_owned());
    }
    dataset.require_view()?;
    let Some(touches) = touches(dataset, &framed(dataset)) else {
        return refused(
            "no labels of Fz or Pz: expected labels of one, to show which pictures are untouched"
                .to_owned(),
        );
    };
    let untouched = touches.iter().filter(|of| !of.is_contact).count();
    let least = monitor.missing() + WINDOW;
    if untouched < least {
        return refused(format!(
            "{untouched} untouched pictures with a label, expected at least {least}; record the sensor without contact, or name a recording with {} untouched pictures by --calibration",
            Monitor::LEAST_PICTURES
        ));
    }
    let rows: Vec<usize> = touches.iter().map(|of| of.row).collect();
    let samples = dataset.table().samples();
    let mut touches = touches.iter();
    let pass = Pass::new(&rows, work.jobs, work.progress);
    dataset.map_frames(
        pass,
        |_, frame: Frame| frame,
        |row, frame| {
            let alarms = match touches.next() {
                Some(Touch {
                    is_contact: true, ..
                }) => monitor.touched(&frame)?,
                _ => monitor.untouched(&frame)?,
            };
            alarms
                .iter()
                .for_each(|alarm| on_alarm(&samples[row], alarm));
            Ok(())
        },
    )?;
    Ok(())
}
