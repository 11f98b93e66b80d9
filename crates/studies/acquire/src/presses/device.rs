//! An open device with its descriptor.

use taceva_core::{Descriptor, Device, Registry, Rig};
use taceva_drivers::{OpenError, Selector, open};

use super::latency::{IntoDevice, Late};

/// An open device with its descriptor.
pub(crate) struct Opened<D: ?Sized> {
    pub(crate) device: Box<D>,
    pub(crate) descriptor: Descriptor,
    pub(crate) selector: Selector,
}

impl<D: Device + ?Sized> Opened<D> {
    /// Opens the device of `selector`; the descriptor reflects its arguments.
    pub(crate) fn open(
        registry: &Registry<D>,
        selector: Selector,
        shared: &mut Rig,
    ) -> Result<Opened<D>, OpenError> {
        let device = open(registry, &selector, shared)?;
        let factory = registry
            .get(selector.driver())
            .expect("it was opened by this key");
        let arguments = factory.descriptor().args(selector.arguments());
        let described = arguments
            .ok()
            .and_then(|arguments| factory.describe(&arguments).ok());
        Ok(Opened {
            device,
            descriptor: described.unwrap_or_else(|| factory.descriptor().clone()),
            selector,
        })
    }
}

impl<D: ?Sized + 'static> Opened<D>
where
    Late<D>: IntoDevice<D>,
{
    /// Corrects the stamps of the device by `latency_ms` of its facts, if above 0.
    pub(crate) fn timely(self, latency_ms: impl Fn(&Descriptor) -> Option<f64>) -> Box<D> {
        match latency_ms(&self.descriptor) {
            Some(latency_ms) if latency_ms > 0.0 => Late::new(self.device, latency_ms).boxed(),
            _ => self.device,
        }
    }
}
