//! Driver of a plugin, with the interface of all drivers.

use std::sync::Arc;

use taceva_core::{
    ArgValue, Args, Changer, Descriptor, DescriptorError, DriverError, DriverKey, ErrorKind,
    Factory, ForceTransducer, Found, Lighting, Rig, Robot, Sensor,
};

use super::PluginHost;
use crate::config::Delivery;
use crate::descriptor::changes_facts;
use crate::grant::{self, Grant};
use crate::id::PluginId;
use crate::library::Level;
use crate::manifest::UsbId;
use crate::search::Plugin;
use crate::session::Session;
use crate::usb;

/// Driver of a plugin. The manifest describes the driver, and the library opens its devices.
#[derive(Debug)]
pub struct PluginDriver {
    pub(super) host: Arc<PluginHost>,
    pub(super) plugin: PluginId,
    pub(super) descriptor: Box<Descriptor>,
    pub(super) usb: Vec<UsbId>,
}

impl PluginDriver {
    /// Opens a device in the plugin's session of `rig`. Registers the bench of the device, if any, in the rig.
    fn open_in<D: ?Sized>(
        &self,
        args: &Args,
        rig: &mut Rig,
        open: impl FnOnce(&dyn Session, &DriverKey, &Args) -> Result<Box<D>, DriverError>,
    ) -> Result<Box<D>, DriverError> {
        let key = self.descriptor.key();
        let plugin = self.plugin("load the plugin")?;
        let (grant, args) = self.granted(plugin, args)?;
        let args = &args;
        // A child's needs are fixed at its start, so devices with different needs get separate children.
        let name = match grant.is_bound {
            true => format!("plugin {} {:?}", self.plugin, grant.reached),
            false => format!("plugin {}", self.plugin),
        };
        let session: Arc<Arc<dyn Session>> =
            rig.share(&name, || self.host.session_of(plugin, key, &grant))?;
        let device =
            open(&**session, key, args).map_err(|error| grant.withheld.explained(error))?;
        if let Some(ArgValue::Text(bench)) = args.get("rig")
            && let Some(found) = session.bench(bench)
        {
            rig.offer_bench(&format!("{} {bench}", self.plugin), found);
        }
        Ok(device)
    }

    /// Needs granted to a device that is opened with `args`. Also returns the arguments with host names replaced by addresses.
    fn granted(&self, plugin: &Plugin, args: &Args) -> Result<(Grant, Args), DriverError> {
        let key = self.descriptor.key();
        let config = self.host.config();
        let grant = config.grant_for(plugin, key, args)?;
        if config.delivery(plugin) == Delivery::InProcess || !grant.is_bound {
            return Ok((grant, args.clone()));
        }
        // A host name without permission is not resolved.
        if plugin.manifest.needs.iter().any(|need| {
            let bound = need
                .fixed()
                .is_none()
                .then(|| need.bound_to(args).ok().flatten());
            let withheld = grant.withheld.needs();
            bound
                .flatten()
                .is_some_and(|bound| withheld.contains(&bound))
        }) {
            let denied = DriverError::new(ErrorKind::PermissionDenied, key, "open the device")
                .because(grant::NOT_ALLOWED);
            return Err(grant.withheld.explained(denied));
        }
        let args = grant::resolved(plugin, key, self.descriptor.arguments(), args)?;
        Ok((grant, args))
    }

    /// Description of the driver. The description is from the library if `args` can change the facts. Otherwise, or after a failure, it is from the manifest.
    fn described(&self, args: &Args) -> Descriptor {
        let manifest = &*self.descriptor;
        if !changes_facts(manifest, args) {
            return manifest.clone();
        }
        let key = manifest.key();
        let session = self.host.session(&self.plugin, key);
        let said = session.and_then(|session| session.describe(key, args));
        said.unwrap_or_else(|error| {
            let line = format!(
                "used the description in the manifest, because the library gave none: {error}"
            );
            (self.host.log)(&self.plugin, Level::Warn, key.as_str(), &line);
            manifest.clone()
        })
    }

    /// Digest of the library that opens the devices.
    fn digest(&self) -> Result<String, DriverError> {
        let key = self.descriptor.key();
        let plugin = self.plugin("read the library")?;
        Ok(format!("sha256:{}", plugin.read(key)?.digest()))
    }

    /// Devices that the library finds. If it finds none, returns the USB devices that the manifest names and the kernel lists.
    fn present(&self) -> Result<Vec<Found>, DriverError> {
        let key = self.descriptor.key();
        let found = self.host.look(self.plugin("look for devices")?, key)?;
        Ok(if found.is_empty() { self.seen() } else { found })
    }

    /// Plugin of the driver.
    fn plugin(&self, doing: &'static str) -> Result<&Plugin, DriverError> {
        let key = self.descriptor.key();
        let plugin = self.host.plugins().get(self.plugin.as_str());
        plugin.map_err(|error| DriverError::new(ErrorKind::NotFound, key, doing).because(error))
    }

    /// USB devices that the manifest names and the system lists.
    fn seen(&self) -> Vec<Found> {
        if self.usb.is_empty() {
            return Vec::new();
        }
        let devices = usb::plugged_in();
        let ours = devices
            .into_iter()
            .filter(|device| self.usb.contains(&device.id));
        let found = ours.map(|device| {
            Found::new(
                self.descriptor.key().clone(),
                (device.product).unwrap_or_else(|| self.descriptor.title().to_owned()),
            )
        });
        found.collect()
    }
}

macro_rules! factories {
    ($($device:ty => $open:ident),* $(,)?) => {$(
        impl Factory<$device> for PluginDriver {
            fn descriptor(&self) -> &Descriptor {
                &self.descriptor
            }

            fn describe(&self, args: &Args) -> Result<Descriptor, DescriptorError> {
                Ok(self.described(args))
            }

            fn open(&self, args: &Args, rig: &mut Rig) -> Result<Box<$device>, DriverError> {
                self.open_in(args, rig, |session, key, args| session.$open(key, args))
            }

            fn discover(&self) -> Result<Vec<Found>, DriverError> {
                self.present()
            }

            fn build(&self) -> Result<Option<String>, DriverError> {
                self.digest().map(Some)
            }
        }
    )*};
}

factories! {
    dyn Sensor => sensor,
    dyn Robot => robot,
    dyn ForceTransducer => force,
    dyn Lighting => lighting,
    dyn Changer => changer,
}
