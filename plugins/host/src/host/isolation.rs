//! How a plugin is isolated, found out by doing it: a child that loads nothing confines itself and says what is enforced.

use std::fmt;

use super::PluginHost;
#[cfg(target_os = "linux")]
use crate::child::{Child, ChildSpec};
use crate::config::Trust;
#[cfg(target_os = "linux")]
use crate::python::PythonError;
use crate::search::Plugin;

/// How the code of a plugin would run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Keeping {
    /// In this process, because of this.
    Trusted(Trust),
    /// In a process of its own, from which nothing is kept because of this.
    Apart(Trust),
    /// In a process of its own, of which this is enforced, in words.
    Confined(String),
    /// Not at all: this machine cannot confine it, for this reason.
    Refused(String),
}

impl Keeping {
    /// Whether it would run.
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
            Keeping::Refused(why) => write!(f, "not at all: {why}"),
        }
    }
}

impl PluginHost {
    /// How `plugin` is kept from the rest of the machine when it runs. None of its code does for this.
    pub fn keeping(&self, plugin: &Plugin) -> Keeping {
        match self.config.trust(plugin) {
            Some(trust) if plugin.library().is_some() => Keeping::Trusted(trust),
            Some(trust) => Keeping::Apart(trust),
            None => self.confined(plugin),
        }
    }

    /// What is enforced upon a child with the needs of `plugin`; tried once for all that have the same.
    #[cfg(target_os = "linux")]
    fn confined(&self, plugin: &Plugin) -> Keeping {
        let needs = self.config.allowed(plugin);
        let runs = plugin.interpreter.as_ref().zip(plugin.module());
        if plugin.module().is_some() && runs.is_none() {
            return Keeping::Refused(PythonError::NoInterpreter.to_string());
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
        let why = "plugins are isolated on Linux alone";
        Keeping::Refused(format!("{why}; `--trust {}` runs it here", plugin.id()))
    }
}
