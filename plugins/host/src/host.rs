//! The plugins of a program, and the drivers that they are.

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

/// A session, and the digest of the library that answers in it.
type Started = (Arc<dyn Session>, Sha256Digest);

/// What was found to be enforced, by what children may reach and by the interpreter and the profile of those that have one.
type Tried = BTreeMap<(BTreeSet<Need>, Option<(PathBuf, Profile)>), Keeping>;

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
    loaded: Mutex<BTreeMap<PluginId, (Arc<Library>, Sha256Digest)>>,
    /// Where devices are looked for: one session a plugin.
    lookers: Mutex<BTreeMap<PluginId, Looker>>,
    /// What is enforced upon children, by what they may reach.
    tried: Mutex<Tried>,
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
            lookers: Mutex::default(),
            tried: Mutex::default(),
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

    /// What `plugin` needs whatever it is opened with, and its user does not allow.
    pub fn withheld(&self, plugin: &Plugin) -> Withheld {
        self.config.grant(plugin).withheld
    }

    /// What a device of `driver` needs that is opened with `arguments`, `key=value;key=value`, and its user does not allow; `None` if no
    /// plugin has that driver, or these are no arguments of it.
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
        self.start(plugin, driver).map(|(session, _)| session)
    }

    /// A new session of `plugin` that reaches what `grant` gives.
    fn session_of(
        &self,
        plugin: &Plugin,
        driver: &DriverKey,
        grant: &Grant,
    ) -> Result<Arc<dyn Session>, DriverError> {
        let started = self.start_within(plugin, driver, grant, None);
        started.map(|(session, _)| session)
    }

    /// A new session of `plugin`, and the digest of the library that answers in it.
    fn start(&self, plugin: &Plugin, driver: &DriverKey) -> Result<Started, DriverError> {
        self.start_within(plugin, driver, &self.config.grant(plugin), None)
    }

    /// The same, of a child that has so long to load and for each order.
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

    /// A session in a child that may reach what `grant` gives.
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
        let mut spec = plugin.child(&code, driver, &self.children)?;
        // What is trusted and is no library runs in a process of its own all the same.
        spec.confinement.is_trusted = self.config.trust(plugin).is_some();
        spec.log = Some(self.log_of(plugin));
        if let Some(limit) = limit {
            (spec.patience.start, spec.patience.open) = (limit, limit);
        }
        let log = self.log_of(plugin);
        spec.ended = Some(Box::new(move |fate, usage| {
            // Of any other end somebody hears who asked for something.
            if fate.is_unheard() {
                let why = format!("closed late: {fate}; what was recorded is not affected");
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
            "plugins are isolated on Linux alone; `--trust {}` runs it in this process",
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

    /// Where the lines of `plugin` go, however it is delivered.
    fn log_of(&self, plugin: &Plugin) -> Log {
        let (log, id) = (Arc::clone(&self.log), plugin.id().clone());
        Box::new(move |level, target, message| {
            log(&id, level, target, message);
        })
    }

    /// The library of a trusted plugin, loaded when it is first needed.
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
            let why = "it is written in Python, and runs in a process of its own alone";
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
