//! A force transducer under a simulated indenter.

use std::time::Duration;

use taceva_core::{
    Args, Axes, Deadline, Descriptor, DescriptorError, DescriptorSpec, DriverError, DriverKey,
    DriverSource, ErrorKind, Factory, Facts, ForceFacts, ForceTransducer, Hertz, Newton, Rig,
    Stamp, Tare, Wrench,
};

use super::error::{failed, rig_argument, rig_name};
use super::rig::SimulatedRig;
use crate::parameters::Model;

const KEY: DriverKey = DriverKey::fixed("sim/force-transducer");
/// Reading rate, Hz. Each reading averages over the time since the last reading.
const RATE_HZ: f64 = 200.0;
const READING: Duration = Duration::from_millis(5);
/// Number of readings averaged for the tare.
const TARE_READINGS: u32 = 16;

/// Opens simulated force transducers.
#[derive(Debug)]
pub struct ForceTransducerFactory {
    descriptor: Descriptor,
}

impl ForceTransducerFactory {
    /// Creates the factory of `sim/force-transducer`.
    ///
    /// # Errors
    /// [`DescriptorError`] if its description contradicts itself.
    pub fn new() -> Result<ForceTransducerFactory, DescriptorError> {
        let facts = ForceFacts::default()
            .with_axes(Axes::FORCE)
            .with_rate(Hertz(RATE_HZ))
            .with_force_max(Newton(Model::GelSight.parameters().transducer.range_n))
            .with_tare(true);
        let spec = DescriptorSpec::new(
            KEY,
            "simulated force transducer",
            DriverSource::Simulated,
            Facts::Force(facts),
        );
        Ok(ForceTransducerFactory {
            descriptor: spec.arguments([rig_argument()]).check()?,
        })
    }
}

impl Factory<dyn ForceTransducer> for ForceTransducerFactory {
    fn descriptor(&self) -> &Descriptor {
        &self.descriptor
    }

    fn open(&self, args: &Args, rig: &mut Rig) -> Result<Box<dyn ForceTransducer>, DriverError> {
        Ok(Box::new(SimulatedTransducer {
            rig: SimulatedRig::of(rig, rig_name(args)),
        }))
    }
}

taceva_core::submit_builtin!(dyn ForceTransducer, || Ok(Box::new(
    ForceTransducerFactory::new()?
)));

struct SimulatedTransducer {
    rig: SimulatedRig,
}

impl SimulatedTransducer {
    /// Advances the clock by the duration of some readings.
    fn wait(
        &self,
        doing: &'static str,
        readings: u32,
        deadline: Deadline,
    ) -> Result<(), DriverError> {
        let period = READING * readings;
        self.rig.state().rest(period.min(deadline.remaining()));
        if deadline.remaining() < period {
            let why = format!("no reading within {deadline}");
            return Err(failed(ErrorKind::Timeout, &KEY, doing, why));
        }
        Ok(())
    }
}

impl ForceTransducer for SimulatedTransducer {
    fn axes(&self) -> Axes {
        Axes::FORCE
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        let doing = "read the force";
        self.wait(doing, 1, deadline)?;
        let mut state = self.rig.state();
        let force_n = state.read();
        let range_n = state.force_range_n();
        if let Some(beyond) = force_n.iter().find(|force| force.abs() >= range_n) {
            let why =
                format!("a force of {beyond} N exceeds the range, expected less than {range_n} N");
            return Err(failed(ErrorKind::OutOfRange, &KEY, doing, why));
        }
        let wrench = Wrench {
            force: force_n.map(Newton),
            ..Wrench::default()
        };
        Ok((wrench, Stamp::at(state.now())))
    }

    fn tare(&mut self) -> Option<&mut dyn Tare> {
        Some(self)
    }
}

impl Tare for SimulatedTransducer {
    fn zero(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.wait("zero the force", TARE_READINGS, deadline)?;
        self.rig.state().tare(TARE_READINGS);
        Ok(())
    }
}
