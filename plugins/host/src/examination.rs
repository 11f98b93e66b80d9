//! Examination of a plugin: code of this program tests the plugin in a child process.

use std::fs::File;
use std::io::{self, Write};
use std::os::fd::OwnedFd;
use std::sync::Arc;
use std::time::Duration;

use rustix::fs::{MemfdFlags, memfd_create};
use taceva_core::{Args, DriverError};

use crate::child::{Child, ChildError, no_port};
use crate::grant::{self, Grant, Withheld};
use crate::host::PluginHost;
use crate::host::code::ReadCode;
use crate::library::Log;
use crate::search::Plugin;

/// A plugin whose code was read and can be examined in children.
pub struct Examination<'a> {
    host: &'a PluginHost,
    plugin: &'a Plugin,
    code: ReadCode,
}

/// One examination in a separate child.
pub struct ExaminationOrder<'a> {
    /// Key of the driver or estimator; empty for the plugin as a whole.
    pub driver: &'a str,
    /// Arguments of the driver, `key=value;key=value`.
    pub arguments: &'a str,
    /// Timeout after which the child is killed.
    pub limit: Duration,
    /// Callback for log lines. A line with the target [`CALL`](crate::bare::CALL) names the pending call.
    pub log: Log,
}

/// Failure of an examination.
#[derive(Debug)]
pub enum ExaminationError {
    /// The child could not be prepared.
    Unready(String),
    /// The child refused to serve or ended.
    Child {
        /// Error of the child.
        error: Box<ChildError>,
        /// Needs that the user does not allow.
        withheld: Withheld,
        /// True if arguments may name a withheld need.
        lacks_bound: bool,
    },
}

impl PluginHost {
    /// Reads the code of `plugin` for examinations.
    ///
    /// # Errors
    /// [`DriverError`] if the plugin cannot run at all.
    pub fn examination<'a>(&'a self, plugin: &'a Plugin) -> Result<Examination<'a>, DriverError> {
        let whole = plugin.id().as_driver();
        let code = plugin.read(&whole)?;
        let is_trusted = self.config().trust(plugin).is_some();
        plugin.child(&code, &whole, self.children(), is_trusted)?;
        Ok(Examination {
            host: self,
            plugin,
            code,
        })
    }

    /// Needs granted to an examination of `driver`, as for a device opened with `arguments`. Also returns the arguments, with addresses in place of
    /// host names.
    fn grant_of(
        &self,
        plugin: &Plugin,
        driver: &str,
        arguments: &str,
    ) -> Result<(Grant, String), DriverError> {
        let mut drivers = plugin.manifest.drivers();
        let descriptor = drivers.find(|descriptor| descriptor.key().as_str() == driver);
        let args = descriptor.and_then(|descriptor| {
            let args = Args::parse(descriptor.arguments(), arguments).ok()?;
            Some((descriptor, args))
        });
        let Some((descriptor, args)) = args else {
            // The check itself reports invalid arguments.
            return Ok((self.config().grant(plugin), arguments.to_owned()));
        };
        let (key, specs) = (descriptor.key(), descriptor.arguments());
        let grant = self.config().grant_for(plugin, key, &args)?;
        let is_trusted = self.config().trust(plugin).is_some();
        if is_trusted || !grant.is_bound || grant.lacks_bound() {
            return Ok((grant, arguments.to_owned()));
        }
        let args = grant::resolved(plugin, key, specs, &args)?;
        let given = specs.iter().filter_map(|spec| {
            let value = args.get(&spec.key)?.to_string();
            Some(format!("{}={}", spec.key, value.replace(';', ";;")))
        });
        Ok((grant, given.collect::<Vec<_>>().join(";")))
    }
}

impl Examination<'_> {
    /// Runs the [`Examiner`](crate::Examiner) of the child's program on the order that `encode` makes from the arguments. Returns the output of the
    /// child.
    ///
    /// # Errors
    /// [`ExaminationError`] if the child was not started, or ended without a session.
    pub fn run(
        &self,
        order: ExaminationOrder<'_>,
        encode: impl FnOnce(String) -> Vec<u8>,
    ) -> Result<String, ExaminationError> {
        let unready = |error: &dyn ToString| ExaminationError::Unready(error.to_string());
        let granted = self
            .host
            .grant_of(self.plugin, order.driver, order.arguments);
        let (grant, arguments) = granted.map_err(|error| unready(&error))?;
        let whole = self.plugin.id().as_driver();
        let is_trusted = self.host.config().trust(self.plugin).is_some();
        let children = self.host.children();
        let spec = self.plugin.child(&self.code, &whole, children, is_trusted);
        let mut spec = spec.map_err(|error| unready(&error))?;
        spec.files
            .push(in_memory(&encode(arguments)).map_err(|error| unready(&error))?);
        // An examination provokes crashes. They must not put the plugin into quarantine.
        spec.quarantine = None;
        spec.confinement.needs = grant.reached.iter().cloned().collect();
        if let Some(why) = no_port(&spec.confinement.needs) {
            return Err(ExaminationError::Unready(why));
        }
        spec.log = Some(order.log);
        spec.patience.start = order.limit;
        let child = Child::start(spec).map_err(|error| ExaminationError::Child {
            error: Box::new(error),
            lacks_bound: grant.lacks_bound(),
            withheld: grant.withheld,
        })?;
        let life = Arc::clone(child.life());
        drop(child);
        Ok(life.watch.printed())
    }
}

/// Creates an in-memory file that contains `bytes`.
fn in_memory(bytes: &[u8]) -> io::Result<OwnedFd> {
    let mut file = File::from(memfd_create(c"taceva-order", MemfdFlags::CLOEXEC)?);
    file.write_all(bytes)?;
    Ok(file.into())
}
