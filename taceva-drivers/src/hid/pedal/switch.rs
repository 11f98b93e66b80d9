//! Pedal as an enabling switch.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use taceva_core::{
    ArgError, ArgSpec, ArgValue, Args, DriverError, DriverKey, EnablingSwitch, ErrorKind,
};

use super::KEY;
use super::report::Bits;
use crate::hid::listener::Listener;
use crate::hid::selection::Selection;
use crate::link::Mailbox;
use crate::{OpenError, Selector};

/// An open pedal: `hid/pedal:usb=0c45:7403`. The argument `byte=2` excludes all other bytes of its reports.
///
/// # The physical contract
/// - The device must be selected by `usb`, `serial` or `device`. Pedals do not identify themselves, and a moving mouse must not count as a
///   pedal.
/// - The pedal is held while one of its bits is set. The watching code halts the robot once the pedal is released, unplugged or not understood.
///   Until its first report the pedal counts as released, so press it after opening.
/// - A pedal reports only changes, so a pedal whose electronics fail while it is held still counts as held. **The pedal is not a safety function**;
///   the switch of the robot's own safety circuit is.
/// - Pedals that act as keyboards keep typing their letter into the focused window.
///
/// # Verification
/// The HID layer of Linux: a pedal emulated by `uhid` in a virtual machine (`taceva-wire`, test `kernel`). **Not verified without the
/// device**: the bits that a model sets.
///
/// ```
/// use taceva_core::EnablingSwitch;
/// use taceva_drivers::hid::pedal::Pedal;
/// /// True if the pedal is connected and held.
/// fn is_held() -> bool {
///     let opened = "hid/pedal:usb=0c45:7403".parse().map(|selector| Pedal::open(&selector));
///     opened.is_ok_and(|pedal| pedal.is_ok_and(|pedal| pedal.is_held().unwrap_or(false)))
/// }
/// # let _ = is_held as fn() -> bool;
/// ```
#[derive(Debug)]
pub struct Pedal {
    held: Arc<Mailbox<bool>>,
    was_released: Arc<AtomicBool>,
    _listener: Listener,
}

impl Pedal {
    /// Key of the driver.
    pub const KEY: DriverKey = KEY;

    /// Arguments of a pedal's selector.
    pub fn arguments() -> Vec<ArgSpec> {
        let mut arguments = Selection::arguments().to_vec();
        arguments.extend([
            ArgSpec::whole("report", 0, 255)
                .optional()
                .help("number of the report with the pedal's bits, if reports are numbered"),
            ArgSpec::whole("byte", 0, 1023)
                .optional()
                .help("byte with the pedal's bits, counted from 0 after the report number; default: any byte"),
            ArgSpec::whole("mask", 1, 255)
                .default(ArgValue::Whole(255))
                .help("the pedal's bits in that byte, as a mask"),
        ]);
        arguments
    }

    /// Opens the pedal of `selector`.
    ///
    /// # Errors
    /// [`OpenError`] for another driver than `hid/pedal`, for invalid arguments, and for a device that does not open.
    pub fn open(selector: &Selector) -> Result<Pedal, OpenError> {
        let doing = "open the pedal";
        let failed = |kind, why: Box<dyn std::error::Error + Send + Sync>| {
            OpenError::Device(DriverError::new(kind, &KEY, doing).because(why))
        };
        if selector.driver() != KEY.as_str() {
            let why = format!(
                "`{}` is not an enabling switch, expected `{KEY}`",
                crate::text::shown(selector.driver())
            );
            return Err(failed(ErrorKind::NotFound, why.into()));
        }
        let args = Args::parse(&Pedal::arguments(), selector.arguments()).map_err(
            |source: ArgError| OpenError::Arguments {
                selector: selector.to_string(),
                source,
            },
        )?;
        let selected = Selection::of(&args).and_then(|selection| selection.open(None));
        let device = selected.map_err(|error| failed(error.kind(), error.into()))?;
        let whole = |key| match args.get(key) {
            Some(&ArgValue::Whole(number)) => Some(number),
            _ => None,
        };
        let byte = |key| whole(key).and_then(|number| u8::try_from(number).ok());
        let bits = Bits {
            report: byte("report"),
            byte: whole("byte").and_then(|number| usize::try_from(number).ok()),
            mask: byte("mask").unwrap_or(u8::MAX),
        };
        let held = Arc::new(Mailbox::default());
        let was_released = Arc::new(AtomicBool::new(false));
        let releasing = Arc::clone(&was_released);
        let listener = Listener::start(device, &held, move |report| {
            let held = bits.held(report)?;
            if !held {
                releasing.store(true, Ordering::Release);
            }
            Some(held)
        })
        .map_err(|error| failed(ErrorKind::Internal, error.into()))?;
        Ok(Pedal {
            held,
            was_released,
            _listener: listener,
        })
    }
}

impl EnablingSwitch for Pedal {
    fn is_held(&self) -> Result<bool, DriverError> {
        // Read first: a later release is seen below or by the next call.
        let was_released = self.was_released.swap(false, Ordering::AcqRel);
        match self.held.next(0, Duration::ZERO) {
            Ok(seen) => Ok(seen.what && !was_released),
            Err(crate::link::mailbox::NoNews::Silent) => Ok(false),
            Err(none) => Err(none.while_waiting(&KEY, "read the pedal", String::new)),
        }
    }
}
