//! Notes of a draft on files that the draft does not use.

use super::survey::FileGroup;
use super::tables::SeenTable;
use crate::import::converter;
use taceva_dataset::internal::first_names;

/// Note on files of an unreadable form, with a command that converts them; `None` if the form has no converter.
pub(super) fn refused_form(group: &FileGroup) -> Option<String> {
    let remedy = converter(group.first())?;
    Some(format!("{} is not read: {remedy}", group.first()))
}

/// Maximum number of files that a note names.
const NAMED: usize = 8;

/// Note that lists the unread files; `None` without such files. Import maps are not mentioned.
pub(super) fn unread(groups: &[&FileGroup]) -> Option<String> {
    let others = groups.iter().filter(|group| group.ending != "toml");
    let names: Vec<&str> = others.map(|group| group.pattern()).collect();
    (!names.is_empty()).then(|| format!("Not read: {}", first_names(&names, NAMED)))
}

/// Advice for clips without a table of labels.
pub(super) fn bare_clips(clips: &FileGroup) -> String {
    let clip = clips.first();
    format!(
        "{clip} has frames, but no file here has labels: write a table beside it, such as labels.csv with the columns `frame` (from 0) and `Fz`, and draft again (`video = {clip:?}`, `index = \"frame\"`). Or write its frames as pictures, which need no table: `ffmpeg -i {clip} %06d.png`"
    )
}

/// Note that a preset matches the folder.
pub(super) fn known_layout(preset: &str) -> String {
    format!(
        "This looks like the layout of `--preset {preset}`, which needs no map: `taceva import --presets` lists the content that is read."
    )
}

/// Note on an array beside pictures whose number of rows differs from the number of pictures.
pub(super) fn array_beside_pictures(table: &SeenTable<'_>) -> String {
    let reason = match table.group.ending.as_str() {
        "txt" => {
            "its numbers have no names, and it has another number of rows than there are pictures"
        }
        _ => "if it is the picture without contact, save it as PNG and name it as `reference`",
    };
    format!(
        "{} ({}) does not describe the pictures: {reason}.",
        table.group.pattern(),
        taceva_core::counted(table.rows, "row")
    )
}
