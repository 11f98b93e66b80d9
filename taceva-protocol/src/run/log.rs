//! What a run writes to: it learns what is finished, and waits until what it hands over is durable.

use taceva_core::{Sample, SinkError};

use crate::digest::Digest;

/// A record of finished presses that outlives the process.
pub trait PressLog {
    /// Whether `press` was appended, in this run or an earlier one.
    fn is_finished(&self, press: Digest) -> bool;

    /// Takes a whole press and returns once it is durable: all of it, or, after an interruption, none.
    ///
    /// # Errors
    /// Whatever keeps it from being durable; the run stops, and the press counts as not made.
    fn append(&mut self, record: &PressRecord) -> Result<(), SinkError>;
}

/// A finished press.
#[derive(Clone, Debug, PartialEq)]
pub struct PressRecord {
    /// Its name.
    pub press: Digest,
    /// How it ended.
    pub outcome: Outcome,
    /// Its samples in order, called `<press>/<number>`, where the number is that of the station or picture in the press: those that a
    /// limited press left out are not there.
    ///
    /// Truth is in the channels of the plan, in its order. `Pz` is the depth from the first contact, `surface_z` the height in the
    /// sensor's frame at which a surface was felt, positive into the gel; each is absent where the other is meant.
    pub samples: Vec<Sample>,
    /// The numbers of the samples that were taken where a limit of the gel stopped the tip on its way to the station: their labels and
    /// pictures are of the place that was reached, and they have no `depth_step`.
    pub limited: Vec<u32>,
}

/// How a press ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Outcome {
    /// Every station was visited.
    Complete,
    /// A limit of depth or force ended the way in. The station that was not reached has its sample where the tip rests within the limits;
    /// stations beyond are left out, and those of the way out are visited.
    Limited,
    /// Nothing was touched as far down as the search goes.
    NoContact,
}
