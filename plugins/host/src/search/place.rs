//! Where plugins are looked for.

use std::ffi::{OsStr, OsString};
use std::fmt;
use std::path::{Path, PathBuf};

use serde::Serialize;

/// Who named a folder; the first of these is looked at first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Place {
    /// The command line: `--plugin-dir`.
    Given,
    /// The folder `plugins` beside the scene.
    Project,
    /// The variable `TACEVA_PLUGIN_PATH`.
    Environment,
    /// What this user has installed.
    User,
    /// What is installed for everybody.
    System,
    /// An environment of Python.
    Python,
}

impl Place {
    /// Every place, in the order in which they are looked at.
    pub const ALL: [Place; 6] = [
        Place::Given,
        Place::Project,
        Place::Environment,
        Place::User,
        Place::System,
        Place::Python,
    ];

    /// The word for it.
    pub const fn name(self) -> &'static str {
        match self {
            Place::Given => "given",
            Place::Project => "project",
            Place::Environment => "environment",
            Place::User => "user",
            Place::System => "system",
            Place::Python => "python",
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The folders to look in: never the current one, unless somebody names it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SearchPath {
    pub(super) folders: Vec<(Place, PathBuf)>,
}

/// The folder in a place that holds plugins.
const PLUGINS: &str = "taceva/plugins";

impl SearchPath {
    /// No folder.
    pub fn empty() -> SearchPath {
        SearchPath::default()
    }

    /// The folders of this process: its environment, its user and the system.
    pub fn of_process() -> SearchPath {
        let variable = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
        let home = variable("HOME").map(PathBuf::from);
        let user = variable("XDG_DATA_HOME")
            .map(PathBuf::from)
            .or_else(|| Some(home?.join(".local/share")));
        let mut path = SearchPath::empty();
        if let Some(listed) = variable("TACEVA_PLUGIN_PATH") {
            path = path.environment(&listed);
        }
        if let Some(user) = user {
            path.folders.push((Place::User, user.join(PLUGINS)));
        }
        for system in ["/usr/local/lib", "/usr/lib"] {
            let folder = Path::new(system).join(PLUGINS);
            path.folders.push((Place::System, folder));
        }
        path
    }

    /// The folders that a variable lists, as `PATH` lists its own.
    #[must_use]
    pub fn environment(self, listed: &OsStr) -> SearchPath {
        let listed: Vec<PathBuf> = std::env::split_paths(listed).collect();
        self.with(Place::Environment, listed)
    }

    /// Also `folders` that somebody named.
    #[must_use]
    pub fn given(self, folders: impl IntoIterator<Item = PathBuf>) -> SearchPath {
        self.with(Place::Given, folders)
    }

    /// Also the folder `plugins` beside a scene that lies in `folder`.
    #[must_use]
    pub fn project(self, folder: &Path) -> SearchPath {
        self.with(Place::Project, [folder.join("plugins")])
    }

    fn with(mut self, place: Place, folders: impl IntoIterator<Item = PathBuf>) -> SearchPath {
        let named = folders.into_iter().map(|folder| (place, folder));
        self.folders.extend(named);
        // Stable: folders of one place stay in the order in which they were named.
        self.folders.sort_by_key(|(place, _)| *place);
        self
    }

    /// The folders, in the order in which they are looked at.
    pub fn folders(&self) -> impl Iterator<Item = (Place, &Path)> {
        (self.folders.iter()).map(|(place, folder)| (*place, folder.as_path()))
    }
}

/// The file of this user's settings, where one can be: `$XDG_CONFIG_HOME/taceva/config.toml` or `~/.config/taceva/config.toml`.
pub fn user_config_file() -> Option<PathBuf> {
    let variable = |name: &str| -> Option<OsString> {
        std::env::var_os(name).filter(|value| !value.is_empty())
    };
    let folder = variable("XDG_CONFIG_HOME")
        .map(PathBuf::from)
        .or_else(|| Some(PathBuf::from(variable("HOME")?).join(".config")))?;
    folder
        .is_absolute()
        .then(|| folder.join("taceva/config.toml"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_named_first_is_what_somebody_typed() {
        let path = SearchPath::empty()
            .environment(OsStr::new("/e1:/e2"))
            .project(Path::new("/scenes"))
            .given([PathBuf::from("/g")]);
        let folders: Vec<(Place, &Path)> = path.folders().collect();
        assert_eq!(
            folders,
            [
                (Place::Given, Path::new("/g")),
                (Place::Project, Path::new("/scenes/plugins")),
                (Place::Environment, Path::new("/e1")),
                (Place::Environment, Path::new("/e2")),
            ]
        );
    }
}
