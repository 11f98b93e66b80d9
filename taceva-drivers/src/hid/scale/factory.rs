//! The built-in driver `hid/scale`.

use taceva_core::{
    ArgSpec, ArgValue, Args, Axes, Descriptor, DescriptorError, DescriptorSpec, DriverError,
    DriverSource, Factory, Facts, ForceFacts, ForceTransducer, Found, Hertz, Rig, submit_builtin,
};

use super::KEY;
use super::transducer::{SCALE, Transducer};
use crate::arguments::force::{FORCE_MAX, add_facts_of_force, force_facts};
use crate::arguments::optional_number;
use crate::hid::selection::{Present, Selection};

submit_builtin!(dyn ForceTransducer, || Ok(Box::new(ScaleFactory::new()?)));

/// Opens USB scales with the HID usage page of weighing devices (Dymo, Mettler PS60 and similar): `hid/scale`.
///
/// # The physical contract
/// - A load presses with its weight, 9.80665 N per kilogram: Fz, positive when pressing. No other component is measured.
/// - Intended for **recordings by hand** (`taceva capture`), where a person presses slowly: a scale filters, and sends a few weights per
///   second, as `rate` states. At the default of 2 Hz a plan with a robot is rejected, since nothing would stop the robot in time.
/// - Opening and starting send nothing. A weight is stamped with the arrival time of its report.
/// - An overloaded scale is `OutOfRange`. A lost zero, a required calibration or a fault is `DeviceFault`. An unplugged scale is
///   `Disconnected` and must be reopened.
/// - The step between readings follows from unit and exponent of the reports, unless `resolution_n` states it: a load at rest repeats
///   its weight.
/// - Zero is the mean of the weights within 0.25 s, subtracted by the driver. The scale's own key zeroes it too.
///
/// # Verification
/// The HID layer of Linux: the driver passes its suite on a scale emulated by `uhid` in a virtual machine (`taceva-wire`, test `kernel`).
/// Numbers of states and units are from the HID usage tables. **Not verified without the device**: how often a scale sends, how long it
/// filters, and whether it sends other units than it displays.
///
/// ```
/// use taceva_core::Factory;
/// use taceva_drivers::hid::scale::ScaleFactory;
/// let factory = ScaleFactory::new()?;
/// assert!(factory.descriptor().args("usb=0922:8003;force_max_n=49").is_ok());
/// # Ok::<(), taceva_core::DescriptorError>(())
/// ```
#[derive(Debug)]
pub struct ScaleFactory {
    descriptor: Descriptor,
}

impl ScaleFactory {
    /// Creates the factory.
    ///
    /// # Errors
    /// [`DescriptorError`] if the descriptor is inconsistent, which tests rule out.
    pub fn new() -> Result<ScaleFactory, DescriptorError> {
        let arguments = [ArgSpec::number("rate", 0.1, 20.0)
            .unit("Hz")
            .default(ArgValue::Number(2.0))
            .help("least number of weights per second that the scale sends, as measured")
            .changes_facts()];
        let facts = ForceFacts::default()
            .with_axes(Axes::NORMAL)
            .with_tare(true);
        let facts = Facts::Force(facts);
        let spec = DescriptorSpec::new(KEY, "a USB scale", DriverSource::Real, facts);
        let spec = spec
            .arguments(Selection::arguments())
            .arguments(arguments)
            .arguments(force_facts());
        Ok(ScaleFactory {
            descriptor: spec.check()?,
        })
    }
}

impl Factory<dyn ForceTransducer> for ScaleFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        let mut spec = self.descriptor.to_spec();
        if let Facts::Force(facts) = &mut spec.facts {
            facts.rate = Some(Hertz(args.number("rate")));
            add_facts_of_force(args, facts);
        }
        spec.check()
    }

    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn ForceTransducer>, DriverError> {
        let selection = Selection::of(args).map_err(|error| {
            DriverError::new(error.kind(), &KEY, "open the scale").because(error)
        })?;
        let force_max_n = optional_number(args, FORCE_MAX);
        Ok(Box::new(Transducer::open(&selection, force_max_n)?))
    }

    fn discover(&self) -> Result<Vec<Found>, DriverError> {
        // A machine without HID devices, or without a list of them, has no scales.
        let present = Present::all().unwrap_or_default();
        let scales = present.iter().filter(|present| present.has_usage(SCALE));
        Ok(scales.map(|scale| scale.found(KEY)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_is_slow_unless_somebody_measured_it() {
        let factory = ScaleFactory::new().expect("a factory");
        let described = |arguments: &str| {
            let args = factory.descriptor().args(arguments).expect("good");
            let described = factory.describe(&args).expect("no contradiction");
            *described.force().expect("of a force transducer")
        };
        // Three periods without a weight last 1.5 s, or 0.25 mm at 0.17 mm/s: no robot presses so slowly.
        assert_eq!(described("").rate, Some(Hertz(2.0)));
        let measured = described("rate=10 Hz;force_max_n=49;resolution_n=0.0196");
        assert_eq!(measured.rate, Some(Hertz(10.0)));
        assert_eq!(measured.force_max.map(|force| force.0), Some(49.0));
        assert_eq!(measured.resolution.map(|force| force.0), Some(0.0196));
    }
}
