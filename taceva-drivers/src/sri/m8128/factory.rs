//! The built-in driver `sri/m8128`.

use taceva_core::{
    ArgSpec, ArgValue, Args, Axes, Descriptor, DescriptorError, DescriptorSpec, DriverError,
    DriverSource, Factory, Facts, ForceFacts, ForceTransducer, Hertz, Rig, submit_builtin,
};

use super::KEY;
use super::frame::Check;
use super::transducer::{M8128Options, Transducer, Zero};
use crate::arguments::force::{FORCE_MAX, add_facts_of_force, force_facts};
use crate::arguments::network::{port, port_of};
use crate::arguments::optional_number;

submit_builtin!(dyn ForceTransducer, || Ok(Box::new(M8128Factory::new()?)));

/// Opens interface boxes M8128 of SRI, and other boxes with the same commands: `sri/m8128:host=192.168.0.108`.
///
/// # The physical contract
/// - Forces and torques are in the transducer's own axes, in N and N·mm, as in its certificate. The axis that presses into the gel depends on the
///   mounting in the rig.
/// - Opening changes nothing in the box. The driver asks for the decoupling matrix and its unit, and records the answers as settings. Starting sets
///   rate, checksum and units, and starts the readings.
/// - A reading is the newest frame received. The driver checks the checksum of each frame (`check=crc32`: CRC32 with the polynomial of zlib) and its
///   number. The driver drops damaged and repeated frames. Two frames with consecutive numbers restore lost synchronisation. A reading with a value
///   that is not finite fails with `DeviceFault`.
/// - The driver subtracts a zero offset, the mean of the readings over 0.25 s. With `zero=box` the box zeroes itself, which takes seconds.
/// - With `force_max_n` from the certificate, a clipped force is an error. Without this argument, clipping goes undetected.
///
/// # Verification
/// Tests check the values and checksums of two published frames. The driver passes its tests on an emulated box. There is no public client. **Not
/// verified without the device**: the answers to queries and to a stop, zeroing in the box, and frames with CRC32. The unit of torque (N·m unless
/// `torque=N mm`) is not verified either. The CRC's polynomial and byte order come from a single public driver.
///
/// ```
/// use taceva_core::Factory;
/// use taceva_drivers::sri::m8128::M8128Factory;
/// let factory = M8128Factory::new()?;
/// let args = factory.descriptor().args("host=192.168.0.108;rate=500 Hz").expect("good");
/// let described = factory.describe(&args)?;
/// assert_eq!(described.force().and_then(|facts| facts.rate), Some(taceva_core::Hertz(500.0)));
/// # Ok::<(), taceva_core::DescriptorError>(())
/// ```
#[derive(Debug)]
pub struct M8128Factory {
    descriptor: Descriptor,
}

/// Torque units of the box: value of the argument `torque`, and size of the unit in N·mm.
const TORQUES: [(&str, f64); 2] = [("N m", 1000.0), ("N mm", 1.0)];

impl M8128Factory {
    /// Creates the factory.
    ///
    /// # Errors
    /// [`DescriptorError`] if the descriptor is inconsistent, which tests rule out.
    pub fn new() -> Result<M8128Factory, DescriptorError> {
        let arguments = [
            ArgSpec::text("host").help("name or address of the box"),
            port("port", 4008, "TCP port of the box"),
            ArgSpec::number("rate", 1.0, 2_000.0)
                .unit("Hz")
                .default(ArgValue::Number(200.0))
                .help("readings per second, a whole number")
                .changes_facts(),
            ArgSpec::choice("torque", TORQUES.map(|(name, _)| name))
                .default(ArgValue::Text("N m".to_owned()))
                .help("unit of its torques, from its certificate"),
            ArgSpec::choice("check", ["sum", "crc32"])
                .default(ArgValue::Text("sum".to_owned()))
                .help(
                    "checksum of frames: the sum of their bytes, or CRC32 if the box supports it",
                ),
            ArgSpec::choice("zero", ["host", "box"])
                .default(ArgValue::Text("host".to_owned()))
                .help("device that zeroes the force: host (this program), or box (takes seconds)"),
        ];
        let facts = Facts::Force(
            ForceFacts::default()
                .with_axes(Axes::SIX)
                .with_tare(true)
                .with_numbered(true),
        );
        let title = "a force transducer behind a box of SRI";
        let spec = DescriptorSpec::new(KEY, title, DriverSource::Real, facts);
        Ok(M8128Factory {
            descriptor: spec.arguments(arguments).arguments(force_facts()).check()?,
        })
    }
}

impl Factory<dyn ForceTransducer> for M8128Factory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        let options = options(args);
        let mut spec = self.descriptor.to_spec();
        if let Facts::Force(facts) = &mut spec.facts {
            facts.rate = Some(Hertz(f64::from(options.rate_hz)));
            add_facts_of_force(args, facts);
        }
        spec.check()
    }

    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn ForceTransducer>, DriverError> {
        Ok(Box::new(Transducer::open(options(args))?))
    }
}

fn options(args: &Args) -> M8128Options {
    let torque = args.text("torque");
    let unit = TORQUES.into_iter().find(|(name, _)| *name == torque);
    M8128Options {
        host: args.text("host").to_owned(),
        port: port_of(args, "port"),
        rate_hz: whole(args.number("rate")),
        check: match args.text("check") {
            "crc32" => Check::Crc32,
            _ => Check::Sum,
        },
        force_max_n: optional_number(args, FORCE_MAX),
        torque_unit_nmm: unit.map_or(1000.0, |(_, unit)| unit),
        zero: match args.text("zero") {
            "box" => Zero::Box,
            _ => Zero::Host,
        },
    }
}

/// Rounds a rate of 1 to 2000 Hz to whole Hz.
fn whole(rate_hz: f64) -> u16 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the declared range of the rate is 1 to 2,000"
    )]
    let rate = rate_hz.round() as u16;
    rate
}
