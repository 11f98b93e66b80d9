//! Plugins of a program and their drivers.

pub(crate) mod code;
mod discovery;
mod driver;
mod estimator;
mod isolation;
#[cfg(target_os = "linux")]
mod offer;
#[cfg(target_os = "linux")]
mod python;

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use taceva_core::{Args, DriverError, DriverKey, ErrorKind, Factory};

#[cfg(target_os = "linux")]
use crate::child::{ChildSession, Quarantine, no_port};
use crate::config::{Delivery, PluginConfig};
use crate::grant::{Grant, Withheld};
use crate::id::PluginId;
use crate::in_process::InProcess;
use crate::library::{Image, Level, Library, Log};
use crate::log::Limited;
use crate::manifest::{EstimatorInfo, Need, Profile, Provided, Sha256Digest};
use crate::search::{NotFound, Plugin, Plugins};
use crate::session::Session;

use self::discovery::Looker;
pub use self::driver::PluginDriver;
pub use self::isolation::Keeping;

/// Callback for log lines of plugins: plugin, level, target and message.
pub type PluginLog = Arc<dyn Fn(&PluginId, Level, &str, &str) + Send + Sync>;

/// Settings of the child processes of untrusted plugins.
#[derive(Clone, Debug, Default)]
pub struct Children {
    /// Program whose `main` begins with `main_if_child`; `None` for this program.
    pub program: Option<PathBuf>,
    /// Quarantine of crashed libraries. Without a quarantine, a crashed library starts again.
    #[cfg(target_os = "linux")]
    pub quarantine: Option<Quarantine>,
}

impl Children {
    /// Children of this program, with the quarantine of the current user.
    pub fn of_user() -> Children {
        Children {
            program: None,
            #[cfg(target_os = "linux")]
            quarantine: Quarantine::of_user(|name| std::env::var_os(name).map(PathBuf::from)),
        }
    }
}

/// Session, with the digest of its library.
type Started = (Arc<dyn Session>, Sha256Digest);

/// Results of isolation trials, by the needs of the child. The key for Python also has interpreter and profile.
type Tried = BTreeMap<(BTreeSet<Need>, Option<(PathBuf, Profile)>), Keeping>;

/// Plugins of a program, with their settings. Each plugin runs in the process that the user's settings choose.
pub struct PluginHost {
    plugins: Plugins,
    config: PluginConfig,
    log: PluginLog,
    #[cfg_attr(
        not(target_os = "linux"),
        expect(dead_code, reason = "child processes need Linux")
    )]
    children: Children,
    /// Libraries loaded in this process, one per plugin for all rigs.
    loaded: Mutex<BTreeMap<PluginId, (Arc<Library>, Sha256Digest)>>,
    /// Sessions for device discovery, one per plugin.
    lookers: Mutex<BTreeMap<PluginId, Looker>>,
    /// Isolation of children, by their needs.
    tried: Mutex<Tried>,
}

impl PluginHost {
    /// Creates a host of `plugins` with children of this program and the user's quarantine.
    pub fn new(plugins: Plugins, config: PluginConfig, log: PluginLog) -> Arc<PluginHost> {
        PluginHost::with_children(plugins, config, log, Children::of_user())
    }

    /// Creates a host of `plugins` with the settings `children` of its child processes.
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
            lookers: Mutex::default(),
            tried: Mutex::default(),
        })
    }

    /// Plugins that were found, and rejected plugins with their reasons.
    pub fn plugins(&self) -> &Plugins {
        &self.plugins
    }

    /// The user's settings.
    pub fn config(&self) -> &PluginConfig {
        &self.config
    }

    /// Needs that `plugin` always has and the user does not allow.
    pub fn withheld(&self, plugin: &Plugin) -> Withheld {
        self.config.grant(plugin).withheld
    }

    /// Needs of a device of `driver` that the user does not allow, for `arguments` as `key=value;key=value`. `None` for a driver of no plugin, or for invalid
    /// arguments.
    pub fn withheld_from(&self, driver: &str, arguments: &str) -> Option<Withheld> {
        let mut drivers = self.plugins.iter().flat_map(|plugin| {
            let drivers = plugin.manifest.drivers();
            drivers.map(move |descriptor| (plugin, descriptor))
        });
        let (plugin, descriptor) =
            drivers.find(|(_, descriptor)| descriptor.key().as_str() == driver)?;
        let args = Args::parse(descriptor.arguments(), arguments).ok()?;
        let grant = self
            .config
            .grant_for(plugin, descriptor.key(), &args)
            .ok()?;
        Some(grant.withheld)
    }

    /// Settings of the child processes.
    pub(crate) fn children(&self) -> &Children {
        &self.children
    }

    /// Drivers of kind `D` of every plugin, ordered by the id of the plugin.
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

    /// Estimators of every plugin, ordered by the id of the plugin.
    pub fn estimators(&self) -> impl Iterator<Item = (&Plugin, &EstimatorInfo)> {
        self.plugins.iter().flat_map(|plugin| {
            let estimators = plugin.manifest.estimators();
            estimators.map(move |estimator| (plugin, estimator))
        })
    }

    /// Starts a session of the plugin `id`. A trusted library runs in this process, any other plugin in a child.
    ///
    /// # Errors
    /// [`DriverError`] of `driver` if the plugin is missing, cannot be loaded, or contradicts its manifest.
    pub fn session(
        &self,
        id: &PluginId,
        driver: &DriverKey,
    ) -> Result<Arc<dyn Session>, DriverError> {
        let refused = |error: NotFound| {
            DriverError::new(ErrorKind::NotFound, driver, "load the plugin").because(error)
        };
        let plugin = self.plugins.get(id.as_str()).map_err(refused)?;
        self.start(plugin, driver).map(|(session, _)| session)
    }

    /// Starts a session of `plugin` with the needs of `grant`.
    fn session_of(
        &self,
        plugin: &Plugin,
        driver: &DriverKey,
        grant: &Grant,
    ) -> Result<Arc<dyn Session>, DriverError> {
        let started = self.start_within(plugin, driver, grant, None);
        started.map(|(session, _)| session)
    }

    /// Starts a session of `plugin`. Also returns the digest of its library.
    fn start(&self, plugin: &Plugin, driver: &DriverKey) -> Result<Started, DriverError> {
        self.start_within(plugin, driver, &self.config.grant(plugin), None)
    }

    /// Like [`start`](PluginHost::start), with `limit` as the child's timeout for loading and for each order.
    fn start_within(
        &self,
        plugin: &Plugin,
        driver: &DriverKey,
        grant: &Grant,
        limit: Option<Duration>,
    ) -> Result<Started, DriverError> {
        match self.config.delivery(plugin) {
            Delivery::InProcess => {
                let (library, digest) = self.library(plugin, driver)?;
                Ok((Arc::new(InProcess::open(&library)?), digest))
            }
            Delivery::Child => self
                .child(plugin, driver, grant, limit)
                .map_err(|error| grant.withheld.explained(error)),
        }
    }

    /// Reason of the quarantine of `plugin`'s library; `None` outside quarantine. Reads only libraries of plugins with a quarantine entry.
    pub fn quarantined(&self, plugin: &Plugin) -> Option<String> {
        #[cfg(target_os = "linux")]
        {
            let entries = self.children.quarantine.as_ref()?.entries().ok()?;
            let mut of_plugin = entries
                .into_iter()
                .filter(|entry| entry.plugin == plugin.id().as_str())
                .peekable();
            of_plugin.peek()?;
            let digest = plugin.read(&plugin.id().as_driver()).ok()?.digest();
            let entry = of_plugin.find(|entry| entry.sha256 == digest)?;
            Some(entry.reason)
        }
        #[cfg(not(target_os = "linux"))]
        {
            let _ = plugin;
            None
        }
    }

    /// Releases the libraries of the plugin `id`, or the library whose digest is `id`, from quarantine. Returns their number.
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

    /// Starts a session in a child with the needs of `grant`.
    #[cfg(target_os = "linux")]
    fn child(
        &self,
        plugin: &Plugin,
        driver: &DriverKey,
        grant: &Grant,
        limit: Option<Duration>,
    ) -> Result<Started, DriverError> {
        const DOING: &str = "load the plugin";
        let code = plugin.read(driver)?;
        // A trusted plugin that is not a library also runs in a separate process.
        let is_trusted = self.config.trust(plugin).is_some();
        let mut spec = plugin.child(&code, driver, &self.children, is_trusted)?;
        spec.log = Some(self.log_of(plugin));
        if let Some(limit) = limit {
            (spec.patience.start, spec.patience.open) = (limit, limit);
        }
        let log = self.log_of(plugin);
        spec.ended = Some(Box::new(move |fate, usage| {
            // The caller of a device receives the report of any other end.
            if fate.is_unheard() {
                let why = format!("closed late: {fate}; recordings are not affected");
                log(Level::Warn, "host", &why);
            }
            if usage.is_much() {
                log(Level::Warn, "host", &usage.to_string());
            }
        }));
        spec.confinement.needs = grant.reached.iter().cloned().collect();
        if let Some(why) = no_port(&spec.confinement.needs) {
            return Err(DriverError::new(ErrorKind::InvalidArgument, driver, DOING).because(why));
        }
        let session = ChildSession::of_plugin(spec, &plugin.manifest);
        let session = session.map_err(|error| error.of(driver, DOING))?;
        Ok((Arc::new(session), code.digest()))
    }

    #[cfg(not(target_os = "linux"))]
    fn child(
        &self,
        plugin: &Plugin,
        driver: &DriverKey,
        _: &Grant,
        _: Option<Duration>,
    ) -> Result<Started, DriverError> {
        let why = format!(
            "plugins are isolated only on Linux; `--trust {}` runs it in this process",
            plugin.id()
        );
        Err(DriverError::new(ErrorKind::Unsupported, driver, "load the plugin").because(why))
    }

    fn lock_lookers(&self) -> MutexGuard<'_, BTreeMap<PluginId, Looker>> {
        self.lookers.lock().unwrap_or_else(PoisonError::into_inner)
    }

    #[cfg(target_os = "linux")]
    fn lock_tried(&self) -> MutexGuard<'_, Tried> {
        self.tried.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Log callback for the lines of `plugin`.
    fn log_of(&self, plugin: &Plugin) -> Log {
        let (log, id) = (Arc::clone(&self.log), plugin.id().clone());
        Box::new(move |level, target, message| {
            log(&id, level, target, message);
        })
    }

    /// Library of a trusted plugin, loaded on first use.
    fn library(
        &self,
        plugin: &Plugin,
        driver: &DriverKey,
    ) -> Result<(Arc<Library>, Sha256Digest), DriverError> {
        let mut loaded = self.loaded.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((library, digest)) = loaded.get(plugin.id()) {
            return Ok((Arc::clone(library), *digest));
        }
        let library = plugin.library().ok_or_else(|| {
            let why = "it is written in Python and can run only in a separate process";
            DriverError::new(ErrorKind::Unsupported, driver, "load the plugin").because(why)
        })?;
        let image =
            Image::read(&plugin.folder, library).map_err(|error| error.of_driver(driver))?;
        let log = Limited::new(self.log_of(plugin));
        let log = Box::new(move |level, target: &str, message: &str| {
            log.tell(level, target, message);
        });
        let library = Library::load(&image, &plugin.manifest, log)
            .map_err(|error| error.of_driver(driver))?;
        let digest = image.digest();
        loaded.insert(plugin.id().clone(), (Arc::clone(&library), digest));
        Ok((library, digest))
    }
}

impl std::fmt::Debug for PluginHost {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let ids = self.plugins.iter().map(Plugin::id);
        f.debug_set().entries(ids).finish()
    }
}
