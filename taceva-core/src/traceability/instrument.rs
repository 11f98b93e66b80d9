//! The instruments whose certificates make labels traceable.

use crate::display::display;
use crate::unit::Unit;

/// Instrument that can have a certificate: it measures labels, or is the tactile sensor itself.
///
/// ```
/// use taceva_core::{Instrument, Unit};
/// assert_eq!(Instrument::Force.to_string(), "force");
/// assert_eq!(Instrument::Force.unit_of("Fz"), Some(Unit::Newton));
/// assert_eq!(Instrument::Force.unit_of("Pz"), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
#[non_exhaustive]
pub enum Instrument {
    /// Force transducer, for forces and torques.
    Force,
    /// Robot, for positions and angles.
    Robot,
    /// Tactile sensor, for forces, torques, positions and angles.
    Sensor,
}

/// Channels that a certificate can state, with their units.
const CHANNELS: [(&str, Unit); 13] = [
    ("Fx", Unit::Newton),
    ("Fy", Unit::Newton),
    ("Fz", Unit::Newton),
    ("Tx", Unit::NewtonMillimetre),
    ("Ty", Unit::NewtonMillimetre),
    ("Tz", Unit::NewtonMillimetre),
    ("Px", Unit::Millimetre),
    ("Py", Unit::Millimetre),
    ("Pz", Unit::Millimetre),
    ("Rx", Unit::Degree),
    ("Ry", Unit::Degree),
    ("Rz", Unit::Degree),
    ("tilt", Unit::Degree),
];

impl Instrument {
    /// Every instrument.
    pub const ALL: [Instrument; 3] = [Instrument::Force, Instrument::Robot, Instrument::Sensor];

    /// Name of the instrument's table in files.
    pub const fn name(self) -> &'static str {
        match self {
            Instrument::Force => "force",
            Instrument::Robot => "robot",
            Instrument::Sensor => "sensor",
        }
    }

    /// Name of the instrument in sentences.
    pub const fn noun(self) -> &'static str {
        match self {
            Instrument::Force => "force transducer",
            Instrument::Robot => "robot",
            Instrument::Sensor => "sensor",
        }
    }

    /// Channels that a certificate of the instrument can state, with their units.
    pub fn channels(self) -> impl Iterator<Item = (&'static str, Unit)> {
        let channels = CHANNELS.into_iter();
        channels.filter(move |(_, unit)| self.measures(*unit))
    }

    /// Unit of `channel` in a certificate; `None` if a certificate of this instrument cannot state the channel.
    pub fn unit_of(self, channel: &str) -> Option<Unit> {
        let mut channels = self.channels();
        channels.find_map(|(known, unit)| (known == channel).then_some(unit))
    }

    fn measures(self, unit: Unit) -> bool {
        let is_force = matches!(unit, Unit::Newton | Unit::NewtonMillimetre);
        match self {
            Instrument::Force => is_force,
            Instrument::Robot => !is_force,
            Instrument::Sensor => true,
        }
    }
}

display!(Instrument, name);
