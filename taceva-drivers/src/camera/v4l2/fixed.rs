//! Controls that must not change during a measurement: exposure, gain, white balance and focus. The driver sets them and reads them back.

use std::collections::BTreeMap;

use super::kernel::{Camera, Control, ControlId, V4l2Error};
use taceva_core::{ArgSpec, ArgValue, Args, DriverError, ErrorKind};

use super::error::{failed, refused};

/// Requested values of exposure, gain, white balance and focus. The driver only reads back a control for which no value is requested.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Fixed {
    exposure_ms: Option<f64>,
    gain: Option<i32>,
    white_balance_k: Option<i32>,
    focus: Option<i32>,
    /// True if the driver accepts a camera that keeps automatic control on.
    keeps_automatic: bool,
}

/// Control that the driver fixes: exposure, gain, white balance or focus.
struct Knob {
    name: &'static str,
    /// Control that switches the automatic mode, with the value that switches it off.
    automatic: (ControlId, i32),
    control: ControlId,
    wanted: Option<i32>,
    /// Size of one step of the control, in the unit of the argument.
    unit: f64,
}

const FIX: &str = "fix the controls of the camera";
/// Size of one step of the exposure control, ms.
const EXPOSURE_MS: f64 = 0.1;

impl Fixed {
    /// Driver arguments for exposure, gain, white balance, focus and automatic control.
    pub(super) fn arguments() -> [ArgSpec; 5] {
        let whole = |key: &str, help: &str| {
            ArgSpec::whole(key, 0, i64::from(i32::MAX))
                .optional()
                .help(help)
        };
        [
            ArgSpec::number("exposure_ms", 0.1, 100_000.0)
                .optional()
                .help("exposure time, ms, in steps of 0.1; default: unchanged"),
            whole("gain", "gain, in the camera's own steps; default: unchanged"),
            whole("white_balance_k", "colour temperature of the white balance, K; default: unchanged"),
            whole("focus", "focus, in the camera's own steps; default: unchanged"),
            ArgSpec::choice("automatic", ["refuse", "keep"])
                .default(ArgValue::Text("refuse".to_owned()))
                .help("keep: accept a camera that sets exposure, gain, white balance or focus automatically, and record that it does"),
        ]
    }

    /// Reads the requested values from `args`.
    pub(super) fn of(args: &Args) -> Fixed {
        let whole = |key| match args.get(key) {
            Some(&ArgValue::Whole(number)) => i32::try_from(number).ok(),
            _ => None,
        };
        Fixed {
            exposure_ms: args.get("exposure_ms").and_then(ArgValue::as_number),
            gain: whole("gain"),
            white_balance_k: whole("white_balance_k"),
            focus: whole("focus"),
            keeps_automatic: args.text("automatic") == "keep",
        }
    }

    fn knobs(&self) -> [Knob; 4] {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "the declared range keeps the value below a million"
        )]
        let exposure = self.exposure_ms.map(|ms| (ms / EXPOSURE_MS).round() as i32);
        [
            Knob {
                name: "exposure_ms",
                automatic: (ControlId::EXPOSURE_AUTOMATIC, 1),
                control: ControlId::EXPOSURE,
                wanted: exposure,
                unit: EXPOSURE_MS,
            },
            Knob {
                name: "gain",
                automatic: (ControlId::GAIN_AUTOMATIC, 0),
                control: ControlId::GAIN,
                wanted: self.gain,
                unit: 1.0,
            },
            Knob {
                name: "white_balance_k",
                automatic: (ControlId::WHITE_BALANCE_AUTOMATIC, 0),
                control: ControlId::WHITE_BALANCE,
                wanted: self.white_balance_k,
                unit: 1.0,
            },
            Knob {
                name: "focus",
                automatic: (ControlId::FOCUS_AUTOMATIC, 0),
                control: ControlId::FOCUS,
                wanted: self.focus,
                unit: 1.0,
            },
        ]
    }

    /// Sets the requested values. Returns the values read back by name, such as `exposure_ms` = `15.7`.
    ///
    /// # Errors
    /// `Unsupported` if a control is missing or stays automatic. `OutOfRange` if a value is outside the range of the camera. `DeviceFault` if the
    /// camera sets another value.
    pub(super) fn apply(
        &self,
        camera: &mut Camera,
    ) -> Result<BTreeMap<String, String>, DriverError> {
        let mut found = BTreeMap::new();
        for knob in self.knobs() {
            knob.apply(camera, self.keeps_automatic, &mut found)?;
        }
        Ok(found)
    }
}

impl Knob {
    fn apply(
        &self,
        camera: &mut Camera,
        keeps_automatic: bool,
        found: &mut BTreeMap<String, String>,
    ) -> Result<(), DriverError> {
        let name = self.name;
        if self.let_go(camera, keeps_automatic)? {
            // With automatic control the current value does not hold for the next image.
            found.insert(format!("{name}_automatic"), "true".to_owned());
            return match self.wanted {
                None => Ok(()),
                Some(wanted) => Err(failed(
                    ErrorKind::InvalidArgument,
                    FIX,
                    format!(
                        "`{name}` is set to {}, but `automatic=keep` leaves it to the camera: give only one of them",
                        self.shown(wanted)
                    ),
                )),
            };
        }
        let control = camera.control(self.control).map_err(refused(FIX))?;
        match (control, self.wanted) {
            (None, None) => {}
            (None, Some(_)) => {
                return Err(failed(
                    ErrorKind::Unsupported,
                    FIX,
                    format!("the camera has no control for `{name}`"),
                ));
            }
            (Some(control), wanted) => {
                if let Some(wanted) = wanted {
                    self.set(camera, &control, wanted)?;
                }
                let value = camera.value(self.control).map_err(refused(FIX))?;
                found.insert(name.to_owned(), self.shown(value));
            }
        }
        Ok(())
    }

    /// Switches automatic control off, unless `keeps` is true. Returns true if automatic control is still on.
    fn let_go(&self, camera: &mut Camera, keeps: bool) -> Result<bool, DriverError> {
        let (automatic, off) = self.automatic;
        if camera.control(automatic).map_err(refused(FIX))?.is_none() {
            return Ok(false);
        }
        if keeps {
            return Ok(camera.value(automatic).map_err(refused(FIX))? != off);
        }
        let why = match camera.set(automatic, off) {
            Ok(value) if value == off => return Ok(false),
            Ok(_) => "even after a request to stop".to_owned(),
            Err(error @ (V4l2Error::Gone { .. } | V4l2Error::Busy { .. })) => {
                return Err(refused(FIX)(error));
            }
            Err(error) => error.to_string(),
        };
        let name = self.name;
        Err(failed(
            ErrorKind::Unsupported,
            FIX,
            format!(
                "the camera sets `{name}` automatically, {why}: pictures would change without contact; `automatic=keep` accepts this"
            ),
        ))
    }

    fn set(&self, camera: &mut Camera, control: &Control, wanted: i32) -> Result<(), DriverError> {
        let Control {
            least, greatest, ..
        } = *control;
        let name = self.name;
        if !(least..=greatest).contains(&wanted) {
            let why = format!(
                "`{name}` is {}, expected {} to {}",
                self.shown(wanted),
                self.shown(least),
                self.shown(greatest)
            );
            return Err(failed(ErrorKind::OutOfRange, FIX, why));
        }
        let value = camera.set(self.control, wanted).map_err(refused(FIX))?;
        if value != wanted {
            let why = format!(
                "the camera set `{name}` to {}, expected {}",
                self.shown(value),
                self.shown(wanted)
            );
            return Err(failed(ErrorKind::DeviceFault, FIX, why));
        }
        Ok(())
    }

    fn shown(&self, value: i32) -> String {
        // Formatted in tenths, to avoid the nearest binary number of 15.7.
        match self.unit < 1.0 {
            true => format!("{}.{}", value / 10, value % 10),
            false => value.to_string(),
        }
    }
}
