//! The plugins of a program, and the drivers that they are.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use taceva_core::{
    Access, ArgValue, Args, Descriptor, DriverError, DriverKey, ErrorKind, Factory,
    ForceTransducer, Found, Lighting, Rig, Robot, Sensor,
};

#[cfg(target_os = "linux")]
use crate::child::{ChildSession, ChildSpec, Quarantine};
use crate::config::{Delivery, PluginConfig};
use crate::id::PluginId;
use crate::in_process::InProcess;
use crate::library::{Image, Level, Library};
use crate::manifest::{EstimatorInfo, Provided, UsbId};
use crate::search::{NotFound, Plugin, Plugins};
use crate::session::Session;
use crate::usb;

/// Takes what plugins log: whose line it is, how much it matters, what it is about, and what it says.
pub type PluginLog = Arc<dyn Fn(&PluginId, Level, &str, &str) + Send + Sync>;

/// Where the code of plugins runs that are not trusted.
#[derive(Clone, Debug, Default)]
pub struct Children {
    /// The program whose `main` begins with `main_if_child`: this one, if none is named.
    pub program: Option<PathBuf>,
    /// Where libraries that crashed are kept; without, they are started again.
    #[cfg(target_os = "linux")]
    pub quarantine: Option<Quarantine>,
}

impl Children {
    /// This program, and the quarantine of the user whom the environment names.
    pub fn of_user() -> Children {
        Children {
            program: None,
            #[cfg(target_os = "linux")]
            quarantine: Quarantine::of_user(|name| std::env::var_os(name).map(PathBuf::from)),
        }
    }
}

/// The plugins of a program: found, settled, and delivered as the user decided.
pub struct PluginHost {
    plugins: Plugins,
    config: PluginConfig,
    log: PluginLog,
    #[cfg_attr(
        not(target_os = "linux"),
        expect(dead_code, reason = "children are for Linux")
    )]
    children: Children,
    /// What is loaded in this process: once a plugin, however many rigs use it.
    loaded: Mutex<BTreeMap<PluginId, Arc<Library>>>,
}

impl PluginHost {
    /// A host of `plugins` whose children are this program, and whose quarantine is the user's.
    pub fn new(plugins: Plugins, config: PluginConfig, log: PluginLog) -> Arc<PluginHost> {
        PluginHost::with_children(plugins, config, log, Children::of_user())
    }

    /// A host of `plugins` with children of its own.
    pub fn with_children(
        plugins: Plugins,
        config: PluginConfig,
        log: PluginLog,
        children: Children,
    ) -> Arc<PluginHost> {
        Arc::new(PluginHost {
            plugins,
            config,
            log,
            children,
            loaded: Mutex::default(),
        })
    }

    /// What was found and refused.
    pub fn plugins(&self) -> &Plugins {
        &self.plugins
    }

    /// What the user decided.
    pub fn config(&self) -> &PluginConfig {
        &self.config
    }

    /// Where plugins run that are not trusted.
    pub(crate) fn children(&self) -> &Children {
        &self.children
    }

    /// The drivers of kind `D` of every plugin, by key.
    pub fn drivers<D>(self: &Arc<PluginHost>) -> Vec<Box<dyn Factory<D>>>
    where
        D: taceva_core::Device + ?Sized,
        PluginDriver: Factory<D>,
    {
        let mut drivers: Vec<Box<dyn Factory<D>>> = Vec::new();
        for plugin in self.plugins.iter() {
            for provided in &plugin.manifest.provides {
                if let Provided::Driver { descriptor, usb } = provided
                    && descriptor.kind() == D::KIND
                {
                    drivers.push(Box::new(PluginDriver {
                        host: Arc::clone(self),
                        plugin: plugin.id().clone(),
                        descriptor: descriptor.clone(),
                        usb: usb.clone(),
                    }));
                }
            }
        }
        drivers
    }

    /// The estimators of every plugin, by key.
    pub fn estimators(&self) -> impl Iterator<Item = (&Plugin, &EstimatorInfo)> {
        self.plugins.iter().flat_map(|plugin| {
            let estimators = plugin.manifest.estimators();
            estimators.map(move |estimator| (plugin, estimator))
        })
    }

    /// A new session of the plugin called `id`, delivered as the user decided; never otherwise.
    ///
    /// # Errors
    /// [`DriverError`] of `driver` if the plugin is not there, cannot be loaded, or is another than its manifest says.
    pub fn session(
        &self,
        id: &PluginId,
        driver: &DriverKey,
    ) -> Result<Arc<dyn Session>, DriverError> {
        let refused = |error: NotFound| {
            DriverError::new(ErrorKind::NotFound, driver, "load the plugin").because(error)
        };
        let plugin = self.plugins.get(id.as_str()).map_err(refused)?;
        match self.config.delivery(plugin) {
            Delivery::InProcess => {
                let library = self.library(plugin, driver)?;
                Ok(Arc::new(InProcess::open(&library)?))
            }
            Delivery::Child => self.child(plugin, driver),
        }
    }

    /// Why the library of `plugin` is not started any more, if it crashed and nobody released it since. Only the libraries of plugins that
    /// crashed are read for this.
    pub fn quarantined(&self, plugin: &Plugin) -> Option<String> {
        #[cfg(target_os = "linux")]
        {
            let entries = self.children.quarantine.as_ref()?.entries().ok()?;
            let mut of_plugin = entries
                .into_iter()
                .filter(|entry| entry.plugin == plugin.id().as_str())
                .peekable();
            of_plugin.peek()?;
            let image = Image::read(&plugin.folder, &plugin.library).ok()?;
            let entry = of_plugin.find(|entry| entry.sha256 == image.digest())?;
            Some(entry.reason)
        }
        #[cfg(not(target_os = "linux"))]
        {
            let _ = plugin;
            None
        }
    }

    /// Lets the libraries of the plugin called `id`, or the one with that digest, start again; says how many were in quarantine.
    ///
    /// # Errors
    /// If the quarantine cannot be read or changed.
    pub fn release(&self, id: &str) -> io::Result<usize> {
        #[cfg(target_os = "linux")]
        if let Some(quarantine) = &self.children.quarantine {
            return quarantine.release(id);
        }
        let _ = id;
        Ok(0)
    }

    /// A session in a child that may reach what the plugin asks for and the user allows.
    #[cfg(target_os = "linux")]
    fn child(&self, plugin: &Plugin, driver: &DriverKey) -> Result<Arc<dyn Session>, DriverError> {
        const DOING: &str = "load the plugin";
        let image = Image::read(&plugin.folder, &plugin.library)
            .map_err(|error| error.of_driver(driver))?;
        let Children {
            program,
            quarantine,
        } = self.children.clone();
        let spec = ChildSpec::of_plugin(&image, &plugin.manifest, &plugin.text, quarantine);
        let mut spec = spec
            .map_err(|error| DriverError::new(ErrorKind::Internal, driver, DOING).because(error))?;
        spec.program = program;
        spec.confinement.needs = self.config.allowed(plugin).into_iter().collect();
        let session = ChildSession::of_plugin(spec, &plugin.manifest);
        Ok(Arc::new(session.map_err(|error| error.of(driver, DOING))?))
    }

    #[cfg(not(target_os = "linux"))]
    fn child(&self, plugin: &Plugin, driver: &DriverKey) -> Result<Arc<dyn Session>, DriverError> {
        let why = format!(
            "plugins are isolated on Linux alone; `--trust {}` runs it in this process",
            plugin.id()
        );
        Err(DriverError::new(ErrorKind::Unsupported, driver, "load the plugin").because(why))
    }

    /// The library of a trusted plugin, loaded when it is first needed.
    fn library(&self, plugin: &Plugin, driver: &DriverKey) -> Result<Arc<Library>, DriverError> {
        let mut loaded = self.loaded.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(library) = loaded.get(plugin.id()) {
            return Ok(Arc::clone(library));
        }
        let image = Image::read(&plugin.folder, &plugin.library)
            .map_err(|error| error.of_driver(driver))?;
        let (log, id) = (Arc::clone(&self.log), plugin.id().clone());
        let line = Box::new(move |level, target: &str, message: &str| {
            log(&id, level, target, message);
        });
        let library = Library::load(&image, &plugin.manifest, line)
            .map_err(|error| error.of_driver(driver))?;
        loaded.insert(plugin.id().clone(), Arc::clone(&library));
        Ok(library)
    }
}

impl std::fmt::Debug for PluginHost {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let ids = self.plugins.iter().map(Plugin::id);
        f.debug_set().entries(ids).finish()
    }
}

/// A driver of a plugin: described by its manifest, opened by its library.
#[derive(Debug)]
pub struct PluginDriver {
    host: Arc<PluginHost>,
    plugin: PluginId,
    descriptor: Box<Descriptor>,
    usb: Vec<UsbId>,
}

impl PluginDriver {
    /// Opens a device in the session that `rig` has of the plugin, and makes its bench known, where it is one.
    fn open_in<D: ?Sized>(
        &self,
        args: &Args,
        rig: &mut Rig,
        open: impl FnOnce(&dyn Session, &DriverKey) -> Result<Box<D>, DriverError>,
    ) -> Result<Box<D>, DriverError> {
        let key = self.descriptor.key();
        let name = format!("plugin {}", self.plugin);
        let session: Arc<Arc<dyn Session>> =
            rig.share(&name, || self.host.session(&self.plugin, key))?;
        let device = open(&**session, key)?;
        if let Some(ArgValue::Text(bench)) = args.get("rig")
            && let Some(found) = session.bench(bench)
        {
            rig.offer_bench(&format!("{} {bench}", self.plugin), found);
        }
        Ok(device)
    }

    /// The devices that the manifest names and the kernel lists.
    fn seen(&self) -> Vec<Found> {
        if self.usb.is_empty() {
            return Vec::new();
        }
        let devices = usb::plugged_in(Path::new("/sys/bus/usb/devices"));
        let ours = devices
            .into_iter()
            .filter(|device| self.usb.contains(&device.id));
        let found = ours.map(|device| Found {
            driver: self.descriptor.key().clone(),
            title: (device.product).unwrap_or_else(|| self.descriptor.title().to_owned()),
            arguments: String::new(),
            access: Access::Ready,
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

            fn open(&self, args: &Args, rig: &mut Rig) -> Result<Box<$device>, DriverError> {
                self.open_in(args, rig, |session, key| session.$open(key, args))
            }

            fn discover(&self) -> Result<Vec<Found>, DriverError> {
                Ok(self.seen())
            }
        }
    )*};
}

factories! {
    dyn Sensor => sensor,
    dyn Robot => robot,
    dyn ForceTransducer => force,
    dyn Lighting => lighting,
}
