//! A force transducer.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::BitOr;
use std::sync::Arc;

use super::{Deadline, DriverError, Interrupt};
use crate::quantity::Newton;
use crate::stamp::Stamp;
use crate::wrench::Wrench;

/// A transducer that measures force and may measure torque.
///
/// ```
/// use std::time::Duration;
/// use taceva_core::{Axes, Deadline, DriverError, ForceTransducer, Newton, Stamp, Tare, Wrench};
///
/// /// Rests under one load, in N.
/// struct Resting {
///     load: f64,
///     zero: f64,
/// }
///
/// impl ForceTransducer for Resting {
///     fn axes(&self) -> Axes {
///         Axes::NORMAL
///     }
///     fn read(&mut self, _: Deadline) -> Result<(Wrench, Stamp), DriverError> {
///         let force = [Newton(0.0), Newton(0.0), Newton(self.load - self.zero)];
///         Ok((Wrench { force, ..Wrench::default() }, Stamp::at(Duration::ZERO)))
///     }
///     fn tare(&mut self) -> Option<&mut dyn Tare> {
///         Some(self)
///     }
/// }
///
/// impl Tare for Resting {
///     fn zero(&mut self, _: Deadline) -> Result<(), DriverError> {
///         self.zero = self.load;
///         Ok(())
///     }
/// }
///
/// let mut transducer = Resting { load: 0.25, zero: 0.0 };
/// let (wrench, _) = transducer.read(Deadline::PASSED)?;
/// assert_eq!(wrench.force[2], Newton(0.25));
/// # Ok::<(), DriverError>(())
/// ```
pub trait ForceTransducer: Send {
    /// Components that the transducer measures. The other components are 0 in every reading and have no meaning.
    fn axes(&self) -> Axes;

    /// Starts the measurement. Does nothing if the transducer needs no start.
    ///
    /// # Errors
    /// The errors of [`Sensor::start`](super::Sensor::start).
    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        let _ = deadline;
        Ok(())
    }

    /// Waits for the next reading: the wrench on the gel and the time of the reading.
    ///
    /// # Errors
    /// [`DriverError`] of kind
    /// - `Timeout` if no reading arrived within `deadline`,
    /// - `OutOfRange` if a component is beyond the range of the transducer, so that its value would be clipped,
    /// - `DeviceFault` if the transducer reports a fault or a number that is not finite,
    /// - `Disconnected` or `EndOfStream` if no further reading can arrive.
    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError>;

    /// Sequence number of the last reading; `None` if the device does not number readings. A frozen device repeats the number, even if the
    /// time stamp is new. The numbers may restart, so compare them for equality only.
    fn sequence(&self) -> Option<u64> {
        None
    }

    /// Number of readings lost between device and host since the transducer was opened; `None` if the driver does not count them. A reading
    /// overwritten before the caller read it does not count as lost.
    fn lost(&self) -> Option<u64> {
        None
    }

    /// Stops the measurement; may be called in every state.
    ///
    /// # Errors
    /// [`DriverError`] if the device does not confirm the stop.
    fn stop(&mut self) -> Result<(), DriverError> {
        Ok(())
    }

    /// Handle that interrupts a pending call from another thread. If `None`, a call lasts until its deadline.
    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        None
    }

    /// Smallest step between two different force values, as reported by the device; `None` if the device has not reported a step.
    fn resolution(&self) -> Option<Newton> {
        None
    }

    /// Settings read from the transducer, by name, such as `serial` with `FT12345`. A recording stores them. Empty if no setting is known.
    fn settings(&self) -> BTreeMap<String, String> {
        BTreeMap::new()
    }

    /// Warnings for the operator about valid readings: a filter that delays readings, a threshold that was exceeded. Each states a remedy.
    fn warnings(&self) -> Vec<String> {
        Vec::new()
    }

    /// Interface to tare the transducer; `None` if the transducer cannot be tared.
    fn tare(&mut self) -> Option<&mut dyn Tare> {
        None
    }
}

/// Ability of a transducer to take the present load as zero.
///
/// ```
/// # use std::time::Duration;
/// # use taceva_core::{Axes, Deadline, DriverError, ForceTransducer, Newton, Stamp, Tare, Wrench};
/// #
/// # /// Rests under one load, in N.
/// # struct Resting {
/// #     load: f64,
/// #     zero: f64,
/// # }
/// #
/// # impl ForceTransducer for Resting {
/// #     fn axes(&self) -> Axes {
/// #         Axes::NORMAL
/// #     }
/// #     fn read(&mut self, _: Deadline) -> Result<(Wrench, Stamp), DriverError> {
/// #         let force = [Newton(0.0), Newton(0.0), Newton(self.load - self.zero)];
/// #         Ok((Wrench { force, ..Wrench::default() }, Stamp::at(Duration::ZERO)))
/// #     }
/// #     fn tare(&mut self) -> Option<&mut dyn Tare> {
/// #         Some(self)
/// #     }
/// # }
/// #
/// impl Tare for Resting {
///     fn zero(&mut self, _: Deadline) -> Result<(), DriverError> {
///         self.zero = self.load;
///         Ok(())
///     }
/// }
///
/// let mut transducer = Resting { load: 0.25, zero: 0.0 };
/// if let Some(tare) = transducer.tare() {
///     tare.zero(Deadline::PASSED)?;
/// }
/// assert_eq!(transducer.read(Deadline::PASSED)?.0, Wrench::default());
/// # Ok::<(), DriverError>(())
/// ```
pub trait Tare {
    /// Makes the present load the zero of all later readings, and returns once the new zero is in effect.
    ///
    /// Call only out of contact: a tare while the gel is pressed shifts every later force.
    ///
    /// # Errors
    /// [`DriverError`] of kind `Timeout`, or `OutOfRange` if the load is too great to be taken as zero.
    fn zero(&mut self, deadline: Deadline) -> Result<(), DriverError>;
}

/// One component of a wrench. This enum gets no further variant: a wrench has six components.
///
/// ```
/// use taceva_core::{Axes, Axis};
/// assert_eq!(Axis::Tz.name(), "Tz");
/// assert_eq!(Axes::NORMAL.iter().collect::<Vec<_>>(), [Axis::Fz]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u8)]
pub enum Axis {
    /// Force along x.
    Fx,
    /// Force along y.
    Fy,
    /// Normal force, along z.
    Fz,
    /// Torque about x.
    Tx,
    /// Torque about y.
    Ty,
    /// Torque about z.
    Tz,
}

impl Axis {
    /// Every component.
    pub const ALL: [Axis; 6] = [Axis::Fx, Axis::Fy, Axis::Fz, Axis::Tx, Axis::Ty, Axis::Tz];

    /// Name of the component, such as `Fz`.
    pub const fn name(self) -> &'static str {
        match self {
            Axis::Fx => "Fx",
            Axis::Fy => "Fy",
            Axis::Fz => "Fz",
            Axis::Tx => "Tx",
            Axis::Ty => "Ty",
            Axis::Tz => "Tz",
        }
    }
}

/// A set of components of a wrench.
///
/// ```
/// use taceva_core::{Axes, Axis};
/// assert!(Axes::FORCE.contains(Axis::Fz) && !Axes::FORCE.contains(Axis::Tz));
/// assert_eq!(Axes::FORCE.to_string(), "Fx Fy Fz");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Axes(u8);

impl Axes {
    /// No component.
    pub const NONE: Axes = Axes(0);
    /// Only the normal force `Fz`.
    pub const NORMAL: Axes = Axes::NONE.with(Axis::Fz);
    /// The three forces.
    pub const FORCE: Axes = Axes::NORMAL.with(Axis::Fx).with(Axis::Fy);
    /// The three forces and the three torques.
    pub const SIX: Axes = Axes::FORCE.with(Axis::Tx).with(Axis::Ty).with(Axis::Tz);

    /// The set with `axis` in it.
    #[must_use]
    pub const fn with(self, axis: Axis) -> Axes {
        Axes(self.0 | 1 << axis as u8)
    }

    /// True if `axis` is in the set.
    pub const fn contains(self, axis: Axis) -> bool {
        self.0 & 1 << axis as u8 != 0
    }

    /// True if the set is empty.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The components of the set, forces first.
    pub fn iter(self) -> impl Iterator<Item = Axis> {
        Axis::ALL
            .into_iter()
            .filter(move |axis| self.contains(*axis))
    }
}

impl BitOr for Axes {
    type Output = Axes;
    fn bitor(self, other: Axes) -> Axes {
        Axes(self.0 | other.0)
    }
}

impl fmt::Display for Axes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, axis) in self.iter().enumerate() {
            let separator = if position == 0 { "" } else { " " };
            write!(f, "{separator}{}", axis.name())?;
        }
        Ok(())
    }
}
