//! Monitor of a sensor in use: untouched pictures are compared with earlier untouched pictures, and pictures of contact with the training pictures.

mod baseline;
mod change;
mod level;
mod limit;
mod lines;
mod recording;

use std::collections::{BTreeSet, VecDeque};

use taceva_core::{Frame, shown};
use taceva_dataset::Dataset;
use taceva_evaluate::{EvaluateError, Need, model_extractor, usable};
use taceva_models::{Extractor, FeatureDistance, Model};

pub use self::change::{Alarm, Change};
pub use self::recording::watch;

use self::baseline::Baseline;
use self::level::Level;
use self::limit::{LEARNT, Limited, WINDOW};
use self::lines::line_change;
use crate::scale::Scale;

/// Number of pictures whose mean is the baseline.
const SETTLED: u32 = 50;
/// Least stimulus that counts as a change of pattern.
const PATTERN: f64 = 0.1;
/// Least stimulus that counts as a change of detail. Noise hides most of such a change.
const DETAIL: f64 = 0.05;
/// Least stimulus of one line between successive pictures that counts as a change of lines.
const LINES: f64 = 0.5;
/// Stimulus of the baseline above which it differs from the reference. Flicker of a single reference picture is below this stimulus.
const REFERENCE: f64 = 1.0;
/// Number of repeats among the newest pictures that counts as a change.
const REPEATS: usize = 3;
/// Number of contact pictures unlike the training pictures, among the newest, that counts as a change.
const OUTSIDE: usize = 20;

/// Monitor of a sensor in use.
///
/// The mean of the first 50 untouched pictures is the baseline, and the next 200 set the limits. From then on a change is found if at least 19 of the
/// newest 30 untouched pictures, or their mean brightness, exceed a limit. A change is also found if a line of three of them differs strongly from
/// this line in the previous picture. Each kind of change is reported once. After its remedy, create a new monitor.
///
/// ```
/// use taceva_core::{Frame, FrameInfo, PixelFormat};
/// use taceva_stress::{Change, Monitor};
/// let info = FrameInfo { width: 4, height: 4, format: PixelFormat::Gray8 };
/// let picture = |light: u8, number: u8| {
///     let noise = (0..16).map(|pixel| light + pixel * (number % 7) % 3);
///     Frame::new(info, noise.collect())
/// };
/// // Contact changes pictures by 10 of 255.
/// let mut monitor = Monitor::new(picture(100, 0)?, 10.0 / 255.0)?;
/// for number in 0..250 {
///     assert!(monitor.untouched(&picture(100, number)?)?.is_empty());
/// }
/// let mut found = Vec::new();
/// for number in 0..30 {
///     found.extend(monitor.untouched(&picture(110, number)?)?);
/// }
/// assert_eq!(found[0].change, Change::Brightness);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Monitor {
    reference: Frame,
    contact: f64,
    /// Sum of each pixel value over the first untouched pictures, for the baseline.
    sums: Vec<u32>,
    settled: u32,
    baseline: Option<Baseline>,
    level: Level,
    pattern: Limited,
    detail: Limited,
    lines: Limited,
    before: Option<Frame>,
    /// True if a picture repeated the previous picture while the limits were set. Repeats are then no change.
    has_repeats: bool,
    repeats: Newest,
    training: Option<Training>,
    /// Number of untouched pictures of the calibration; `None` if the monitor does not learn from them.
    calibration: Option<usize>,
    untouched: u64,
    /// Number of untouched pictures that were compared with the limits.
    compared: u64,
    touched: u64,
    found: BTreeSet<Change>,
}

/// Training pictures of a model, with the newest pictures of contact.
#[derive(Clone, Debug)]
struct Training {
    model: Model,
    extractor: Extractor,
    outside: Newest,
}

/// Marks of the newest pictures.
#[derive(Clone, Debug, Default)]
struct Newest(VecDeque<bool>);

impl Newest {
    /// Takes the next mark. Returns the number of marks among the newest pictures.
    fn push(&mut self, is_marked: bool) -> usize {
        if self.0.len() == WINDOW {
            self.0.pop_front();
        }
        self.0.push_back(is_marked);
        self.0.iter().filter(|is_marked| **is_marked).count()
    }
}

impl Monitor {
    /// Number of untouched pictures that set the baseline and the limits.
    pub const PICTURES: usize = SETTLED as usize + LEARNT;
    /// Least number of untouched pictures of a calibration that set the baseline and the limits. Their limits may be wider.
    pub const LEAST_PICTURES: usize = 2 * SETTLED as usize;

    /// A monitor with the untouched picture `reference` of the calibration. `contact` is the mean change of pictures by contact, a share of full scale.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] for an empty picture, or a change that is not above 0.
    pub fn new(reference: Frame, contact: f64) -> Result<Monitor, EvaluateError> {
        let numbers = reference.samples().count();
        if numbers == 0 {
            return Err(EvaluateError::Request(
                "the reference has no pixels, expected an untouched picture".to_owned(),
            ));
        }
        if !(contact.is_finite() && contact > 0.0) {
            return Err(EvaluateError::Request(format!(
                "mean change of pictures by contact: found {contact}, expected a share of full scale above 0"
            )));
        }
        Ok(Monitor {
            reference,
            contact,
            sums: vec![0; numbers],
            settled: 0,
            baseline: None,
            level: Level::default(),
            pattern: Limited::by_most(PATTERN),
            detail: Limited::by_most(DETAIL),
            lines: Limited::by_some(LINES),
            before: None,
            has_repeats: false,
            repeats: Newest::default(),
            training: None,
            calibration: None,
            untouched: 0,
            compared: 0,
            touched: 0,
            found: BTreeSet::new(),
        })
    }

    /// A monitor for the unit of `dataset`, the recording of its calibration: with its reference and its change by contact. Reads at most 33 pictures.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] for several recordings, or a recording without a reference, pictures or contact. Errors of reading.
    pub fn of(dataset: &Dataset) -> Result<Monitor, EvaluateError> {
        let refused = |words: &str| {
            let path = shown(dataset.path());
            Err(EvaluateError::Request(format!("{path}: {words}")))
        };
        if !dataset.recordings().is_empty() {
            return refused("several recordings, expected one, because each has its own reference");
        }
        dataset.require_view()?;
        let scale = Scale::of(dataset, &framed(dataset))?;
        let contact = scale.contact;
        match (scale.untouched.filter(|_| scale.is_reference), contact) {
            (None, _) => refused(
                "the recording has no reference, expected a picture without contact; `taceva capture` records it, and a map names it as `reference`",
            ),
            (_, None) => refused(
                "no picture of contact differs from the reference, so no change can be compared with contact; name a recording with presses",
            ),
            (Some(reference), Some(contact)) => Monitor::new(reference, contact),
        }
    }

    /// Also compares pictures of contact with the training pictures of `model`. `dataset` is the recording of the calibration. A model without
    /// training pictures has no effect.
    ///
    /// # Errors
    /// [`EvaluateError::Unsuited`] if the model does not suit the pictures.
    pub fn with_model(self, model: Model, dataset: &Dataset) -> Result<Monitor, EvaluateError> {
        let is_known = model.reads_frames() && model.feature_distance().is_some();
        let training = is_known.then(|| -> Result<Training, EvaluateError> {
            let extractor = model_extractor(dataset, &model)?;
            Ok(Training {
                model,
                extractor,
                outside: Newest::default(),
            })
        });
        Ok(Monitor {
            training: training.transpose()?,
            ..self
        })
    }

    /// Number of untouched pictures until changes are found.
    pub fn missing(&self) -> usize {
        let settled = SETTLED - self.settled;
        settled as usize + self.pattern.missing()
    }

    /// Least stimulus of brightness, pattern, detail and single lines that is found. `None` while untouched pictures are [missing](Monitor::missing).
    pub fn smallest(&self) -> Option<[f64; 4]> {
        Some([
            self.level.smallest()?,
            self.pattern.smallest()?,
            self.detail.smallest()?,
            self.lines.smallest()?,
        ])
    }

    /// Expected number of false alarms in `pictures` untouched pictures, an upper bound for limits that 200 pictures set. Fewer pictures raise it.
    ///
    /// The bound assumes that untouched pictures do not drift and are exchangeable. Its brightness term assumes normally distributed flicker. Its
    /// pattern and detail terms hold for every distribution. It has no term for single lines: no alarm is expected if their noise has no outliers.
    /// Flicker that is similar in successive pictures causes more alarms (docs/faults.md).
    ///
    /// ```
    /// assert!(taceva_stress::Monitor::false_alarms(300_000) < 0.001);
    /// ```
    pub fn false_alarms(pictures: u64) -> f64 {
        2.0 * limit::false_alarms(pictures) + level::false_alarms(pictures)
    }

    /// Number of untouched pictures, and of pictures of contact.
    pub fn pictures(&self) -> [u64; 2] {
        [self.untouched, self.touched]
    }

    /// Number of untouched pictures of the calibration; `None` unless the monitor was to [learn from it](Monitor::learn_from).
    pub fn calibration_pictures(&self) -> Option<usize> {
        self.calibration
    }

    /// True if the pictures can show that nothing has changed: at least 30 untouched pictures were compared with the limits. If the monitor was to
    /// learn from the calibration, the calibration must have enough untouched pictures.
    ///
    /// ```
    /// use taceva_core::{Frame, FrameInfo, PixelFormat};
    /// let info = FrameInfo { width: 4, height: 4, format: PixelFormat::Gray8 };
    /// let monitor = taceva_stress::Monitor::new(Frame::new(info, vec![9; 16])?, 0.1)?;
    /// assert!(!monitor.is_decided());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn is_decided(&self) -> bool {
        let is_enough = |pictures: usize| pictures >= Monitor::LEAST_PICTURES;
        self.calibration.is_none_or(is_enough) && self.compared >= WINDOW as u64
    }

    /// All changes found.
    pub fn found(&self) -> &BTreeSet<Change> {
        &self.found
    }

    /// Takes the next untouched picture. Returns the changes that it shows for the first time.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] for a picture of another size or format than the reference.
    pub fn untouched(&mut self, frame: &Frame) -> Result<Vec<Alarm>, EvaluateError> {
        self.require_kind(frame)?;
        self.untouched += 1;
        let before = self.before.replace(frame.clone());
        let is_repeat = before.as_ref().is_some_and(|before| before == frame);
        let line = before.map_or(0.0, |before| line_change(&before, frame));
        let is_learning = self.missing() > 0;
        let number = self.untouched;
        let mut alarms = Vec::new();
        match &self.baseline {
            None => {
                let stimulus = self.settle(frame);
                alarms.extend(Alarm::of(Change::Reference, number, stimulus));
            }
            Some(baseline) => {
                let difference = baseline.difference(frame);
                let level = self.level.push(difference.level / self.contact);
                let pattern = self.pattern.push(difference.pattern / self.contact);
                let detail = self.detail.push(difference.detail / self.contact);
                alarms.extend(Alarm::of(Change::Brightness, number, level));
                alarms.extend(Alarm::of(Change::Pattern, number, pattern));
                alarms.extend(Alarm::of(Change::Detail, number, detail));
                let lines = self.lines.push(line / self.contact);
                alarms.extend(Alarm::of(Change::Lines, number, lines));
            }
        }
        match is_learning {
            true => self.has_repeats |= is_repeat,
            false => {
                self.compared += 1;
                let repeats = self.repeats.push(is_repeat);
                let is_change = repeats >= REPEATS && !self.has_repeats;
                let strength = is_change.then(|| share(repeats));
                alarms.extend(Alarm::of(Change::Repeats, number, strength));
            }
        }
        Ok(self.first(alarms))
    }

    /// Takes the next picture of contact. Returns the change that it shows for the first time.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] for a picture of another size or format than the reference.
    pub fn touched(&mut self, frame: &Frame) -> Result<Vec<Alarm>, EvaluateError> {
        self.require_kind(frame)?;
        self.touched += 1;
        self.before = None;
        let Some(training) = &mut self.training else {
            return Ok(Vec::new());
        };
        let features = training.extractor.extract_all([frame])?;
        let distances = training.model.distances(&features)?;
        let mut distances = distances.into_iter().flatten();
        let outside = training
            .outside
            .push(distances.any(FeatureDistance::is_outside));
        let strength = (outside >= OUTSIDE).then(|| share(outside));
        let alarm = Alarm::of(Change::Contact, self.touched, strength);
        Ok(self.first(alarm.into_iter().collect()))
    }

    /// Adds a picture to the baseline. Returns the stimulus of the finished baseline if it differs from the reference.
    fn settle(&mut self, frame: &Frame) -> Option<f64> {
        for (sum, number) in self.sums.iter_mut().zip(frame.samples()) {
            *sum += u32::from(number);
        }
        self.settled += 1;
        if self.settled < SETTLED {
            return None;
        }
        let baseline = Baseline::new(frame.info(), &self.sums, self.settled);
        let difference = baseline.difference(&self.reference);
        let stimulus = (difference.level.abs() + difference.pattern) / self.contact;
        self.baseline = Some(baseline);
        (stimulus > REFERENCE).then_some(stimulus)
    }

    /// Alarms of changes that were not found before.
    fn first(&mut self, mut alarms: Vec<Alarm>) -> Vec<Alarm> {
        alarms.retain(|alarm| self.found.insert(alarm.change));
        alarms
    }

    fn require_kind(&self, frame: &Frame) -> Result<(), EvaluateError> {
        let (found, expected) = (frame.info(), self.reference.info());
        match found == expected {
            true => Ok(()),
            false => Err(EvaluateError::Request(format!(
                "a picture of {found}, expected {expected} as in the recording of the calibration: set the camera to that format, or calibrate again"
            ))),
        }
    }
}

/// Rows with a picture.
fn framed(dataset: &Dataset) -> Vec<usize> {
    let need = Need {
        frame: true,
        labels: None,
    };
    usable(dataset, &dataset.all_rows(), need)
}

/// `count` as a share of the newest pictures.
fn share(count: usize) -> f64 {
    count as f64 / WINDOW as f64
}
