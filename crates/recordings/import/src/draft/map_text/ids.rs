//! Ids and attributes of samples, guessed from columns and parts of paths.

use super::sections::Lines;
use crate::draft::path_parts::PathParts;
use crate::draft::roles::candidate::{Candidate, Named};
use crate::draft::roles::{Role, words};
use crate::draft::tables::{SeenColumn, SeenTable};
use crate::import::whole_number;
use taceva_dataset::internal::is_attribute_name;

/// Words in the names of columns whose equal values mark rows that belong together.
const SHARED: [&str; 14] = [
    "episode", "session", "trial", "object", "video", "clip", "take", "press", "run", "repeat",
    "grasp", "sequence", "point", "location",
];

/// Words in the names of columns that identify the contact point, so that no coordinates are needed.
const POINT: [&str; 4] = ["press", "grasp", "point", "location"];

/// Commented line `point_id = "group"`, if the file has groups; each group may be a contact.
pub(super) fn group_points(main: &SeenTable<'_>) -> &'static str {
    match main.has_groups() {
        true => {
            "# point_id = \"group\"   # only if each group of the file is one contact, such as a grasp or a press, for intervals and --split by-point\n"
        }
        false => "",
    }
}

/// Column with the number of the repeat, recognised by its name.
pub(super) fn repeat_column<'t>(main: &'t SeenTable<'_>) -> Option<&'t str> {
    let is_repeat = |column: &&SeenColumn| {
        let mut filled = column.cells.iter().filter(|cell| !cell.is_empty());
        let name = column.name.trim_start_matches('@');
        name.eq_ignore_ascii_case("repeat") && filled.all(|cell| whole_number(cell).is_some())
    };
    let column = main.columns.iter().find(is_repeat)?;
    Some(column.name.as_str())
}

/// Number of different values.
fn distinct<T: Ord>(mut values: Vec<T>) -> usize {
    values.sort_unstable();
    values.dedup();
    values.len()
}

/// Column of `main` from which `channels`, the drafted lines, read `channel`; `None` if that line has a gap.
fn place_column<'t>(
    main: &'t SeenTable<'_>,
    channels: &str,
    channel: &str,
) -> Option<&'t SeenColumn> {
    main.columns.iter().find(|column| {
        let drafted = format!("{channel} = {{ from = {:?}, ", column.name);
        channels.lines().any(|line| line.starts_with(&drafted))
    })
}

/// Line `point_id` by coordinates, if most places in `main` repeat exactly. A sensor that rests and then moves has many places with only one row.
fn repeated_places(main: &SeenTable<'_>, channels: &str) -> Option<String> {
    let [x, y] = ["Px", "Py"].map(|channel| place_column(main, channels, channel));
    let (x, y) = (x?, y?);
    let places = x.cells.iter().zip(&y.cells);
    let mut places: Vec<_> = places
        .filter(|(x, y)| !x.is_empty() && !y.is_empty())
        .collect();
    places.sort_unstable();
    let rows = places.chunk_by(|one, other| one == other).map(<[_]>::len);
    let rows: Vec<usize> = rows.collect();
    let points = rows.len();
    let repeated = rows.iter().filter(|rows| **rows > 1).count();
    let seen = x.cells.len();
    let first = match seen < main.rows {
        true => "the first ",
        false => "",
    };
    (points > 1 && points * 2 <= places.len() && repeated * 2 > points).then(|| {
        format!(
            "point_id = [{:?}, {:?}]   # a guess: {first}{seen} rows have {points} places that repeat exactly, so a place names a contact \
             point, for intervals and --split by-point\n",
            x.name, y.name
        )
    })
}

/// Line `point_id` for rows of one contact point: active for episodes and for coordinates that repeat exactly, otherwise commented out.
pub(super) fn shared_points(
    main: &SeenTable<'_>,
    parts: Option<&PathParts>,
    channels: &str,
) -> String {
    let has_word = |column: &SeenColumn, known: &[&str]| {
        let words = words(&column.name);
        !matches!(column.role, Role::Channels(_))
            && words.iter().any(|word| known.contains(&word.as_str()))
    };
    let several = |column: &&SeenColumn| {
        let filled = column.cells.iter().filter(|cell| !cell.is_empty());
        let values: Vec<&String> = filled.collect();
        let filled = values.len();
        distinct(values) * 2 <= filled
    };
    let mut columns = main
        .columns
        .iter()
        .filter(|column| has_word(column, &SHARED));
    if let Some(episode) = columns
        .clone()
        .find(|column| column.name == "episode_index")
    {
        return format!(
            "point_id = {:?}   # a guess: groups the rows of an episode, for intervals and --split by-point\n",
            episode.name
        );
    }
    let named = main
        .columns
        .iter()
        .find(|column| has_word(column, &POINT) && several(column));
    if let (None, Some(places)) = (named, repeated_places(main, channels)) {
        return places;
    }
    if let Some(column) = named.or_else(|| columns.find(several)) {
        return format!(
            "# point_id = {:?}   # only if each of its values is one contact point, for intervals and --split by-point\n",
            column.name
        );
    }
    let Some(parts) = parts.filter(|_| main.rows > 1) else {
        return String::new();
    };
    let names: Vec<String> = parts
        .names
        .iter()
        .map(|(name, _)| format!("\"path.{name}\""))
        .collect();
    match names.is_empty() {
        true => String::new(),
        false => format!(
            "# point_id = [{}]   # groups the rows of a file if they share a contact or a session, for intervals and --split by-point\n",
            names.join(", ")
        ),
    }
}

/// Adds the varying parts of a path to `ids` and `attributes`. Returns the parts that may be channels.
pub(super) fn add_parts(
    parts: &PathParts,
    ids: &mut Lines,
    attributes: &mut Lines,
) -> Vec<(String, Candidate)> {
    let mut candidates = Vec::new();
    for (name, is_number) in &parts.names {
        let from = format!("path.{name}");
        let named = match parts.letters_behind(name) {
            Some(letters) => Named::new(&format!("{name} ({letters})")),
            None => Named::new(name),
        };
        match (is_number, named.candidate(String::new())) {
            (true, Some(Ok(candidate))) => candidates.push((from, candidate)),
            (true, _) if name.eq_ignore_ascii_case("unit") => {
                ids.add("unit_id", &format!("{from:?}"))
            }
            (true, _)
                if ["repeat", "rep", "trial"].contains(&name.to_ascii_lowercase().as_str()) =>
            {
                ids.add("repeat", &format!("{from:?}"))
            }
            (true, _) if name.starts_with("number") => {}
            _ => attributes.add(&attribute_name(name), &format!("{from:?}")),
        }
    }
    candidates
}

pub(super) fn attribute_name(column: &str) -> String {
    // `/object/name` becomes `object`, as `path.object` does.
    let mut parts = column
        .trim_start_matches('@')
        .rsplit(['/', '.'])
        .filter(|part| !["", "name", "id", "value", "text"].contains(part));
    let last = parts.next().unwrap_or(column);
    let name: String = last
        .chars()
        .map(|letter| {
            if letter.is_ascii_alphanumeric() {
                letter
            } else {
                '_'
            }
        })
        .collect();
    match is_attribute_name(&name) {
        true => name,
        false => format!("text_{name}"),
    }
}
