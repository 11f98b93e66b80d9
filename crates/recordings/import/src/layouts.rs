//! Named layouts of folders: required files, data read, and facts left open.

use std::path::Path;
use std::sync::OnceLock;

use serde::Deserialize;

use crate::error::ImportError;
use crate::import::converter;
use crate::import::source::has_match;
use crate::source_folder::SourceFolder;
use taceva_dataset::internal::{shown, shown_path};

macro_rules! files {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("layouts/", $name, ".toml")))),*]
    };
}

/// Preset files by name, in the order of recognition. Each file contains the map, followed by the `[preset]` section.
const FILES: &[(&str, &str)] = files![
    "bristol",
    "py3dcal",
    "9dtact",
    "allsight",
    "sparsh-force",
    "ycb-slide",
    "touchd",
    "tacquad",
    "poseit",
    "tool-force",
    "univtac",
    "lerobot-v3",
    "gelsight-live",
    "fota",
    "rosbag",
    "diffusion-zarr",
    "touch-and-go",
    "feeling-of-success",
    "objectfolder-benchmark",
    "tactile-tracking",
    "sparsh-pose",
    "active-clothing",
];

/// Header of the preset section, which follows the map.
const SECTION: &str = "[preset]\n";

/// File or folder that a layout requires.
#[derive(Debug, Deserialize, PartialEq, Eq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Need {
    /// Alternative paths relative to the folder, with `*` for any characters within a name. The map names the first path; an import reads the path
    /// that exists.
    pub(crate) any_of: Vec<String>,
    pub(crate) what: String,
}

/// Replacements in the map for folders in which no file matches `absent`.
#[derive(Debug, Deserialize, PartialEq, Eq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Instead {
    pub(crate) absent: String,
    pub(crate) replace: Vec<[String; 2]>,
}

/// Function that adapts the map to a folder.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Fit {
    Bristol,
    DiffusionZarr,
    /// Drafts a map for the folder, with the units of the layout.
    Draft,
    Poseit,
    ToolForce,
    Touchd,
    Univtac,
}

/// Description of a layout.
#[derive(Debug, Deserialize, PartialEq, Eq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Layout {
    #[serde(skip)]
    name: &'static str,
    /// Text of the map, or only its leading comments if the map is drafted.
    #[serde(skip)]
    pub(crate) map: &'static str,
    layout: String,
    reads: String,
    leaves_open: String,
    pub(crate) needs: Vec<Need>,
    /// Pattern of a file that identifies a layout whose required files are common; `None` for a layout with rare required files.
    mark: Option<String>,
    #[serde(default)]
    pub(crate) instead: Vec<Instead>,
    pub(crate) fit: Option<Fit>,
    /// True if map lines for columns that the first table lacks are removed.
    #[serde(default)]
    pub(crate) drops_absent_columns: bool,
}

impl Layout {
    fn read(name: &'static str, file: &'static str) -> Layout {
        let (map, section) = file.split_once(SECTION).unwrap_or_default();
        let layout: Layout = toml::from_str(section)
            .unwrap_or_else(|error| unreachable!("layouts/{name}.toml is tested: {error}"));
        Layout {
            name,
            map,
            ..layout
        }
    }
}

/// Layout with a built-in map.
///
/// ```
/// use taceva_import::Preset;
///
/// assert!(Preset::from_name("bristol").is_some());
/// for preset in Preset::all() {
///     println!("{}: {}", preset.name(), preset.layout());
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Preset(&'static Layout);

impl Preset {
    /// All presets, in recognition order.
    pub fn all() -> impl Iterator<Item = Preset> {
        static LAYOUTS: OnceLock<Vec<Layout>> = OnceLock::new();
        let layouts = LAYOUTS.get_or_init(|| {
            let files = FILES.iter();
            files.map(|(name, file)| Layout::read(name, file)).collect()
        });
        layouts.iter().map(Preset)
    }

    /// True if the map of the preset is a draft of the folder.
    pub(crate) fn is_drafted(self) -> bool {
        self.facts().fit == Some(Fit::Draft)
    }

    pub(crate) fn facts(self) -> &'static Layout {
        self.0
    }

    /// Name of the preset on the command line.
    pub fn name(self) -> &'static str {
        self.0.name
    }

    /// Files of the layout and their places in the folder.
    ///
    /// ```
    /// assert!(taceva_import::Preset::from_name("py3dcal").is_some_and(|preset| preset.layout().contains("annotations/probe_data.csv")));
    /// ```
    pub fn layout(self) -> &'static str {
        &self.0.layout
    }

    /// Data that is read, with the assumed units.
    ///
    /// ```
    /// assert!(taceva_import::Preset::from_name("tool-force").is_some_and(|preset| preset.reads().contains("Fz")));
    /// ```
    pub fn reads(self) -> &'static str {
        &self.0.reads
    }

    /// Facts that the layout does not determine, and data that is not read.
    ///
    /// ```
    /// assert!(taceva_import::Preset::from_name("gelsight-live").is_some_and(|preset| preset.leaves_open().contains("force")));
    /// ```
    pub fn leaves_open(self) -> &'static str {
        &self.0.leaves_open
    }

    /// Preset called `name`; `None` for an unknown name.
    pub fn from_name(name: &str) -> Option<Preset> {
        Preset::all().find(|preset| preset.name() == name)
    }

    /// Preset whose layout matches the folder at `source`; `None` without a match.
    pub(crate) fn recognised(source: &Path) -> Option<Preset> {
        let is_there = |pattern: &str| has_match(source, pattern);
        Preset::all().find(|preset| {
            let facts = preset.facts();
            let mut needs = facts.needs.iter();
            needs.all(|need| need.any_of.iter().any(|pattern| is_there(pattern)))
                && facts.mark.as_deref().is_none_or(is_there)
        })
    }

    /// Checks that the folder has all files and folders that the layout requires.
    ///
    /// # Errors
    /// [`ImportError::Dataset`] naming the missing file or folder and its place.
    pub(crate) fn check(self, folder: &SourceFolder) -> Result<(), ImportError> {
        let facts = self.facts();
        let is_there = |pattern: &String| has_match(folder.path(), pattern);
        let mut needs = facts.needs.iter();
        let Some(missing) = needs.find(|need| !need.any_of.iter().any(is_there)) else {
            return Ok(());
        };
        let another = Preset::recognised(folder.path());
        let another = match (another, unread(folder)) {
            (Some(preset), _) => format!("; the folder looks like `--preset {}`", preset.name()),
            (None, Some(remedy)) => format!("; {remedy}"),
            (None, None) => String::new(),
        };
        Err(ImportError::path(
            &missing.any_of.join("` or `"),
            format!(
                "preset {} expects {} at this path, but {} has none; the layout is {}{another}",
                facts.name,
                missing.what,
                shown_path(folder.path()),
                facts.layout
            ),
        ))
    }
}

/// Message that a file has an unsupported format, with the command that converts it; `None` if the folder has no such file.
fn unread(folder: &SourceFolder) -> Option<String> {
    let entries = std::fs::read_dir(folder.path()).ok()?.flatten();
    let mut names: Vec<String> = entries
        .filter_map(|entry| entry.file_name().into_string().ok())
        .collect();
    names.sort_unstable();
    names.into_iter().find_map(|name| {
        let remedy = converter(&name)?;
        Some(format!("{} is not read: {remedy}", shown(&name)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_says_what_its_preset_is_and_names_are_one_to_one() {
        assert!(FILES.iter().all(|(_, file)| file.contains(SECTION)));
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/layouts");
        let files = std::fs::read_dir(folder).expect("listed").flatten();
        // The older columns of Bristol have their own map and are not a preset.
        assert_eq!(files.count(), FILES.len() + 1);
        for preset in Preset::all() {
            assert_eq!(Preset::from_name(preset.name()), Some(preset));
        }
        assert_eq!(Preset::from_name("no such"), None);
    }

    #[test]
    fn an_empty_folder_is_none_of_them_and_every_message_names_what_was_expected() {
        let empty = tempfile::tempdir().expect("a folder");
        let folder = SourceFolder::open(empty.path()).expect("opens");
        assert_eq!(Preset::recognised(empty.path()), None);
        for preset in Preset::all() {
            let message = preset.check(&folder).expect_err("empty").to_string();
            let expected = format!("preset {} expects", preset.name());
            assert!(message.contains(&expected), "{message}");
        }
    }

    #[test]
    fn a_folder_of_another_layout_is_named() {
        let lab = tempfile::tempdir().expect("a folder");
        std::fs::write(lab.path().join("targets.csv"), "x").expect("written");
        let folder = SourceFolder::open(lab.path()).expect("opens");
        assert_eq!(Preset::recognised(lab.path()), Preset::from_name("bristol"));
        let message = Preset::from_name("rosbag")
            .expect("a preset")
            .check(&folder)
            .expect_err("no MCAP")
            .to_string();
        assert!(
            message.contains("looks like `--preset bristol`"),
            "{message}"
        );
        let bags = tempfile::tempdir().expect("a folder");
        std::fs::write(bags.path().join("run_0.mcap.zstd"), "x").expect("written");
        let folder = SourceFolder::open(bags.path()).expect("opens");
        let message = Preset::from_name("rosbag")
            .expect("a preset")
            .check(&folder)
            .expect_err("no MCAP")
            .to_string();
        let command = "`zstd -d run_0.mcap.zstd -o run_0.mcap`";
        assert!(message.contains(command), "{message}");
    }
}
