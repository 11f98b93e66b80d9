//! Presets: built-in maps of common layouts, fitted to the folder.

mod draft_map;
mod fit;
mod lines;

use std::path::Path;

use crate::error::ImportError;
use crate::import::ImportMap;
use crate::source_folder::SourceFolder;

use crate::layouts::{Fit, Preset};

impl Preset {
    /// Map for the folder at `source`, as `import --preset` uses it. The comments of the map state the verified facts. The text may be saved and adapted.
    ///
    /// # Errors
    /// [`ImportError::Dataset`] naming the expected file if the folder has a different layout; errors of reading the first table.
    ///
    /// ```
    /// use taceva_import::Preset;
    ///
    /// # let folder = tempfile::tempdir()?;
    /// # std::fs::write(folder.path().join("targets.csv"), "sensor_image,pose_x,pose_y\na.png,1,2\n")?;
    /// # std::fs::create_dir(folder.path().join("images"))?;
    /// let preset = Preset::from_name("bristol").ok_or("a preset")?;
    /// let text = preset.text(folder.path())?;
    /// assert!(text.contains(r#"Px = { from = "pose_x", unit = "mm" }"#));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn text(self, source: &Path) -> Result<String, ImportError> {
        let folder = SourceFolder::open(source)?;
        self.check(&folder)?;
        match self.facts().fit {
            Some(Fit::Draft) => draft_map::text(self.facts().map, source),
            _ => fit::text(self.facts(), &folder),
        }
    }

    /// Parsed map for the folder at `source`, adapted to its columns, image folder and colours.
    ///
    /// # Errors
    /// Errors of [`text`](Preset::text).
    pub fn map(self, source: &Path) -> Result<ImportMap, ImportError> {
        let name = format!("the map of preset {}", self.name());
        ImportMap::parse(name.as_ref(), &self.text(source)?)
    }
}
