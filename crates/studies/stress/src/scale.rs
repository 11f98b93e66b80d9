//! Change of pictures by contact, which is the unit of the strength of faults.

use taceva_core::{Frame, Unit};
use taceva_dataset::Dataset;
use taceva_evaluate::EvaluateError;

/// Maximum number of pictures of contact that are compared with the untouched picture.
pub(crate) const PICTURES: usize = 32;
/// Load, as a fraction of the greatest load, above which the checks of `taceva check` take a picture as a picture of contact.
const PRESSED: f64 = 0.5;

/// Untouched picture, and the change of pictures by contact.
///
/// # Units
/// A change is a mean over all pixel values of a picture, as a fraction of full scale.
#[derive(Default)]
pub(crate) struct Scale {
    /// Picture without contact: the reference of the recording, or else the picture with the least load.
    pub(crate) untouched: Option<Frame>,
    /// True if the untouched picture is the reference of the recording.
    pub(crate) is_reference: bool,
    /// Mean change by contact; `None` if it is unknown or zero.
    pub(crate) contact: Option<f64>,
    /// Mean change between successive pictures among the compared pictures.
    pub(crate) successive: f64,
    /// Pictures whose load is at least half of the greatest load.
    pub(crate) pressed: Vec<Frame>,
    /// Number of decoded pictures.
    pub(crate) decoded: u64,
}

impl Scale {
    /// Measures the change by contact in the pictures of `rows`. Decodes at most [`PICTURES`] of them, and the untouched picture.
    pub(crate) fn of(dataset: &Dataset, rows: &[usize]) -> Result<Scale, EvaluateError> {
        let loads = Loads::of(dataset, rows);
        let picked = loads.picked();
        let mut frames = Vec::new();
        for load in &picked {
            if let Some(frame) = dataset.frame(load.row)? {
                frames.push((load.load, frame));
            }
        }
        let alone = Scale::untouched(dataset, rows)?;
        let changes = alone.untouched.iter().flat_map(|untouched| {
            let frames = frames.iter();
            frames.map(move |(_, frame)| difference(frame, untouched))
        });
        let contact = mean(changes).filter(|change| *change > 0.0);
        let pairs = frames.windows(2);
        let successive = mean(pairs.map(|pair| difference(&pair[0].1, &pair[1].1)));
        let greatest = frames.iter().map(|(load, _)| *load).fold(0.0, f64::max);
        let pressed = frames
            .into_iter()
            .filter(|(load, _)| greatest > 0.0 && *load >= PRESSED * greatest)
            .map(|(_, frame)| frame)
            .collect();
        Ok(Scale {
            contact,
            successive: successive.unwrap_or(0.0),
            pressed,
            decoded: alone.decoded + picked.len() as u64,
            ..alone
        })
    }

    /// Reads only the untouched picture. Without a reference, this is the picture with the least load among `rows`.
    pub(crate) fn untouched(dataset: &Dataset, rows: &[usize]) -> Result<Scale, EvaluateError> {
        let reference = dataset.reference()?;
        let is_reference = reference.is_some();
        let (untouched, decoded) = match (reference, least_loaded(dataset, rows)) {
            (Some(reference), _) => (Some(reference), 0),
            (None, Some(row)) => (dataset.frame(row)?, 1),
            (None, None) => (None, 0),
        };
        Ok(Scale {
            untouched,
            is_reference,
            contact: None,
            successive: 0.0,
            pressed: Vec::new(),
            decoded,
        })
    }

    /// Untouched picture, if it is the reference of the recording.
    pub(crate) fn reference(&self) -> Option<&Frame> {
        self.untouched.as_ref().filter(|_| self.is_reference)
    }

    /// Origin of the untouched picture: `reference`, `least load` or `none`.
    pub(crate) fn source(&self) -> &'static str {
        match (&self.untouched, self.is_reference) {
            (Some(_), true) => "reference",
            (Some(_), false) => "least load",
            (None, _) => "none",
        }
    }
}

/// Mean absolute difference over all pixel values of two pictures, a fraction of full scale; 0 if size or format differs.
pub(crate) fn difference(one: &Frame, other: &Frame) -> f64 {
    if one.info() != other.info() || one.bytes().is_empty() {
        return 0.0;
    }
    let pairs = one.samples().zip(other.samples());
    let sum: u64 = pairs
        .map(|(one, other)| u64::from(one.abs_diff(other)))
        .sum();
    let format = one.info().format;
    let numbers = one.bytes().len() / format.bytes_per_sample();
    sum as f64 / (numbers as f64 * f64::from(format.full_scale()))
}

/// Mean; `None` for no numbers.
pub(crate) fn mean(numbers: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) = numbers.fold((0.0, 0.0), |(sum, count), number| {
        (sum + number, count + 1.0)
    });
    (count > 0.0).then_some(sum / count)
}

/// Row of a recording. `is_contact` is true if the gel is in contact.
pub(crate) struct Touch {
    pub(crate) row: usize,
    pub(crate) is_contact: bool,
}

/// Contact state of each of `rows` with a known load, in order; `None` for a recording without the channel `Fz` or `Pz`.
pub(crate) fn touches(dataset: &Dataset, rows: &[usize]) -> Option<Vec<Touch>> {
    Loads::of(dataset, rows).touches()
}

/// Row of the greatest load among `rows`; the last row if no load is known.
pub(crate) fn most_loaded(dataset: &Dataset, rows: &[usize]) -> Option<usize> {
    let loads = Loads::of(dataset, rows).rows.into_iter();
    let most = loads.max_by(|one, other| one.load.total_cmp(&other.load));
    most.map(|load| load.row)
}

/// Rows of contact among `rows`, at most [`PICTURES`], evenly spaced in the order of the rows.
pub(crate) fn contact_rows(dataset: &Dataset, rows: &[usize]) -> Vec<usize> {
    let loads = Loads::of(dataset, rows);
    loads.picked().iter().map(|load| load.row).collect()
}

/// Row of the least load among `rows`, if loads are known.
pub(crate) fn least_loaded(dataset: &Dataset, rows: &[usize]) -> Option<usize> {
    Loads::of(dataset, rows).least()
}

/// Row of a recording with its load.
struct Load {
    row: usize,
    load: f64,
}

/// Loads of rows: the absolute force `Fz`, or the depth `Pz` without a channel `Fz`.
struct Loads {
    /// Rows with a load, in order. Without a channel of loads, all rows with a load of 0.
    rows: Vec<Load>,
    /// Greatest load of a picture without contact; `None` without a channel of loads.
    untouched_to: Option<f64>,
}

impl Loads {
    fn of(dataset: &Dataset, rows: &[usize]) -> Loads {
        let channels = dataset.table().channels();
        let position = |name| channels.position(name);
        let Some(position) = ["Fz", "Pz"].into_iter().find_map(position) else {
            let rows = rows.iter().map(|&row| Load { row, load: 0.0 });
            return Loads {
                rows: rows.collect(),
                untouched_to: None,
            };
        };
        let truth = dataset.table().truth(position);
        let load = |&row: &usize| {
            Some(Load {
                row,
                load: truth.get(row)?.abs(),
            })
        };
        let untouched_to = match channels.as_slice()[position].unit() {
            Unit::Millimetre => 0.01,
            _ => 0.02,
        };
        Loads {
            rows: rows.iter().filter_map(load).collect(),
            untouched_to: Some(untouched_to),
        }
    }

    /// Rows in contact, at most [`PICTURES`], evenly spaced in the order of the rows.
    fn picked(&self) -> Vec<&Load> {
        let least = self.untouched_to.unwrap_or(-1.0);
        let contact: Vec<&Load> = self.rows.iter().filter(|load| load.load > least).collect();
        let every = contact.len().div_ceil(PICTURES).max(1);
        contact.into_iter().step_by(every).collect()
    }

    /// Contact state of each row with a known load; `None` without a channel of loads.
    fn touches(&self) -> Option<Vec<Touch>> {
        let untouched_to = self.untouched_to?;
        let rows = self.rows.iter().map(|load| Touch {
            row: load.row,
            is_contact: load.load > untouched_to,
        });
        Some(rows.collect())
    }

    /// Row of the least load, if loads are known.
    fn least(&self) -> Option<usize> {
        self.untouched_to?;
        let least = self
            .rows
            .iter()
            .min_by(|one, other| one.load.total_cmp(&other.load));
        least.map(|load| load.row)
    }
}
