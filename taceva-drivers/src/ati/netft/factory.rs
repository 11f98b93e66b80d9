//! The built-in driver `ati/netft`.

use taceva_core::{
    ArgSpec, ArgValue, Args, Axes, Descriptor, DescriptorError, DescriptorSpec, DriverError,
    DriverSource, Factory, Facts, ForceFacts, ForceTransducer, Hertz, Rig, submit_builtin,
};

use super::KEY;
use super::setup::{Expected, Frame};
use super::transducer::{NetftOptions, Transducer};
use crate::arguments::force::{FORCE_MAX, add_facts_of_force, force_facts};
use crate::arguments::network::{port, port_of};
use crate::arguments::optional_number;

submit_builtin!(dyn ForceTransducer, || Ok(Box::new(NetftFactory::new()?)));

/// Opens ATI's Net F/T boxes, and other boxes that send their records (RDT): `ati/netft:host=192.168.1.1`.
///
/// # The physical contract
/// - Forces and torques are in the transducer's own axes, in N and N·mm. The force and torque of one raw count are read at open from the page
///   `/netftapi2.xml` of the box.
/// - A box with a tool frame is refused unless `frame=tool` selects readings in that frame. A box is also refused if its rate differs from a stated
///   `rate`, or its smallest range is below a stated `force_max_n`. Without `force_max_n` each force has its range from the page.
/// - Units with their conversion, frame, low pass, rate, range, bias and serial number are settings that a recording keeps. The driver warns of the
///   delay of a low pass, and of a page that states no low pass.
/// - A reading is the newest record received. Datagrams of other senders are ignored. Torn, duplicate and overtaken records are dropped.
/// - A saturated gauge is `OutOfRange`; every other status except a latched threshold is `DeviceFault`, with its bits by name. A latched threshold is
///   a warning, since readings stay valid.
/// - Zero is the mean of 0.25 s, subtracted by the driver. The bias of the box stays unchanged.
///
/// # Verification
/// The driver passes its suite on an emulated box, which the public client `NetFT` 2.0.1 reads too. **Not verified without the device**: the status
/// bits, the delay of a low pass, and devices of other makers that send the same records.
///
/// ```
/// use taceva_core::Factory;
/// use taceva_drivers::ati::netft::NetftFactory;
/// let factory = NetftFactory::new()?;
/// assert!(factory.descriptor().args("host=192.168.1.1;force_max_n=65").is_ok());
/// # Ok::<(), taceva_core::DescriptorError>(())
/// ```
#[derive(Debug)]
pub struct NetftFactory {
    descriptor: Descriptor,
}

impl NetftFactory {
    /// Creates the factory.
    ///
    /// # Errors
    /// [`DescriptorError`] if the built-in descriptor is inconsistent. Tests exclude this case.
    pub fn new() -> Result<NetftFactory, DescriptorError> {
        let arguments = [
            ArgSpec::text("host").help("name or address of the box"),
            port("port", 49_152, "UDP port of its records"),
            port("page_port", 80, "TCP port of its web pages"),
            ArgSpec::number("rate", 0.1, 20_000.0)
                .unit("Hz")
                .optional()
                .help("readings per second that the box is set to, if known")
                .changes_facts(),
            ArgSpec::choice("frame", ["own", "tool"])
                .default(ArgValue::Text("own".to_owned()))
                .help("frame of the readings: own axes of the transducer, or the tool frame that is set in the box"),
        ];
        let facts = Facts::Force(
            ForceFacts::default()
                .with_axes(Axes::SIX)
                .with_tare(true)
                .with_numbered(true),
        );
        let title = "a force transducer behind a Net F/T box of ATI";
        let spec = DescriptorSpec::new(KEY, title, DriverSource::Real, facts);
        Ok(NetftFactory {
            descriptor: spec.arguments(arguments).arguments(force_facts()).check()?,
        })
    }
}

impl Factory<dyn ForceTransducer> for NetftFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
        let mut spec = self.descriptor.to_spec();
        if let Facts::Force(facts) = &mut spec.facts {
            facts.rate = optional_number(args, "rate").map(Hertz);
            add_facts_of_force(args, facts);
        }
        spec.check()
    }

    fn open(&self, args: &Args, _: &mut Rig) -> Result<Box<dyn ForceTransducer>, DriverError> {
        let options = NetftOptions {
            host: args.text("host").to_owned(),
            port: port_of(args, "port"),
            page_port: port_of(args, "page_port"),
            expected: Expected {
                frame: match args.text("frame") {
                    "tool" => Frame::Tool,
                    _ => Frame::Own,
                },
                rate_hz: optional_number(args, "rate"),
                force_max_n: optional_number(args, FORCE_MAX),
            },
        };
        Ok(Box::new(Transducer::open(options)?))
    }
}
