//! Controls of a camera, such as exposure and gain.

use std::fmt;

use rustix::io::Errno;

use super::camera::{Camera, text};
use super::error::V4l2Error;
use super::ioctls::{self, ControlInfo, ControlValue};

/// Number by which the kernel identifies a camera control.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ControlId(pub u32);

impl ControlId {
    /// Automatic white balance: 0 off, 1 on.
    pub const WHITE_BALANCE_AUTOMATIC: ControlId = ControlId(0x0098_090c);
    /// Automatic gain: 0 off, 1 on.
    pub const GAIN_AUTOMATIC: ControlId = ControlId(0x0098_0912);
    /// Gain, in steps that the camera defines.
    pub const GAIN: ControlId = ControlId(0x0098_0913);
    /// White-balance colour temperature, K.
    pub const WHITE_BALANCE: ControlId = ControlId(0x0098_091a);
    /// Exposure mode: 0 automatic, 1 manual, 2 and 3 partly automatic.
    pub const EXPOSURE_AUTOMATIC: ControlId = ControlId(0x009a_0901);
    /// Exposure time, in units of 100 µs.
    pub const EXPOSURE: ControlId = ControlId(0x009a_0902);
    /// Focus, in steps that the camera defines.
    pub const FOCUS: ControlId = ControlId(0x009a_090a);
    /// Automatic focus: 0 off, 1 on.
    pub const FOCUS_AUTOMATIC: ControlId = ControlId(0x009a_090c);
    /// Zoom, in steps that the camera defines. In a DIGIT sensor, this control sets the LED colour instead.
    pub const ZOOM: ControlId = ControlId(0x009a_090d);
}

impl fmt::Display for ControlId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:#010x}", self.0)
    }
}

/// Type of the value of a camera control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ControlKind {
    /// Whole number between the minimum and the maximum of the control.
    Whole,
    /// Flag with the value 0 for off or 1 for on.
    Flag,
    /// Choice from a menu, by the number of the entry.
    Choice,
    /// Button: no value; setting it triggers an action.
    Button,
    /// Type that is not a whole number, flag, choice or button.
    Other,
}

/// Control of a camera, with its range. This struct gets no further field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Control {
    /// Number of the control in the kernel.
    pub id: ControlId,
    /// Name of the control, as the camera or its kernel driver states it.
    pub name: String,
    /// Type of the control's value.
    pub kind: ControlKind,
    /// Minimum value of the control.
    pub least: i32,
    /// Maximum value of the control.
    pub greatest: i32,
    /// Default value of the control.
    pub usual: i32,
    /// True if another control overrides this control, so that a new value has no effect.
    pub is_inactive: bool,
}

const DISABLED: u32 = 0x1;
const INACTIVE: u32 = 0x10;
/// Maximum number of controls read from a camera. A faulty camera could list controls without end.
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
    /// Lists the enabled controls of the camera, in ascending order of their numbers.
    ///
    /// # Errors
    /// [`V4l2Error::Gone`] if the camera was unplugged.
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
            // Skip headings of control classes.
            if info.flags & DISABLED == 0 && info.kind != CLASS {
                found.push(Control::of(&info));
            }
        }
        Ok(found)
    }

    /// Properties of the control `id`; `None` if the camera lacks this control or has disabled it.
    ///
    /// # Errors
    /// [`V4l2Error::Gone`] if the camera was unplugged.
    pub fn control(&self, id: ControlId) -> Result<Option<Control>, V4l2Error> {
        let mut info = ControlInfo {
            id: id.0,
            ..ControlInfo::default()
        };
        match ioctls::query_control(self.fd(), &mut info) {
            Ok(()) if info.flags & DISABLED == 0 => Ok(Some(Control::of(&info))),
            Ok(()) | Err(Errno::INVAL | Errno::NOTTY) => Ok(None),
            Err(source) => Err(V4l2Error::of("query a control", source)),
        }
    }

    /// Reads the value of the control `id`.
    ///
    /// # Errors
    /// [`V4l2Error`] if the control does not exist or the camera is gone.
    pub fn value(&self, id: ControlId) -> Result<i32, V4l2Error> {
        let mut value = ControlValue { id: id.0, value: 0 };
        ioctls::get_control(self.fd(), &mut value)
            .map_err(|source| V4l2Error::of("read a control", source))?;
        Ok(value.value)
    }

    /// Sets the control `id` to `value`. Returns the value that the camera then has, which may differ from `value`.
    ///
    /// # Errors
    /// [`V4l2Error`] if the control does not exist or rejects the value, or the camera is gone.
    pub fn set(&mut self, id: ControlId, value: i32) -> Result<i32, V4l2Error> {
        let mut set = ControlValue { id: id.0, value };
        ioctls::set_control(self.fd(), &mut set)
            .map_err(|source| V4l2Error::of("set a control", source))?;
        self.value(id)
    }

    /// Triggers the button control `id`, which has no value to read back.
    ///
    /// # Errors
    /// The errors of [`set`](Camera::set).
    pub fn press(&mut self, id: ControlId) -> Result<(), V4l2Error> {
        let mut set = ControlValue { id: id.0, value: 1 };
        ioctls::set_control(self.fd(), &mut set)
            .map_err(|source| V4l2Error::of("press a button", source))
    }
}

const CLASS: u32 = 6;
