//! LEDs of a sensor. The zoom control of the camera sets them, as in a DIGIT.

use std::collections::BTreeMap;

use super::kernel::{Camera, ControlId};
use taceva_core::{ArgSpec, ArgValue, Args, DriverError, ErrorKind};

use super::error::{failed, refused};
use crate::camera::preset::Preset;
use crate::text::shown;

/// Brightness of the red, green and blue LEDs, each from 0 (off) to [`MOST`].
type Colour = [i32; 3];

/// Requested LED colour. Without a request, the LEDs stay unchanged and are only read back.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Leds {
    /// Text of the colour in the argument `led`, not yet parsed; `None` without this argument.
    wanted: Option<String>,
    /// True if the preset states that the zoom control of the camera sets LEDs.
    are_there: bool,
}

const LED: &str = "led";
const SET: &str = "set the LEDs of the sensor";
const MOST: i32 = 15;

impl Leds {
    /// Driver argument `led`, which sets the colour of the LEDs.
    pub(super) fn argument() -> ArgSpec {
        ArgSpec::text(LED)
            .optional()
            .help("LEDs of preset=digit, 0 to 15 for all, or red,green,blue; default: unchanged")
    }

    /// Reads the requested colour from `args`. The `preset` states if the sensor has LEDs.
    pub(super) fn of(args: &Args, preset: Option<&Preset>) -> Leds {
        let wanted = args.get(LED).and_then(ArgValue::as_text);
        Leds {
            wanted: wanted.map(str::to_owned),
            are_there: preset.is_some_and(|preset| preset.leds),
        }
    }

    /// Parses the requested colour; `None` if no colour is requested.
    ///
    /// # Errors
    /// `InvalidArgument` for a text that is not a colour, and for a sensor without LEDs.
    pub(super) fn colour(&self) -> Result<Option<Colour>, DriverError> {
        let Some(text) = &self.wanted else {
            return Ok(None);
        };
        let wrong = |why: String| failed(ErrorKind::InvalidArgument, SET, why);
        if !self.are_there {
            return Err(wrong(format!(
                "`{LED}` is {}, expected none without `preset=digit`: the zoom control sets the LEDs of a DIGIT, but zooms other cameras",
                shown(text)
            )));
        }
        let colour = colour(text).ok_or_else(|| {
            wrong(format!(
                "`{LED}` is {}, expected a number from 0 to {MOST}, or three with commas for red, green and blue",
                shown(text)
            ))
        })?;
        Ok(Some(colour))
    }

    /// Sets the LEDs, reads them back, and adds the colour to the settings in `found` as `led` = `15,15,15`.
    ///
    /// # Errors
    /// The errors of [`colour`](Leds::colour). `Unsupported` for a camera without the zoom control. `DeviceFault` if the LEDs do not keep the value.
    pub(super) fn apply(
        &self,
        camera: &mut Camera,
        found: &mut BTreeMap<String, String>,
    ) -> Result<(), DriverError> {
        let wanted = self.colour()?.map(number);
        if !self.are_there {
            return Ok(());
        }
        let Some(wanted) = wanted else {
            // The light stays unchanged, so a control that cannot be read is not a failure.
            if let Ok(Some(_)) = camera.control(ControlId::ZOOM)
                && let Ok(value) = camera.value(ControlId::ZOOM)
            {
                found.insert(LED.to_owned(), words(value));
            }
            return Ok(());
        };
        let value = match camera.control(ControlId::ZOOM).map_err(refused(SET))? {
            None => {
                let why = "the camera has no zoom control, by which a DIGIT sets its LEDs: expected a DIGIT; omit `led` for another camera";
                return Err(failed(ErrorKind::Unsupported, SET, why));
            }
            Some(_) => {
                let value = camera.set(ControlId::ZOOM, wanted).map_err(refused(SET))?;
                held(wanted, value)?
            }
        };
        found.insert(LED.to_owned(), words(value));
        Ok(())
    }
}

/// Parses one brightness for all LEDs, or three with commas for red, green and blue; `None` if `text` is invalid.
fn colour(text: &str) -> Option<Colour> {
    let parts: Option<Vec<i32>> = text
        .split(',')
        .map(|part| part.trim().parse().ok())
        .map(|level: Option<i32>| level.filter(|level| (0..=MOST).contains(level)))
        .collect();
    match parts?[..] {
        [all] => Some([all; 3]),
        [red, green, blue] => Some([red, green, blue]),
        _ => None,
    }
}

/// Value of the zoom control for a colour: red in bits 11 to 8, green in bits 7 to 4, blue in bits 3 to 0.
fn number([red, green, blue]: Colour) -> i32 {
    (red << 8) | (green << 4) | blue
}

/// Text for a value of the zoom control: `red,green,blue`, or the number itself if it encodes no colour.
fn words(value: i32) -> String {
    let colour = [value >> 8, (value >> 4) & MOST, value & MOST];
    match (0..=number([MOST; 3])).contains(&value) {
        true => colour.map(|level| level.to_string()).join(","),
        false => value.to_string(),
    }
}

/// Returns `value`, which the camera reports for the LEDs. Fails if it differs from `wanted`.
fn held(wanted: i32, value: i32) -> Result<i32, DriverError> {
    if wanted == value {
        return Ok(value);
    }
    let why = format!(
        "the LEDs are {} after they were set, expected {}: unplug the sensor and plug it in again, and close other programs that set them",
        words(value),
        words(wanted)
    );
    Err(failed(ErrorKind::DeviceFault, SET, why))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::v4l2::KEY;

    #[test]
    fn levels_and_colours_are_numbers_of_the_zoom_control() {
        for (text, expected) in [
            ("0", 0x000),
            ("15", 0xfff),
            ("15,0,0", 0xf00),
            ("0, 7, 15", 0x07f),
        ] {
            let found = colour(text).expect(text);
            assert_eq!(number(found), expected, "{text}");
            assert_eq!(colour(&words(expected)), Some(found), "{text}");
        }
        for text in ["", "16", "-1", "1,2", "1,2,3,4", "15,15,16", "red", "0xfff"] {
            assert_eq!(colour(text), None, "{text}");
        }
        assert_eq!(words(0x1000), "4096");
        assert_eq!(words(-1), "-1");
    }

    #[test]
    fn leds_that_do_not_hold_are_a_fault_that_names_both_colours() {
        assert_eq!(held(0xfff, 0xfff).expect("held"), 0xfff);
        let error = held(0xfff, 0xf00).expect_err("not held");
        assert_eq!(error.kind(), ErrorKind::DeviceFault);
        let said = error.to_string();
        assert!(
            said.contains("15,0,0") && said.contains("15,15,15"),
            "{said}"
        );
    }

    #[test]
    fn only_a_sensor_with_leds_takes_a_light() {
        let digit = Preset::named(&KEY, "digit").expect("a preset");
        let light = |text: &str, preset| {
            let specs = [Leds::argument()];
            let args = Args::parse(&specs, text).expect("good");
            Leds::of(&args, preset).colour()
        };
        assert_eq!(
            light("led=15,0,3", Some(digit)).expect("set"),
            Some([15, 0, 3])
        );
        assert_eq!(light("", Some(digit)).expect("unchanged"), None);
        let mini = Preset::named(&KEY, "gelsight-mini").expect("a preset");
        for preset in [None, Some(mini)] {
            let error = light("led=15", preset).expect_err("no LEDs");
            assert!(error.to_string().contains("preset=digit"), "{error}");
        }
        let error = light("led=16", Some(digit)).expect_err("too bright");
        assert!(error.to_string().contains("from 0 to 15"), "{error}");
    }
}
