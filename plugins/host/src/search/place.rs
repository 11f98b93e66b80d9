//! Search places of plugins.

use std::ffi::{OsStr, OsString};
use std::fmt;
use std::path::{Path, PathBuf};

use serde::Serialize;

/// Source of a plugin folder, in search order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Place {
    /// Command-line option `--plugin-dir`.
    Given,
    /// Folder `plugins` next to the scene.
    Project,
    /// Environment variable `TACEVA_PLUGIN_PATH`.
    Environment,
    /// Folder of this user's installed plugins.
    User,
    /// Folders of plugins installed for all users.
    System,
    /// Python environment.
    Python,
}

impl Place {
    /// All places, in search order.
    pub const ALL: [Place; 6] = [
        Place::Given,
        Place::Project,
        Place::Environment,
        Place::User,
        Place::System,
        Place::Python,
    ];

    /// Name of the place.
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

/// Folders to search. The current folder is not included unless it is named.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SearchPath {
    pub(super) folders: Vec<(Place, PathBuf)>,
}

/// Subfolder that contains plugins.
const PLUGINS: &str = "taceva/plugins";

impl SearchPath {
    /// Creates an empty search path.
    pub fn empty() -> SearchPath {
        SearchPath::default()
    }

    /// Folders of this process: `TACEVA_PLUGIN_PATH`, the user's folder and the system's folders.
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

    /// Adds the folders in `listed`, separated as in `PATH`.
    #[must_use]
    pub fn environment(self, listed: &OsStr) -> SearchPath {
        let listed: Vec<PathBuf> = std::env::split_paths(listed).collect();
        self.with(Place::Environment, listed)
    }

    /// Adds `folders` from the command line.
    #[must_use]
    pub fn given(self, folders: impl IntoIterator<Item = PathBuf>) -> SearchPath {
        self.with(Place::Given, folders)
    }

    /// Adds the folder `plugins` next to a scene in `folder`.
    #[must_use]
    pub fn project(self, folder: &Path) -> SearchPath {
        self.with(Place::Project, [folder.join("plugins")])
    }

    fn with(mut self, place: Place, folders: impl IntoIterator<Item = PathBuf>) -> SearchPath {
        let named = folders.into_iter().map(|folder| (place, folder));
        self.folders.extend(named);
        // The sort is stable, so folders of one place keep their order.
        self.folders.sort_by_key(|(place, _)| *place);
        self
    }

    /// Folders, in search order.
    pub fn folders(&self) -> impl Iterator<Item = (Place, &Path)> {
        (self.folders.iter()).map(|(place, folder)| (*place, folder.as_path()))
    }
}

/// Settings file of this user: `$XDG_CONFIG_HOME/taceva/config.toml` or `~/.config/taceva/config.toml`. `None` without an absolute folder.
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
