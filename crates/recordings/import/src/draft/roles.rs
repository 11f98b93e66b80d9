//! What the columns of a table seem to be, by their names and their first cells.

mod doubts;
mod times;

use crate::csv_table::number;
use crate::foreign::cell_list;
use doubts::doubt_of;
use times::time;

pub(super) use doubts::doubt;

/// What a column seems to be.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Role {
    /// Channels, each with where it is in the cell: nothing behind the name, or `[2]`.
    Channels(Vec<(&'static str, String)>),
    /// A time in such a unit, since 1970 or not; `"?"` where nothing says which.
    Time {
        unit: &'static str,
        is_unix: bool,
        /// Why the unit may be another.
        guess: Option<&'static str>,
    },
    /// A text with few values: what was touched, a session.
    Attribute,
    /// Whole numbers that count frames.
    Index,
    /// Numbers that no name explains.
    Number,
    Other,
}

const FORCES: [&str; 3] = ["Fx", "Fy", "Fz"];
const TORQUES: [&str; 3] = ["Tx", "Ty", "Tz"];
const PLACES: [&str; 3] = ["Px", "Py", "Pz"];

/// What says what a column is: its name, or that of its file where columns are called `value`.
fn explained<'n>(name: &'n str, about: &'n str) -> &'n str {
    match name {
        "value" => about,
        name => name,
    }
}

/// What the column called `name` is; `about` is what its file is called, which explains columns called `value`.
pub(super) fn role(name: &str, about: &str, cells: &[String]) -> Role {
    let words = words(explained(name, about));
    let filled: Vec<&str> = cells
        .iter()
        .map(String::as_str)
        .filter(|cell| !cell.is_empty())
        .collect();
    let numbers: Option<Vec<f64>> = filled
        .iter()
        .map(|cell| number::number(cell).ok().flatten())
        .collect();
    match numbers.filter(|numbers| !numbers.is_empty()) {
        // The index of pandas, which has no name.
        Some(numbers) if name.is_empty() && are_counts(&numbers) => Role::Other,
        Some(numbers) => of_numbers(&words, &numbers),
        None => match width(&filled) {
            Some(width) => match several(&words, width) {
                Some(channels) => Role::Channels(channels),
                None => Role::Other,
            },
            None => of_texts(&filled),
        },
    }
}

/// What a column is whose numbers have names of their own: the channels that those names are, each once; an action is commanded, not measured,
/// and names that say as much are none.
pub(super) fn of_named(column: &str, names: &[String]) -> Option<Role> {
    let is_known = !names.is_empty() && names.iter().any(|name| !name.is_empty());
    if !is_known || column.starts_with("action") {
        return None;
    }
    let mut found: Vec<(&'static str, String)> = Vec::new();
    for (at, name) in names.iter().enumerate() {
        let words = words(name);
        if let Some(channel) = channel(&words)
            && doubt_of(&words).is_none()
            && found.iter().all(|(known, _)| *known != channel)
        {
            found.push((channel, format!("[{at}]")));
        }
    }
    Some(match found.is_empty() {
        true => Role::Other,
        false => Role::Channels(found),
    })
}

fn of_numbers(words: &[String], numbers: &[f64]) -> Role {
    let has = |known: &[&str]| words.iter().any(|word| known.contains(&word.as_str()));
    let is_rising =
        numbers.windows(2).all(|pair| pair[0] <= pair[1]) && numbers.first() < numbers.last();
    let is_named_time = has(&["t", "time", "stamp", "timestamp", "ts"]) && !has(&["x", "y", "z"]);
    if is_named_time || (words.is_empty() && is_rising && !are_counts(numbers)) {
        return time(words, numbers);
    }
    if let Some(channel) = channel(words) {
        return Role::Channels(vec![(channel, String::new())]);
    }
    if has(&["episode", "session", "trial"]) && are_counts(numbers) {
        return Role::Attribute;
    }
    if has(&["frame", "index", "idx", "image", "img"]) && are_counts(numbers) {
        return Role::Index;
    }
    Role::Number
}

fn are_counts(numbers: &[f64]) -> bool {
    numbers
        .iter()
        .all(|number| number.fract() == 0.0 && *number >= 0.0)
}

fn of_texts(cells: &[&str]) -> Role {
    let mut known: Vec<&str> = cells.to_vec();
    known.sort_unstable();
    known.dedup();
    let is_short = known
        .iter()
        .all(|text| text.len() <= 40 && !text.contains(['[', '/', '{']));
    match is_short && !known.is_empty() && known.len() * 2 <= cells.len().max(2) {
        true => Role::Attribute,
        false => Role::Other,
    }
}

/// The channel that a single number is by the words of its name.
pub(super) fn channel(words: &[String]) -> Option<&'static str> {
    let mut kind = None;
    for word in words {
        match word.as_str() {
            "force" | "forces" | "f" | "load" | "loadcell" => kind = Some(FORCES),
            "torque" | "torques" | "moment" | "tau" => kind = Some(TORQUES),
            "pos" | "position" | "pose" | "tcp" | "p" | "translation" => {
                kind = kind.or(Some(PLACES));
            }
            "x" | "y" | "z" => {
                let axis = usize::from(word.as_bytes()[0] - b'x');
                return Some(kind.unwrap_or(PLACES)[axis]);
            }
            _ => {
                let (letter, axis) = word.split_at_checked(1)?;
                let axis = ["x", "y", "z"].iter().position(|known| *known == axis);
                let kind = match (letter, axis) {
                    ("f", Some(_)) => Some(FORCES),
                    ("t" | "m", Some(_)) => Some(TORQUES),
                    ("p", Some(_)) => Some(PLACES),
                    _ => None,
                };
                if let (Some(kind), Some(axis)) = (kind, axis) {
                    return Some(kind[axis]);
                }
            }
        }
    }
    // A force without an axis is what presses.
    (kind == Some(FORCES)).then_some("Fz")
}

/// The channels that a cell with so many numbers holds.
fn several(words: &[String], width: usize) -> Option<Vec<(&'static str, String)>> {
    let has = |known: &[&str]| words.iter().any(|word| known.contains(&word.as_str()));
    let at = |names: &[&'static str], first: usize| {
        let numbered = names.iter().enumerate();
        numbered
            .map(|(position, name)| (*name, format!("[{}]", first + position)))
            .collect::<Vec<_>>()
    };
    let is_force = has(&[
        "ft", "force", "forces", "wrench", "f", "fts", "state", "loadcell",
    ]);
    match width {
        6 if is_force => Some([at(&FORCES, 0), at(&TORQUES, 3)].concat()),
        3 if is_force => Some(at(&FORCES, 0)),
        3 if has(&["torque", "torques", "moment"]) => Some(at(&TORQUES, 0)),
        3 | 6 | 7 if has(&["pos", "position", "pose", "xyz", "tcp", "translation"]) => {
            Some(at(&PLACES, 0))
        }
        _ => None,
    }
}

/// How many numbers each of the cells packs, if all pack as many.
fn width(cells: &[&str]) -> Option<usize> {
    let count = |cell: &str| {
        let is_number = |at: usize| {
            cell_list::item(cell, &[at])
                .is_ok_and(|item| number::number(item).is_ok_and(|found| found.is_some()))
        };
        (0..=64)
            .find(|at| !is_number(*at))
            .filter(|count| *count > 1 && cell_list::item(cell, &[*count]).is_err())
    };
    let first = count(cells.first()?)?;
    cells
        .iter()
        .all(|cell| count(cell) == Some(first))
        .then_some(first)
}

/// The words of a name, in lower case: `wrench.force.x`, `Fx_mN`, `ForceX`.
pub(super) fn words(name: &str) -> Vec<String> {
    let mut words: Vec<String> = vec![String::new()];
    let mut before = ' ';
    for letter in name.chars() {
        let is_new = letter.is_ascii_uppercase() && before.is_ascii_lowercase();
        if is_new || !letter.is_ascii_alphabetic() {
            words.push(String::new());
        }
        if letter.is_ascii_alphabetic()
            && let Some(last) = words.last_mut()
        {
            last.push(letter.to_ascii_lowercase());
        }
        before = letter;
    }
    words.retain(|word| !word.is_empty());
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(texts: &[&str]) -> Vec<String> {
        texts.iter().map(|text| (*text).to_owned()).collect()
    }

    #[test]
    fn channels_are_known_by_the_words_of_a_name() {
        for (name, expected) in [
            ("Fx", Some("Fx")),
            ("Fz_mN", Some("Fz")),
            ("force_y", Some("Fy")),
            ("ForceX", Some("Fx")),
            ("ft.wrench.torque.z", Some("Tz")),
            ("pose.x", Some("Px")),
            ("x_m", Some("Px")),
            ("load_g", Some("Fz")),
            ("Mx", Some("Tx")),
            ("temperature", None),
            ("note", None),
        ] {
            assert_eq!(channel(&words(name)), expected, "{name}");
        }
    }

    #[test]
    fn numbers_with_names_of_their_own_are_the_channels_that_those_name() {
        let names = ["gripper", "Fz", "Fx", "joint_1.pos"].map(str::to_owned);
        let found = of_named("observation.state", &names);
        let expected = vec![("Fz", "[1]".to_owned()), ("Fx", "[2]".to_owned())];
        assert_eq!(found, Some(Role::Channels(expected)));
        let joints = ["joint_1", "joint_2"].map(str::to_owned);
        assert_eq!(of_named("observation.state", &joints), Some(Role::Other));
        assert_eq!(of_named("action", &names), None);
        assert_eq!(of_named("observation.state", &[]), None);
    }

    #[test]
    fn lists_times_texts_and_counters_are_distinguished() {
        let of = |name, texts: &[&str]| role(name, "ft", &cells(texts));
        let Role::Channels(channels) = of("value", &["[1, 2, 3, 4, 5, 6]", "1 2 3 4 5 6"]) else {
            panic!("forces and torques");
        };
        assert_eq!(channels[5], ("Tz", "[5]".to_owned()));
        assert_eq!(
            of("stamp", &["1700000000000000000", "1700000000100000000"]),
            Role::Time {
                unit: "ns",
                is_unix: true,
                guess: None
            }
        );
        assert_eq!(
            of("t_ms", &["0", "33"]),
            Role::Time {
                unit: "ms",
                is_unix: false,
                guess: None
            }
        );
        assert_eq!(
            of("object", &["ball", "ball", "cube", "cube"]),
            Role::Attribute
        );
        assert_eq!(of("id", &["a", "b", "c", "d"]), Role::Other);
        assert_eq!(of("frame", &["3", "1"]), Role::Index);
        assert_eq!(of("gain", &["3", "1"]), Role::Number);
        assert_eq!(of("pose", &["[[1, 2], [3, 4]]"]), Role::Other);
    }

    #[test]
    fn a_column_without_a_name_that_counts_is_the_index_of_pandas() {
        assert_eq!(role("", "labels", &cells(&["0", "1", "2"])), Role::Other);
    }
}
