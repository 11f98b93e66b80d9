//! Kinds of faults.

use taceva_dataset::Leds;

use crate::canvas::{Canvas, Realisation};
use crate::labels::LabelChange;
use crate::taxels::TaxelChange;

/// Set of pictures that share the random numbers of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// No random numbers: the same change in every picture.
    Fixed,
    /// Places drawn once: the same pixels in every picture.
    Drawn,
    /// Drawn for each picture.
    Each,
}

/// Fault of pictures, signals, labels or rows. The result depends only on the original values, the parameter, the seed and the sample name.
#[derive(Debug)]
pub struct Fault {
    /// Name of the fault, such as `defocus`.
    pub id: &'static str,
    /// Cause and appearance, in one line.
    pub title: &'static str,
    /// Meaning and unit of the parameter. At 0, the fault changes nothing.
    pub parameter: &'static str,
    /// Set of pictures that share the random numbers of the fault.
    pub scope: Scope,
    /// Parameters of severities 1 to 5, used if the parameter sets the severity and not the change of the picture.
    pub table: [f64; 5],
    /// Greatest allowed parameter of the fault.
    pub most: f64,
    /// Sentence about a limitation of the scores of the fault, for readers of the report; `None` without a limitation.
    pub note: Option<&'static str>,
    pub(crate) effect: Effect,
}

/// Change that a fault makes.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Effect {
    /// Changes the pixel values of the picture.
    Numbers(fn(&mut Canvas, &Realisation)),
    /// Changes the pixel values. The parameter grows with the time of the sample, from 0 at the first row to its full value at the last row.
    Growing(fn(&mut Canvas, &Realisation)),
    /// Changes the pixel values at the positions of the markers on the gel.
    Markers(fn(&mut Canvas, &Realisation, &Markers)),
    /// Changes the pixel values of the colours of lost LEDs.
    Leds(fn(&mut Canvas, &Realisation, Leds)),
    /// Replaces the picture by the picture of the previous sample.
    Before,
    /// Changes the labels, and no picture.
    Labels(LabelChange),
    /// Changes the signals of taxels.
    Taxels(TaxelChange),
    /// Removes rows (samples) of the recording.
    Rows,
}

/// Markers of one picture.
pub(crate) struct Markers {
    /// Column and row of each marker in the untouched picture, in pixels from the centre of the top left pixel.
    pub(crate) places_px: Vec<[f64; 2]>,
    /// Typical distance between neighbouring markers, pixels.
    pub(crate) spacing_px: f64,
}

impl Fault {
    /// True if the fault changes labels, and no picture. Its severity is then set by its parameter.
    pub fn is_of_labels(&self) -> bool {
        self.label_change().is_some()
    }

    /// True if the fault changes signals of taxels, and no picture. Its severity is then set by its parameter.
    pub fn is_of_taxels(&self) -> bool {
        matches!(self.effect, Effect::Taxels(_))
    }

    /// True if the fault removes rows (samples), and so changes only the times between rows. Its severity is then set by its parameter.
    pub fn is_of_rows(&self) -> bool {
        matches!(self.effect, Effect::Rows)
    }

    /// True if the fault changes pictures.
    pub(crate) fn is_of_pictures(&self) -> bool {
        !self.is_of_labels() && !self.is_of_taxels() && !self.is_of_rows()
    }

    /// Change of labels; `None` for any other fault.
    pub(crate) fn label_change(&self) -> Option<LabelChange> {
        match self.effect {
            Effect::Labels(change) => Some(change),
            _ => None,
        }
    }

    /// True if the fault changes pictures, and more so in later samples.
    pub(crate) fn grows(&self) -> bool {
        matches!(self.effect, Effect::Growing(_))
    }

    /// True if the fault changes pictures or signals, and more so in later samples.
    pub(crate) fn needs_times(&self) -> bool {
        match self.effect {
            Effect::Growing(_) => true,
            Effect::Taxels(change) => change.grows,
            _ => false,
        }
    }

    /// True if the fault changes the light of LEDs.
    pub(crate) fn is_of_leds(&self) -> bool {
        matches!(self.effect, Effect::Leds(_))
    }

    /// True if the fault changes markers.
    pub(crate) fn is_of_markers(&self) -> bool {
        matches!(self.effect, Effect::Markers(_))
    }
}

/// Note in the report on faults of labels.
pub(crate) const NO_STIMULUS: &str =
    "the fault changes only labels, so its stimulus is undefined; its severity is its parameter";

/// Note in the report on faults of a gel that are drawn at the same pixels of every picture.
pub(crate) const LIES_STILL: &str = "the fault lies still in the picture, but moves with the contact on a real gel: errors after a new untouched picture are lower bounds";
