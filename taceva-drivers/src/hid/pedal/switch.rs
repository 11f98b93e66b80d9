//! A pedal as an enabling switch.

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

/// A pedal that is open: `hid/pedal:usb=0c45:7403`, or with `;byte=2` where not every bit of its reports is the pedal's.
///
/// # The physical contract
/// - It must be named by `usb`, `serial` or `device`: what a pedal is no device says of itself, and a mouse that moves must not count as one.
/// - It is held while one of its bits is set in its reports; whoever watches it halts the robot once it is released, unplugged or not
///   understood. Until its first report it counts as released: it is pressed after it was opened.
/// - A pedal sends a report when it changes and is silent otherwise: one whose electronics died while it was held cannot be distinguished from one
///   that is held. **It is no safety function**; the switch of the robot's own safety circuit is.
/// - Pedals that act as keyboards go on typing their letter into whatever window is in front.
///
/// # What confirmed it
/// Linux' own HID layer: a pedal made by `uhid` in a virtual machine (`taceva-wire`, test `kernel`). **Not verified without the device**: which
/// bits a model sets.
///
/// ```
/// use taceva_core::EnablingSwitch;
/// use taceva_drivers::hid::pedal::Pedal;
/// /// Whether the pedal is there and held.
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
    /// The key of its driver.
    pub const KEY: DriverKey = KEY;

    /// The arguments of a pedal, as they stand behind the colon of its selector.
    pub fn arguments() -> Vec<ArgSpec> {
        let mut arguments = Selection::arguments().to_vec();
        arguments.extend([
            ArgSpec::whole("report", 0, 255)
                .optional()
                .help("the number of the report that says it, where its reports are numbered"),
            ArgSpec::whole("byte", 0, 1023)
                .optional()
                .help("the byte of the report that says it, counted from 0 behind the number; any, if it is not given"),
            ArgSpec::whole("mask", 1, 255)
                .default(ArgValue::Whole(255))
                .help("the bits of that byte that say it"),
        ]);
        arguments
    }

    /// Opens the pedal that `selector` asks for.
    ///
    /// # Errors
    /// [`OpenError`] for another driver than `hid/pedal`, for arguments that a pedal does not take, and for a device that does not open.
    pub fn open(selector: &Selector) -> Result<Pedal, OpenError> {
        let doing = "open the pedal";
        let failed = |kind, why: Box<dyn std::error::Error + Send + Sync>| {
            OpenError::Device(DriverError::new(kind, &KEY, doing).because(why))
        };
        if selector.driver() != KEY.as_str() {
            let why = format!(
                "`{}` is no enabling switch, expected `{KEY}`",
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
        // Taken first: a release that comes behind it is seen by the next who asks, or below.
        let was_released = self.was_released.swap(false, Ordering::AcqRel);
        match self.held.next(0, Duration::ZERO) {
            Ok(seen) => Ok(seen.what && !was_released),
            Err(crate::link::mailbox::NoNews::Silent) => Ok(false),
            Err(none) => Err(none.while_waiting(&KEY, "read the pedal", String::new)),
        }
    }
}
