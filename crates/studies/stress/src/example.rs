//! Example pictures: the picture of one sample, with each fault of pictures at each severity.

use taceva_core::Frame;
use taceva_dataset::Dataset;
use taceva_evaluate::EvaluateError;
use taceva_models::MarkerTracker;

use crate::faults::{FAULTS, RECORDING_FAULTS};
use crate::report::StressReport;
use crate::samples::shares;
use crate::scale::{Scale, most_loaded};
use crate::stress::Stress;

/// One sample of a recording, whose picture gets the tested faults.
///
/// ```no_run
/// use taceva_dataset::Dataset;
/// use taceva_stress::{Examples, StressReport};
///
/// fn print(dataset: &Dataset, report: &StressReport) -> Result<(), Box<dyn std::error::Error>> {
///     let examples = Examples::of(dataset, report)?;
///     for (name, frame) in examples.pictures() {
///         println!("{name}: {}", frame.info());
///     }
///     Ok(())
/// }
/// ```
#[derive(Debug)]
pub struct Examples {
    sample: String,
    frame: Frame,
    /// Picture of the previous sample among the scored samples; `None` if there is none.
    before: Option<Frame>,
    /// Time of the sample as a fraction of the duration of the recording, from 0 to 1.
    share: f64,
    markers: Option<MarkerTracker>,
    /// Severity, and the fault at this severity, for each tested pair.
    cells: Vec<(u8, Stress<'static>)>,
}

impl Examples {
    /// Chooses the sample with the greatest load among the samples of `report`, which [`stress`](crate::stress()) made of `dataset`. Decodes at most
    /// three pictures.
    ///
    /// # Errors
    /// [`EvaluateError`] if a picture cannot be read, or the report has no sample.
    pub fn of(dataset: &Dataset, report: &StressReport) -> Result<Examples, EvaluateError> {
        let rows = &report.basis.rows;
        let lacks = || EvaluateError::Request("the report has no scored picture".to_owned());
        let row = most_loaded(dataset, rows).ok_or_else(lacks)?;
        let frame = dataset.frame(row)?.ok_or_else(lacks)?;
        let before = rows.iter().rev().find(|other| **other < row);
        let before = before.map(|before| dataset.frame(*before)).transpose()?;
        let known = || FAULTS.into_iter().chain(RECORDING_FAULTS);
        let pictured = report.faults.iter().filter_map(|of| {
            let mut known = known().filter(|fault| !fault.is_of_labels());
            Some((known.find(|fault| fault.id == of.id)?, of))
        });
        let cells = pictured.flat_map(|(fault, of)| {
            let severities = of.severities.iter();
            severities.map(move |of| {
                let stress = Stress::new(fault, of.parameter, report.seed);
                (of.severity, stress.with_leds(dataset.header().sensor.leds))
            })
        });
        let cells: Vec<(u8, Stress<'static>)> = cells.collect();
        let has_markers = cells.iter().any(|(_, of)| of.fault().is_of_markers());
        let untouched = match has_markers {
            true => Scale::untouched(dataset, rows)?.untouched,
            false => None,
        };
        Ok(Examples {
            sample: dataset.table().samples()[row].clone(),
            frame,
            before: before.flatten(),
            share: shares(dataset, rows).map_or(1.0, |shares| shares[row]),
            markers: untouched.and_then(|of| MarkerTracker::new(&of).ok()),
            cells,
        })
    }

    /// Name of the sample.
    pub fn sample(&self) -> &str {
        &self.sample
    }

    /// Named pictures: `clean` without a fault, then one for each fault and severity, such as `tear-3`. Of several draws, only the first is used.
    pub fn pictures(&self) -> impl Iterator<Item = (String, Frame)> {
        let clean = ("clean".to_owned(), self.frame.clone());
        let faulty = self.cells.iter().map(move |(severity, stress)| {
            let name = format!("{}-{severity}", stress.fault().id);
            let stress = stress.with_markers(self.markers.as_ref()).at(self.share);
            let picture = stress.apply(&self.frame, &self.sample, self.before.as_ref());
            (name, picture)
        });
        [clean].into_iter().chain(faulty)
    }
}
