//! Drafts a map for an undescribed folder: certain lines, guesses, and gaps that only the lab can fill.

mod channels;
mod clips;
mod endings;
mod frames;
mod joins;
mod map_text;
mod notes;
mod path_parts;
mod roles;
mod survey;
mod tables;
mod views;

use std::path::Path;

use crate::error::ImportError;
use crate::foreign::is_recording;
use crate::layouts::Preset;
use crate::source_folder::SourceFolder;
use clips::OnlyClip;
use survey::FileGroup;
use tables::SeenTable;

/// Maximum number of tables read for a draft.
const TABLES: usize = 64;

/// Import map with gaps to fill in, each `"?"`, such as unstated units and ambiguous columns. An import rejects a map with gaps and names the line.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// std::fs::write(folder.path().join("labels.csv"), "Fz_N,note\n1.5,a\n2.5,b\n")?;
/// let draft = taceva_import::MapDraft::of(folder.path())?;
/// assert!(draft.text().contains(r#"Fz = { from = "Fz_N", unit = "N" }   # its name and unit"#));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MapDraft {
    text: String,
}

impl MapDraft {
    /// Examines the files in a folder: names, headers, 200 rows of each kind of table, the first picture of each array. If `path` is a file, examines that file
    /// and the pictures and clips in its folder. The map is then for that folder.
    ///
    /// # Errors
    /// [`ImportError::Dataset`] if the folder cannot be read, or contains neither a table nor a picture.
    pub fn of(path: &Path) -> Result<MapDraft, ImportError> {
        let file = path.file_name().filter(|_| path.is_file());
        let folder = match file {
            Some(_) => taceva_files::parent_of(path),
            None => path,
        };
        let source = SourceFolder::open(folder)?;
        let mut groups = survey::groups(&source)?;
        if let Some(file) = file {
            groups = survey::beside(groups, &file.to_string_lossy());
        }
        let (pictures, others): (Vec<&FileGroup>, Vec<&FileGroup>) = groups
            .iter()
            .partition(|group| endings::is_picture(&group.ending));
        let mut tables = Vec::new();
        let (mut notes, mut unread) = (Vec::new(), Vec::new());
        for group in others
            .iter()
            .filter(|group| !endings::is_clip(&group.ending))
            .take(TABLES)
        {
            if is_recording(&group.ending) {
                match SeenTable::of_messages(&source, group) {
                    Ok(topics) => tables.extend(topics),
                    Err(problem) => notes.push(format!("not read: {problem}")),
                }
                continue;
            }
            match SeenTable::read(&source, group) {
                Ok(Some(table)) => tables.push(table),
                Ok(None) => match notes::refused_form(group) {
                    Some(note) => notes.push(note),
                    None => unread.push(*group),
                },
                Err(problem) => notes.push(format!("not read: {problem}")),
            }
        }
        // A LeRobot dataset is one table made of many files.
        let lerobot = groups
            .iter()
            .find_map(|group| SeenTable::of_lerobot(&source, group));
        if let Some(lerobot) = lerobot {
            tables.clear();
            unread.clear();
            match lerobot {
                Ok(table) => tables.push(table),
                Err(problem) => notes.push(format!("not read: {problem}")),
            }
        }
        let bare = groups.iter().find(|group| endings::is_clip(&group.ending));
        let most = pictures.iter().max_by_key(|group| group.paths.len());
        let clip = clips::only(&source, &groups);
        let main = main_table(&source, &groups, clip.as_ref(), &tables);
        let array =
            main.filter(|main| most.is_some_and(|most| are_beside(&source, &groups, main, most)));
        notes.extend(array.map(notes::array_beside_pictures));
        let said: Vec<String> = notes
            .iter()
            .cloned()
            .chain(notes::unread(&unread))
            .collect();
        let text = match main.filter(|_| array.is_none()) {
            Some(main) => {
                let text = map_text::of_table(&source, &groups, main, &tables, &said);
                if let (Some(reason), true) = (main.unread.first(), is_empty(&text)) {
                    return Err(ImportError::request(
                        folder,
                        format!(
                            "{} has no picture, no taxel and no number that may be a channel: {reason}",
                            main.group.first()
                        ),
                    ));
                }
                text
            }
            None => {
                let asked = file.map(|file| file.to_string_lossy());
                // One picture beside a clip is mostly the picture without contact.
                let is_one = most.is_none_or(|group| group.paths.len() == 1);
                let clip = clips::bare(&source, &groups, asked.as_deref());
                let clip = clip.filter(|clip| notes.is_empty() && (clip.is_asked || is_one));
                match (clip, most) {
                    (Some(clip), _) => map_text::of_clip(&clip, &said),
                    (None, Some(group)) => map_text::of_files(group, &said),
                    (None, None) => {
                        let problem = match (notes.first(), bare) {
                            (Some(note), _) => {
                                format!("nothing here can be read as a table: {note}")
                            }
                            (None, Some(bare)) => notes::bare_clips(bare),
                            (None, None) => "it contains no table and no picture".to_owned(),
                        };
                        return Err(ImportError::request(folder, problem));
                    }
                }
            }
        };
        Ok(MapDraft {
            text: match known_layout(folder, &text) {
                Some(preset) => map_text::with_note(&text, &notes::known_layout(preset)),
                None => text,
            },
        })
    }

    /// Text of the map, with comments that give the reason of each line.
    pub fn text(&self) -> &str {
        &self.text
    }
}

/// True if a map has no line from which an import could read labels, pictures or taxels.
fn is_empty(map: &str) -> bool {
    const READ: [&str; 5] = [
        "[frame]",
        "[columns]",
        "[signals]",
        "[classes]",
        "[[matrix]]",
    ];
    let mut section = "";
    let mut lines = map.lines();
    !lines.any(|line| {
        if line.starts_with('[') {
            section = line;
            return false;
        }
        READ.contains(&section) && !line.is_empty() && !line.starts_with('#')
    })
}

/// Preset for the layout of the folder, if the folder has the files and columns of its map.
fn known_layout(folder: &Path, draft: &str) -> Option<&'static str> {
    let preset = Preset::recognised(folder)?;
    let fits = match preset.is_drafted() {
        true => {
            draft.contains("\n[columns]\n")
                && !draft.contains("from = \"?\"")
                && !draft.contains("cut = \"?\"")
                && draft.contains("unit = \"")
        }
        false => preset.map(folder).is_ok(),
    };
    fits.then(|| preset.name())
}

/// True if the pictures are the samples and `table` only accompanies them, as an array with a mean background does.
fn are_beside(
    folder: &SourceFolder,
    groups: &[FileGroup],
    table: &SeenTable<'_>,
    pictures: &FileGroup,
) -> bool {
    let has_pictures = frames::evidence(folder, groups, table) > 0;
    let ending = table.group.ending.as_str();
    let is_lone =
        table.is_single_array || (table.columns.len() == 1 && matches!(ending, "npz" | "mat"));
    let is_other = is_lone || (table.own_taxels().is_empty() && table.time().is_none());
    !has_pictures
        && is_other
        && stated_channels(table) == 0
        && pictures.paths.len() > 1
        && table.rows != pictures.paths.len()
}

/// Number of channels in `table`; 0 for a text of numbers without names, which may be the matrix of a camera.
fn stated_channels(table: &SeenTable<'_>) -> usize {
    match table.has_guessed_channels && table.group.ending == "txt" {
        true => 0,
        false => table.channels(),
    }
}

/// Finds the table whose rows are the samples. Prefers tables that name pictures, then tables with taxels, then tables with one row per frame of the
/// clip, then the most channels.
fn main_table<'t, 'g>(
    folder: &SourceFolder,
    groups: &[FileGroup],
    clip: Option<&OnlyClip>,
    tables: &'t [SeenTable<'g>],
) -> Option<&'t SeenTable<'g>> {
    let candidates = tables
        .iter()
        .filter(|table| !table.is_single_array || table.pictures.is_empty());
    candidates
        .filter(|table| table.rows > 0 && !table.columns.is_empty())
        .max_by_key(|table| {
            (
                frames::evidence(folder, groups, table),
                !table.is_single_array && !table.own_taxels().is_empty(),
                clip.map_or(0, |clip| clip.fit(table)),
                stated_channels(table),
                table.group.paths.len(),
                table.rows,
            )
        })
}
