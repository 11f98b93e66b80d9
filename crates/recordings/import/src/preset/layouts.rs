//! The layouts that are known by name: what lies where, what of it is read, what it leaves open.

pub(super) mod facts;

use std::path::Path;

use crate::import::converter;
use crate::import::source::has_match;
use crate::source_folder::SourceFolder;
use taceva_dataset::DatasetError;
use taceva_dataset::internal::shown;
use taceva_dataset::internal::shown_path;

/// A layout whose map is built in.
///
/// ```
/// use taceva_import::Preset;
///
/// assert_eq!(Preset::from_name("bristol"), Some(Preset::Bristol));
/// for preset in Preset::ALL {
///     println!("{}: {}", preset.name(), preset.layout());
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Preset {
    /// `targets.csv` beside `sensor_images/` or `images/`, of either generation of columns.
    Bristol,
    /// `annotations/probe_data.csv`, `probe_images/` and `blank_images/`.
    Py3dcal,
    /// Pictures in `image/`, wrenches in `wrench/`, each in a file of its own.
    NineDTact,
    /// One JSON file for each session below `GEL/LED/data/`, pictures below `GEL/LED/images/`.
    AllSight,
    /// Pickles of encoded pictures and one of presses, in one folder for each batch.
    SparshForce,
    /// `synced_data.npy` with a dictionary in it, and the pictures it names.
    YcbSlide,
    /// `all_data_direction.json` with lists of picture and force.
    Touchd,
    /// `contact_indoor.csv` and `data_indoor/`.
    Tacquad,
    /// One folder for each grasp, with `gelsight/`, `f_t.csv` and `stages.csv`.
    PoseIt,
    /// `tactile1/`, `tactile2/` and `force/` for each trial.
    ToolForce,
    /// HDF5 with `/tactile/left_gsmini/` or `/tactile/left_tactile/`.
    UniVtac,
    /// LeRobot, versions 2.1 and 3.0.
    LerobotV3,
    /// Pictures of a live view.
    GelsightLive,
    /// Shards of WebDataset.
    Fota,
    /// An MCAP recording of ROS 2.
    Rosbag,
    /// A store of zarr with `data` and `meta/episode_ends`.
    DiffusionZarr,
}

impl Preset {
    /// Every preset.
    pub const ALL: [Preset; 16] = [
        Preset::Bristol,
        Preset::Py3dcal,
        Preset::NineDTact,
        Preset::AllSight,
        Preset::SparshForce,
        Preset::YcbSlide,
        Preset::Touchd,
        Preset::Tacquad,
        Preset::PoseIt,
        Preset::ToolForce,
        Preset::UniVtac,
        Preset::LerobotV3,
        Preset::GelsightLive,
        Preset::Fota,
        Preset::Rosbag,
        Preset::DiffusionZarr,
    ];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        self.facts().name
    }

    /// What lies where in the folder.
    ///
    /// ```
    /// assert!(taceva_import::Preset::Py3dcal.layout().contains("annotations/probe_data.csv"));
    /// ```
    pub const fn layout(self) -> &'static str {
        self.facts().layout
    }

    /// What of it is read, with the units that are taken for it.
    ///
    /// ```
    /// assert!(taceva_import::Preset::ToolForce.reads().contains("Fz"));
    /// ```
    pub const fn reads(self) -> &'static str {
        self.facts().reads
    }

    /// What the layout does not say, or what of it is not read.
    ///
    /// ```
    /// assert!(taceva_import::Preset::GelsightLive.leaves_open().contains("force"));
    /// ```
    pub const fn leaves_open(self) -> &'static str {
        self.facts().leaves_open
    }

    /// The preset called `name`.
    pub fn from_name(name: &str) -> Option<Preset> {
        Preset::ALL.into_iter().find(|preset| preset.name() == name)
    }

    /// The preset whose layout the folder at `source` has.
    pub(crate) fn recognised(source: &Path) -> Option<Preset> {
        let is_there = |pattern: &str| has_match(source, pattern);
        Preset::ALL.into_iter().find(|preset| {
            let facts = preset.facts();
            let mut needs = facts.needs.iter();
            needs.all(|need| need.any_of.iter().any(|pattern| is_there(pattern)))
                && facts.mark.is_none_or(is_there)
        })
    }

    /// Whether everything that the layout needs is in the folder.
    ///
    /// # Errors
    /// [`DatasetError::Path`] naming what was expected where.
    pub(super) fn check(self, folder: &SourceFolder) -> Result<(), DatasetError> {
        let facts = self.facts();
        let is_there = |pattern: &&str| has_match(folder.path(), pattern);
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
        Err(DatasetError::Path {
            place: None,
            written: missing.any_of.join("` or `"),
            problem: format!(
                "preset {} expects {} there, and {} has none; the layout is {}{another}",
                facts.name,
                missing.what,
                shown_path(folder.path()),
                facts.layout
            ),
        })
    }
}

/// A file of a form that is not read, and the command that converts it.
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
    fn names_and_presets_are_one_to_one() {
        for preset in Preset::ALL {
            assert_eq!(Preset::from_name(preset.name()), Some(preset));
        }
        assert_eq!(Preset::from_name("no such"), None);
    }

    #[test]
    fn an_empty_folder_is_none_of_them_and_every_message_names_what_was_expected() {
        let empty = tempfile::tempdir().expect("a folder");
        let folder = SourceFolder::open(empty.path()).expect("opens");
        assert_eq!(Preset::recognised(empty.path()), None);
        for preset in Preset::ALL {
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
        assert_eq!(Preset::recognised(lab.path()), Some(Preset::Bristol));
        let message = Preset::Rosbag
            .check(&folder)
            .expect_err("no MCAP")
            .to_string();
        assert!(
            message.contains("looks like `--preset bristol`"),
            "{message}"
        );
        let bags = tempfile::tempdir().expect("a folder");
        std::fs::write(bags.path().join("run_0.db3"), "x").expect("written");
        let folder = SourceFolder::open(bags.path()).expect("opens");
        let message = Preset::Rosbag
            .check(&folder)
            .expect_err("no MCAP")
            .to_string();
        let command = "`mcap convert run_0.db3 run_0.mcap`";
        assert!(message.contains(command), "{message}");
    }
}
