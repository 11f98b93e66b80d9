//! Channels, which are measured quantities: position and force of a contact, and extra quantities such as angles.

mod name;

use std::fmt;
use std::num::NonZeroU16;

use self::name::{ChannelName, NAME_MAX};
use crate::display::display;
use crate::unit::Unit;

/// One measured quantity: its name, its unit and, for an angle, its period.
///
/// # Units
/// `Px`, `Py` and `Pz` are in mm, `Fx`, `Fy` and `Fz` in N. `Pz` is the indentation, positive into the gel. `Fz` is positive in
/// compression. `Fx` and `Fy` have the sign of the tangential displacement of the indenter relative to the gel.
///
/// ```
/// use taceva_core::{Channel, Unit};
/// let turn = Channel::named("Rx", Unit::Degree)?;
/// assert_eq!((turn.name(), Channel::FZ.unit()), ("Rx", Unit::Newton));
/// # Ok::<(), taceva_core::ChannelError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Channel {
    name: ChannelName,
    unit: Unit,
    period: Option<NonZeroU16>,
}

impl Channel {
    /// Contact position along x of the sensor, mm.
    pub const PX: Channel = Channel::fixed("Px", Unit::Millimetre);
    /// Contact position along y of the sensor, mm.
    pub const PY: Channel = Channel::fixed("Py", Unit::Millimetre);
    /// Indentation depth, positive into the gel, mm.
    pub const PZ: Channel = Channel::fixed("Pz", Unit::Millimetre);
    /// Shear force along x of the sensor, N.
    pub const FX: Channel = Channel::fixed("Fx", Unit::Newton);
    /// Shear force along y of the sensor, N.
    pub const FY: Channel = Channel::fixed("Fy", Unit::Newton);
    /// Normal force, positive in compression, N.
    pub const FZ: Channel = Channel::fixed("Fz", Unit::Newton);
    /// Position and force of a contact, in canonical order: `Px Py Pz Fx Fy Fz`.
    pub const SIX: [Channel; 6] = [
        Channel::PX,
        Channel::PY,
        Channel::PZ,
        Channel::FX,
        Channel::FY,
        Channel::FZ,
    ];

    /// Maximum length of the name of a channel, in bytes.
    pub const NAME_MAX: usize = NAME_MAX;

    const fn fixed(name: &str, unit: Unit) -> Channel {
        Channel {
            name: ChannelName::new(name),
            unit,
            period: None,
        }
    }

    /// Channel called `name`: one of [`SIX`](Channel::SIX), or an extra channel such as `Rx` in degrees or `shear_x` in mm.
    ///
    /// # Errors
    /// [`ChannelError`] if the name is not an ASCII letter followed by letters, digits or `_`, or is longer than
    /// [`NAME_MAX`](Channel::NAME_MAX) bytes. Also if `name` is in [`SIX`](Channel::SIX) and `unit` is not its unit.
    pub fn named(name: &str, unit: Unit) -> Result<Channel, ChannelError> {
        if let Some(known) = Channel::SIX
            .into_iter()
            .find(|channel| channel.name() == name)
        {
            return if known.unit == unit {
                Ok(known)
            } else {
                Err(ChannelError::Unit {
                    name: name.to_owned(),
                    expected: known.unit,
                    found: unit,
                })
            };
        }
        let starts_with_letter = name.starts_with(|first: char| first.is_ascii_alphabetic());
        let rest_is_plain = name
            .bytes()
            .all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
        if !starts_with_letter || !rest_is_plain || name.len() > Channel::NAME_MAX {
            return Err(ChannelError::Name {
                name: name.to_owned(),
            });
        }
        Ok(Channel::fixed(name, unit))
    }

    /// The channel as an angle with a period of `degrees`, from 1 to 360. The period is in degrees even if the values are in radians.
    ///
    /// # Errors
    /// [`ChannelError::Period`] if the channel is neither in degrees nor in radians, or `degrees` is 0 or above 360.
    ///
    /// ```
    /// use taceva_core::{Channel, Unit};
    /// let yaw = Channel::named("yaw", Unit::Degree)?.with_period(360)?;
    /// assert_eq!(yaw.nearest(-179.0, 178.0), 181.0);
    /// assert!(Channel::FZ.with_period(360).is_err());
    /// # Ok::<(), taceva_core::ChannelError>(())
    /// ```
    pub fn with_period(self, degrees: u16) -> Result<Channel, ChannelError> {
        let period = NonZeroU16::new(degrees).filter(|degrees| degrees.get() <= 360);
        match period {
            Some(period) if matches!(self.unit, Unit::Degree | Unit::Radian) => Ok(Channel {
                period: Some(period),
                ..self
            }),
            _ => Err(ChannelError::Period {
                name: self.name().to_owned(),
                degrees,
            }),
        }
    }

    /// Name in tables, maps and reports.
    pub fn name(&self) -> &str {
        self.name.as_str()
    }

    /// Unit of the channel's values.
    pub fn unit(&self) -> Unit {
        self.unit
    }

    /// Period of the values, degrees; `None` if the channel is not an angle or declares no period.
    pub fn period(&self) -> Option<u16> {
        self.period.map(NonZeroU16::get)
    }

    /// Period of the values in their own unit, degrees or radians; `None` for a channel without a period.
    ///
    /// ```
    /// use taceva_core::{Channel, Unit};
    /// let yaw = Channel::named("yaw", Unit::Radian)?.with_period(180)?;
    /// assert_eq!(yaw.period_in_unit(), Some(std::f64::consts::PI));
    /// # Ok::<(), taceva_core::ChannelError>(())
    /// ```
    pub fn period_in_unit(&self) -> Option<f64> {
        let degrees = f64::from(self.period()?);
        Some(match self.unit {
            Unit::Radian => degrees.to_radians(),
            _ => degrees,
        })
    }

    /// Shifts `value` by whole periods of the channel until it is nearest to `reference`. Without a period, returns `value`.
    ///
    /// Also returns `value` unchanged, to the bit, if it differs from `reference` by at most half a period.
    pub fn nearest(&self, value: f64, reference: f64) -> f64 {
        let Some(period) = self.period_in_unit() else {
            return value;
        };
        let turns = ((value - reference) / period).round();
        match turns.abs() >= 1.0 && (value - reference).abs() > period / 2.0 {
            true => value - turns * period,
            false => value,
        }
    }
}

display!(Channel, name);

/// Channels without repetition, in canonical order: `Px Py Pz Fx Fy Fz`, then extra channels sorted by name.
///
/// ```
/// use taceva_core::{Channel, Channels};
/// let channels = Channels::new([Channel::FZ, Channel::PX])?;
/// assert_eq!((channels.position("Px"), channels.position("Fz")), (Some(0), Some(1)));
/// # Ok::<(), taceva_core::ChannelError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Channels {
    list: Vec<Channel>,
}

impl Channels {
    /// Sorts the given channels into canonical order.
    ///
    /// # Errors
    /// [`ChannelError::Twice`] if two channels have one name.
    pub fn new(channels: impl IntoIterator<Item = Channel>) -> Result<Channels, ChannelError> {
        let mut list: Vec<Channel> = channels.into_iter().collect();
        list.sort_by_cached_key(|channel| {
            let rank = Channel::SIX
                .iter()
                .position(|known| known.name == channel.name);
            (
                rank.unwrap_or(Channel::SIX.len()),
                channel.name().to_owned(),
            )
        });
        if let Some(pair) = list.windows(2).find(|pair| pair[0].name == pair[1].name) {
            return Err(ChannelError::Twice {
                name: pair[0].name().to_owned(),
            });
        }
        Ok(Channels { list })
    }

    /// Index of the channel called `name`; `None` for an unknown name.
    pub fn position(&self, name: &str) -> Option<usize> {
        self.list.iter().position(|channel| channel.name() == name)
    }

    /// The channel called `name`; `None` for an unknown name.
    pub fn by_name(&self, name: &str) -> Option<&Channel> {
        self.list.iter().find(|channel| channel.name() == name)
    }

    /// The channels in canonical order.
    pub fn as_slice(&self) -> &[Channel] {
        &self.list
    }

    /// The channels in canonical order.
    pub fn iter(&self) -> std::slice::Iter<'_, Channel> {
        self.list.iter()
    }

    /// Number of channels.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// True if there are no channels.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }
}

impl<'a> IntoIterator for &'a Channels {
    type Item = &'a Channel;
    type IntoIter = std::slice::Iter<'a, Channel>;
    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// Error for an invalid channel or list of channels.
///
/// ```
/// use taceva_core::{Channel, Channels};
/// assert!(Channels::new([Channel::FZ, Channel::FZ]).is_err());
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ChannelError {
    /// The name is too long, does not begin with a letter, or has a character other than letters, digits and `_`.
    Name {
        /// The name as given.
        name: String,
    },
    /// A channel of [`Channel::SIX`] has a unit other than its own.
    Unit {
        /// Name of the channel.
        name: String,
        /// Unit that the channel must have.
        expected: Unit,
        /// Unit that was given.
        found: Unit,
    },
    /// The channel is not an angle, or the period is outside 1 to 360 degrees.
    Period {
        /// Name of the channel.
        name: String,
        /// The period as given, degrees.
        degrees: u16,
    },
    /// The same channel occurs twice.
    Twice {
        /// Name of the channel.
        name: String,
    },
}

impl fmt::Display for ChannelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ChannelError::Name { name } => write!(
                f,
                "`{}` is not a channel name, expected a letter, then letters, digits or `_`, at most {} bytes",
                crate::shown(name),
                Channel::NAME_MAX
            ),
            ChannelError::Unit {
                name,
                expected,
                found,
            } => {
                let name = crate::shown(name);
                write!(f, "channel `{name}` is in {expected}, found {found}")
            }
            ChannelError::Period { name, degrees } => write!(
                f,
                "channel `{}`: a period of {degrees} degrees, expected an angle in deg or rad and a period of 1 to 360 degrees",
                crate::shown(name)
            ),
            ChannelError::Twice { name } => {
                write!(f, "channel `{}` is given twice", crate::shown(name))
            }
        }
    }
}

impl std::error::Error for ChannelError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_stand_in_one_order_whatever_order_they_came_in() {
        let extra = Channel::named("Rx", Unit::Degree).expect("a plain name");
        let first = Channels::new([extra, Channel::FZ, Channel::PX]).expect("distinct");
        let second = Channels::new([Channel::PX, extra, Channel::FZ]).expect("distinct");
        assert_eq!(first, second);
        assert_eq!(
            first.iter().map(Channel::name).collect::<Vec<_>>(),
            ["Px", "Fz", "Rx"]
        );
    }

    #[test]
    fn a_force_in_millimetres_is_refused() {
        let error = Channel::named("Fz", Unit::Millimetre).expect_err("Fz is in N");
        assert_eq!(error.to_string(), "channel `Fz` is in N, found mm");
    }

    #[test]
    fn an_angle_is_compared_by_the_shortest_way_and_other_channels_as_they_are() {
        let angle = Channel::named("Rz", Unit::Degree).expect("a plain name");
        let whole = angle.with_period(360).expect("an angle");
        for (value, reference, nearest) in [
            (-179.0, 179.0, 181.0),
            (179.0, -179.0, -181.0),
            (180.0, 0.0, 180.0),
            (730.0, 5.0, 10.0),
            (0.1, 0.0, 0.1),
        ] {
            assert!((whole.nearest(value, reference) - nearest).abs() < 1e-12);
        }
        let half = angle.with_period(180).expect("an angle");
        assert!((half.nearest(89.0, -89.0) + 91.0).abs() < 1e-12);
        assert!((angle.nearest(-179.0, 179.0) + 179.0).abs() < 1e-12);
        assert_ne!(angle, whole);
        for degrees in [0, 361] {
            let refused = angle.with_period(degrees);
            assert!(matches!(refused, Err(ChannelError::Period { .. })));
        }
    }

    #[test]
    fn an_angle_in_radians_repeats_after_as_many_radians() {
        let yaw = Channel::named("yaw_rad", Unit::Radian).and_then(|yaw| yaw.with_period(360));
        let yaw = yaw.expect("an angle");
        let turn = std::f64::consts::TAU;
        assert!((yaw.nearest(-3.0, 3.0) - (turn - 3.0)).abs() < 1e-12);
        assert!((yaw.nearest(3.0, -3.0) - (3.0 - turn)).abs() < 1e-12);
        assert_eq!(yaw.period(), Some(360));
    }

    #[test]
    fn names_that_would_break_a_table_are_refused() {
        for name in ["", "1x", "a b", "a,b", "é", &"x".repeat(33)] {
            assert!(
                matches!(
                    Channel::named(name, Unit::One),
                    Err(ChannelError::Name { .. })
                ),
                "{name}"
            );
        }
    }

    #[test]
    fn a_channel_given_twice_is_refused() {
        let error = Channels::new([Channel::FZ, Channel::FZ]).expect_err("twice");
        assert_eq!(error, ChannelError::Twice { name: "Fz".into() });
    }
}
