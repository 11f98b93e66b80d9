//! Isolation of a plugin, found by a trial: a child without a plugin confines itself and reports the result.

use std::fmt;

use super::PluginHost;
#[cfg(target_os = "linux")]
use crate::child::{Child, ChildSpec};
use crate::config::Trust;
use crate::search::Plugin;

/// Isolation in which a plugin's code would run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Keeping {
    /// In this process, for this reason.
    Trusted(Trust),
    /// In a separate process without restrictions, for this reason.
    Apart(Trust),
    /// In a separate process with these restrictions, in words.
    Confined(String),
    /// The plugin does not run: this machine cannot confine it, for this reason.
    Refused(String),
}

impl Keeping {
    /// True if the plugin can run.
    pub fn is_possible(&self) -> bool {
        !matches!(self, Keeping::Refused(_))
    }
}

impl fmt::Display for Keeping {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Keeping::Trusted(trust) => write!(f, "in this process, unconfined: {trust}"),
            Keeping::Apart(trust) => write!(f, "in a process of its own, unconfined: {trust}"),
            Keeping::Confined(words) => write!(f, "in {words}"),
            Keeping::Refused(why) => write!(f, "cannot run: {why}"),
        }
    }
}

impl PluginHost {
    /// Isolation in which `plugin` would run. Runs no code of the plugin.
    pub fn keeping(&self, plugin: &Plugin) -> Keeping {
        match self.config.trust(plugin) {
            Some(trust) if plugin.library().is_some() => Keeping::Trusted(trust),
            Some(trust) => Keeping::Apart(trust),
            None => self.confined(plugin),
        }
    }

    /// Isolation of a child with the needs of `plugin`. The trial runs once for equal needs.
    #[cfg(target_os = "linux")]
    fn confined(&self, plugin: &Plugin) -> Keeping {
        let needs = self.config.allowed(plugin);
        let runs = plugin.interpreter.as_ref().zip(plugin.module());
        if plugin.module().is_some() && runs.is_none() {
            return Keeping::Refused(plugin.no_interpreter().to_string());
        }
        let of =
            runs.map(|(interpreter, module)| (interpreter.program().to_owned(), module.profile));
        let tried_as = (needs, of);
        if let Some(Err(closed)) = runs.map(|(runs, _)| runs.refuse_closed(&plugin.folder)) {
            return Keeping::Refused(closed.to_string());
        }
        let mut tried = self.lock_tried();
        if let Some(keeping) = tried.get(&tried_as) {
            return keeping.clone();
        }
        let needs = &tried_as.0;
        let mut spec = ChildSpec::new("isolation", Vec::new());
        spec.program.clone_from(&self.children.program);
        if let Some((interpreter, module)) = runs {
            interpreter.confine(&mut spec, module);
        }
        spec.confinement.needs = needs.iter().cloned().collect();
        spec.loads = false;
        let keeping = match Child::start(spec) {
            Ok(child) => Keeping::Confined(child.isolation().to_string()),
            Err(error) => Keeping::Refused(error.to_string()),
        };
        tried.insert(tried_as, keeping.clone());
        keeping
    }

    #[cfg(not(target_os = "linux"))]
    fn confined(&self, plugin: &Plugin) -> Keeping {
        let why = "plugins are isolated only on Linux";
        Keeping::Refused(format!("{why}; `--trust {}` runs it here", plugin.id()))
    }
}
