//! A driver of a plugin among other drivers.

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

/// A driver of a plugin: described by its manifest, opened by its library.
#[derive(Debug)]
pub struct PluginDriver {
    pub(super) host: Arc<PluginHost>,
    pub(super) plugin: PluginId,
    pub(super) descriptor: Box<Descriptor>,
    pub(super) usb: Vec<UsbId>,
}

impl PluginDriver {
    /// Opens a device in the session that `rig` has of the plugin, and makes its bench known, where it is one.
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
        // A process reaches what it reached from its beginning: devices of other places are opened in others.
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

    /// What a device may reach that is opened with `args`, and the arguments with the addresses of the machines that they name.
    fn granted(&self, plugin: &Plugin, args: &Args) -> Result<(Grant, Args), DriverError> {
        let key = self.descriptor.key();
        let config = self.host.config();
        let grant = config.grant_for(plugin, key, args)?;
        if config.delivery(plugin) == Delivery::InProcess || !grant.is_bound {
            return Ok((grant, args.clone()));
        }
        // Nobody is asked for the address of a machine that may not be reached.
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

    /// What the manifest says, unless `args` can change that: then the library is asked, in its process. Where it cannot be, opening the
    /// device will say why.
    fn described(&self, args: &Args) -> Descriptor {
        let manifest = &*self.descriptor;
        if !changes_facts(manifest, args) {
            return manifest.clone();
        }
        let key = manifest.key();
        let session = self.host.session(&self.plugin, key);
        let said = session.and_then(|session| session.describe(key, args));
        said.unwrap_or_else(|error| {
            let line = format!("described by its manifest alone: {error}");
            (self.host.log)(&self.plugin, Level::Warn, key.as_str(), &line);
            manifest.clone()
        })
    }

    /// The digest of the library that opens its devices.
    fn digest(&self) -> Result<String, DriverError> {
        let key = self.descriptor.key();
        let plugin = self.plugin("read the library")?;
        Ok(format!("sha256:{}", plugin.read(key)?.digest()))
    }

    /// The devices that the library finds; where it finds none, those that the manifest names and the kernel lists.
    fn present(&self) -> Result<Vec<Found>, DriverError> {
        let key = self.descriptor.key();
        let found = self.host.look(self.plugin("look for devices")?, key)?;
        Ok(if found.is_empty() { self.seen() } else { found })
    }

    /// The plugin that it is of.
    fn plugin(&self, doing: &'static str) -> Result<&Plugin, DriverError> {
        let key = self.descriptor.key();
        let plugin = self.host.plugins().get(self.plugin.as_str());
        plugin.map_err(|error| DriverError::new(ErrorKind::NotFound, key, doing).because(error))
    }

    /// The devices that the manifest names and the system lists.
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
