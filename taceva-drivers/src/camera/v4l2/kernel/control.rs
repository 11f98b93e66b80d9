//! What can be set of a camera: exposure, gain and their like.

use std::fmt;

use rustix::io::Errno;

use super::camera::{Camera, text};
use super::error::V4l2Error;
use super::ioctls::{self, ControlInfo, ControlValue};

/// The number of a control.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ControlId(pub u32);

impl ControlId {
    /// Whether the camera balances white by itself: 0 or 1.
    pub const WHITE_BALANCE_AUTOMATIC: ControlId = ControlId(0x0098_090c);
    /// Whether the camera sets the gain by itself: 0 or 1.
    pub const GAIN_AUTOMATIC: ControlId = ControlId(0x0098_0912);
    /// The gain, in steps of the camera.
    pub const GAIN: ControlId = ControlId(0x0098_0913);
    /// The light that white is balanced for, in K.
    pub const WHITE_BALANCE: ControlId = ControlId(0x0098_091a);
    /// Who sets the exposure: 0 the camera, 1 the program, 2 and 3 the camera in part.
    pub const EXPOSURE_AUTOMATIC: ControlId = ControlId(0x009a_0901);
    /// The exposure, in 100 µs.
    pub const EXPOSURE: ControlId = ControlId(0x009a_0902);
    /// The focus, in steps of the camera.
    pub const FOCUS: ControlId = ControlId(0x009a_090a);
    /// Whether the camera focuses by itself: 0 or 1.
    pub const FOCUS_AUTOMATIC: ControlId = ControlId(0x009a_090c);
}

impl fmt::Display for ControlId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:#010x}", self.0)
    }
}

/// What values a control takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ControlKind {
    /// A whole number within its range.
    Whole,
    /// Off or on: 0 or 1.
    Flag,
    /// One of several, by number.
    Choice,
    /// None: setting it does something.
    Button,
    /// Something else.
    Other,
}

/// A control of a camera. A plain value, which gets no further fields.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Control {
    /// Its number.
    pub id: ControlId,
    /// What the camera calls it.
    pub name: String,
    /// What values it takes.
    pub kind: ControlKind,
    /// The least value.
    pub least: i32,
    /// The greatest value.
    pub greatest: i32,
    /// The default value.
    pub usual: i32,
    /// Whether another control has taken it over, so that setting it has no effect now.
    pub is_inactive: bool,
}

const DISABLED: u32 = 0x1;
const INACTIVE: u32 = 0x10;
/// No camera has more controls; one that seems to has gone wrong.
const CONTROLS_MAX: usize = 1024;

impl Control {
    fn of(info: &ControlInfo) -> Control {
        Control {
            id: ControlId(info.id),
            name: text(&info.name),
            kind: match info.kind {
                1 => ControlKind::Whole,
                2 => ControlKind::Flag,
                3 | 9 => ControlKind::Choice,
                4 => ControlKind::Button,
                _ => ControlKind::Other,
            },
            least: info.least,
            greatest: info.greatest,
            usual: info.usual,
            is_inactive: info.flags & INACTIVE != 0,
        }
    }
}

impl Camera {
    /// Every control that it has, in the order of their numbers.
    ///
    /// # Errors
    /// [`V4l2Error::Gone`] where it was unplugged.
    pub fn controls(&self) -> Result<Vec<Control>, V4l2Error> {
        let mut found: Vec<Control> = Vec::new();
        let mut last = 0;
        while found.len() < CONTROLS_MAX {
            let mut info = ControlInfo {
                id: last | ioctls::NEXT_CONTROL,
                ..ControlInfo::default()
            };
            match ioctls::query_control(self.fd(), &mut info) {
                Ok(()) if info.id > last => last = info.id,
                Ok(()) | Err(Errno::INVAL | Errno::NOTTY) => break,
                Err(source) => return Err(V4l2Error::of("list its controls", source)),
            }
            // A class of controls is none itself.
            if info.flags & DISABLED == 0 && info.kind != CLASS {
                found.push(Control::of(&info));
            }
        }
        Ok(found)
    }

    /// What is known of a control; `None` if the camera has none of that number.
    ///
    /// # Errors
    /// [`V4l2Error::Gone`] where it was unplugged.
    pub fn control(&self, id: ControlId) -> Result<Option<Control>, V4l2Error> {
        let mut info = ControlInfo {
            id: id.0,
            ..ControlInfo::default()
        };
        match ioctls::query_control(self.fd(), &mut info) {
            Ok(()) if info.flags & DISABLED == 0 => Ok(Some(Control::of(&info))),
            Ok(()) | Err(Errno::INVAL | Errno::NOTTY) => Ok(None),
            Err(source) => Err(V4l2Error::of("look at a control", source)),
        }
    }

    /// The value of a control.
    ///
    /// # Errors
    /// [`V4l2Error`]: there is no such control, or the camera is gone.
    pub fn value(&self, id: ControlId) -> Result<i32, V4l2Error> {
        let mut value = ControlValue { id: id.0, value: 0 };
        ioctls::get_control(self.fd(), &mut value)
            .map_err(|source| V4l2Error::of("read a control", source))?;
        Ok(value.value)
    }

    /// Sets a control, and returns the value that it has then, which need not be the one that was asked for.
    ///
    /// # Errors
    /// [`V4l2Error`]: there is no such control, it does not take that value or no value at all now, or the camera is gone.
    pub fn set(&mut self, id: ControlId, value: i32) -> Result<i32, V4l2Error> {
        let mut set = ControlValue { id: id.0, value };
        ioctls::set_control(self.fd(), &mut set)
            .map_err(|source| V4l2Error::of("set a control", source))?;
        self.value(id)
    }

    /// Presses a button of the camera, of which nothing can be read back.
    ///
    /// # Errors
    /// As [`set`](Camera::set).
    pub fn press(&mut self, id: ControlId) -> Result<(), V4l2Error> {
        let mut set = ControlValue { id: id.0, value: 1 };
        ioctls::set_control(self.fd(), &mut set)
            .map_err(|source| V4l2Error::of("press a button", source))
    }
}

const CLASS: u32 = 6;
