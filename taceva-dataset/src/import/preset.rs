//! Layouts that are common enough to need no map from the user.

use std::path::Path;

use super::map::{FrameMap, ImportMap};
use crate::csv_table::CsvTable;
use crate::decode::{ChannelOrder, decode};
use crate::error::DatasetError;
use crate::file::{SourceFolder, read_capped};
use crate::limits;

/// A layout whose map is built in.
///
/// ```
/// use taceva_dataset::Preset;
///
/// assert_eq!(Preset::from_name("bristol"), Some(Preset::Bristol));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Preset {
    /// `targets.csv` beside `sensor_images/` or `images/`, of either generation of columns.
    Bristol,
    /// `annotations/probe_data.csv`, `probe_images/` and `blank_images/`.
    Py3dcal,
}

impl Preset {
    /// Every preset.
    pub const ALL: [Preset; 2] = [Preset::Bristol, Preset::Py3dcal];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Preset::Bristol => "bristol",
            Preset::Py3dcal => "py3dcal",
        }
    }

    /// The preset called `name`.
    pub fn from_name(name: &str) -> Option<Preset> {
        Preset::ALL.into_iter().find(|preset| preset.name() == name)
    }

    /// Whether the folder at `source` has the table of this layout.
    pub(crate) fn is_in(self, source: &Path) -> bool {
        let table = match self {
            Preset::Bristol => "targets.csv",
            Preset::Py3dcal => "annotations/probe_data.csv",
        };
        source.join(table).is_file()
    }

    /// The map for the folder at `source`: the columns its table has, the folder its images are in, the colours they have.
    ///
    /// # Errors
    /// Those of reading the table and of the first image.
    pub fn map(self, source: &Path) -> Result<ImportMap, DatasetError> {
        let folder = SourceFolder::open(source)?;
        let mut map = match self {
            Preset::Bristol => built_in("bristol.toml", include_str!("presets/bristol.toml"))?,
            Preset::Py3dcal => built_in("py3dcal.toml", include_str!("presets/py3dcal.toml"))?,
        };
        let table = CsvTable::read(&folder.file(source, &map.table)?)?;
        if self == Preset::Bristol && table.has("pose_1") {
            map = built_in(
                "bristol-numbered.toml",
                include_str!("presets/bristol-numbered.toml"),
            )?;
        }
        keep_filled_columns(&mut map, &table)?;
        if let Some(frame) = &mut map.frame {
            fit_frames(frame, &folder)?;
        }
        Ok(map)
    }
}

fn built_in(name: &str, text: &str) -> Result<ImportMap, DatasetError> {
    ImportMap::parse(Path::new(name), text)
}

/// Leaves out the channels whose column is absent, and the forces if all of them are placeholders.
fn keep_filled_columns(map: &mut ImportMap, table: &CsvTable) -> Result<(), DatasetError> {
    let mut has_force = false;
    for name in ["Fx", "Fy", "Fz"] {
        if let Some(position) = map.channels.position(name) {
            let from = &map.columns[position].from;
            has_force |= table.has(from)
                && table
                    .numbers_with_invalid(from)?
                    .values()
                    .iter()
                    .any(|force| *force != 0.0);
        }
    }
    let kept: Vec<_> = map
        .channels
        .iter()
        .cloned()
        .zip(map.columns.drain(..))
        .filter(|(channel, column)| {
            table.has(&column.from) && (has_force || !channel.name().starts_with('F'))
        })
        .collect();
    let (channels, columns): (Vec<_>, Vec<_>) = kept.into_iter().unzip();
    map.channels = taceva_core::Channels::new(channels)
        .expect("some of distinct channels are distinct, and in the same order");
    map.columns = columns;
    Ok(())
}

fn fit_frames(frame: &mut FrameMap, folder: &SourceFolder) -> Result<(), DatasetError> {
    let exists = |relative: &str| folder.path().join(relative).exists();
    if let Some(images) = &frame.folder
        && !exists(images)
        && exists("images")
    {
        let renamed = |path: &String| path.replacen(images.as_str(), "images", 1);
        frame.reference = frame.reference.as_ref().map(renamed);
        frame.folder = Some("images".to_owned());
    }
    frame.reference = frame.reference.take().filter(|path| exists(path));
    let images = folder.path().join(frame.folder.as_deref().unwrap_or("."));
    let entries = std::fs::read_dir(&images).map_err(DatasetError::io("list", &images))?;
    let first = entries
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "png" || extension == "jpg")
        })
        .min();
    if let Some(path) = first {
        let bytes = read_capped(&path, limits::IMAGE_BYTES)?;
        if decode(&bytes, ChannelOrder::Gray).is_ok() {
            frame.channel_order = ChannelOrder::Gray;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_built_in_map_is_a_map() {
        for text in [
            include_str!("presets/bristol.toml"),
            include_str!("presets/bristol-numbered.toml"),
            include_str!("presets/py3dcal.toml"),
        ] {
            built_in("preset.toml", text).expect("a map");
        }
    }

    #[test]
    fn a_layout_is_known_by_the_table_that_its_map_reads() {
        let maps = [
            (Preset::Bristol, include_str!("presets/bristol.toml")),
            (
                Preset::Bristol,
                include_str!("presets/bristol-numbered.toml"),
            ),
            (Preset::Py3dcal, include_str!("presets/py3dcal.toml")),
        ];
        for (preset, text) in maps {
            let folder = tempfile::tempdir().expect("a folder");
            let map = built_in("preset.toml", text).expect("a map");
            let table = folder.path().join(map.table);
            assert!(!preset.is_in(folder.path()));
            std::fs::create_dir_all(table.parent().expect("inside")).expect("made");
            std::fs::write(table, "x").expect("written");
            assert!(preset.is_in(folder.path()));
        }
    }

    #[test]
    fn names_and_presets_are_one_to_one() {
        for preset in Preset::ALL {
            assert_eq!(Preset::from_name(preset.name()), Some(preset));
        }
        assert_eq!(Preset::from_name("no such"), None);
    }
}
