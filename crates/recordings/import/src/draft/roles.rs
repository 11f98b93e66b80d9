//! Guesses the role of each column from its name and first cells.

pub(super) mod candidate;
pub(super) mod exclusion;
mod instants;
mod paxini;
mod times;
mod words;

use crate::csv_table::number;
use crate::foreign::cell_list;
use candidate::{Candidate, Named, Quantity, Reason};
use exclusion::{Exclusion, is_counting};
use times::time;

pub(super) use times::{is_logged, median_step};
pub(super) use words::words;

/// Guessed role of a column.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Role {
    Channels(Vec<Candidate>),
    /// Column whose name resembles a channel name but denotes another quantity.
    Excluded(Exclusion),
    /// Time in `unit`, since 1970 or another origin; `"?"` if the unit is unknown.
    Time {
        unit: &'static str,
        is_unix: bool,
        /// Reason why the unit may be different; `None` for a certain unit.
        guess: Option<&'static str>,
    },
    /// Text with few values, such as an object or a session.
    Attribute,
    /// Whole numbers that count the frames.
    Index,
    /// Numbers whose column name does not indicate the quantity.
    Number,
    /// Several numbers in each cell, whose column name does not indicate the quantity.
    Numbers(usize),
    Other,
}

/// Minimum number of rows that count up by one in a column that is taken for a counter. For a column with the name of a channel: `COUNTED_BY_NAME`.
const COUNTED: usize = 4;
const COUNTED_BY_NAME: usize = 16;

/// Name that describes the column: its own, or the name of its file if the column is called `value`.
fn explained<'n>(name: &'n str, about: &'n str) -> &'n str {
    match name {
        "value" => about,
        name => name,
    }
}

/// Role of the column called `name`. `about` is the name of its file, which describes a column called `value`.
pub(super) fn role(name: &str, about: &str, cells: &[String]) -> Role {
    let explained = explained(name, about);
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
        // The pandas index has no name.
        Some(numbers) if is_unnamed(name) && are_counts(&numbers) => Role::Other,
        Some(numbers) => of_numbers(explained, &numbers),
        None => match width(&filled) {
            Some(width) => several(&Named::new(explained), width),
            None => instants::of_texts(&filled).unwrap_or_else(|| of_texts(&filled)),
        },
    }
}

/// True for a column without a name, such as the index that pandas writes.
fn is_unnamed(name: &str) -> bool {
    name.is_empty() || name.starts_with("Unnamed: ")
}

/// Role of a column with a name for each number in its cells.
pub(super) fn of_named(column: &str, names: &[String]) -> Option<Role> {
    let is_known = names.iter().any(|name| !words(name).is_empty());
    if !is_known {
        return None;
    }
    let mut found: Vec<Candidate> = Vec::new();
    let mut excluded = None;
    for (at, name) in names.iter().enumerate() {
        // A single number called a vector is its length.
        if let Some(word) = words(name).into_iter().find(|word| word == "vector") {
            excluded = Some(Exclusion::Word {
                word,
                said: "the length of a vector",
            });
            continue;
        }
        match Named::within(column, name).candidate(format!("[{at}]")) {
            Some(Ok(candidate)) => found.push(candidate),
            Some(Err(exclusion)) => excluded = Some(exclusion),
            None => {}
        }
    }
    Some(match (found.is_empty(), excluded) {
        (false, _) => Role::Channels(found),
        (true, Some(exclusion)) => Role::Excluded(exclusion),
        (true, None) => Role::Other,
    })
}

fn of_numbers(name: &str, numbers: &[f64]) -> Role {
    if let Some(candidate) = paxini::resultant(name) {
        return Role::Channels(vec![candidate]);
    }
    let words = &words(name);
    let has = |known: &[&str]| words.iter().any(|word| known.contains(&word.as_str()));
    let is_rising =
        numbers.windows(2).all(|pair| pair[0] <= pair[1]) && numbers.first() < numbers.last();
    let is_named_time = has(&["t", "time", "stamp", "timestamp", "ts"]) && !has(&["x", "y", "z"]);
    if is_named_time || (words.is_empty() && is_rising && !are_counts(numbers)) {
        return time(words, numbers);
    }
    match Named::new(name).candidate(String::new()) {
        Some(Ok(candidate)) => {
            let least = match candidate.reason {
                // A part of a wrench or a pose is not a counter.
                Reason::Parent => usize::MAX,
                Reason::Name | Reason::NameWithUnit => COUNTED_BY_NAME,
                _ => COUNTED,
            };
            return match candidate.channel.starts_with('P') || !is_counting(numbers, least) {
                true => Role::Channels(vec![candidate]),
                false => Role::Excluded(Exclusion::Counting),
            };
        }
        Some(Err(exclusion)) => return Role::Excluded(exclusion),
        None => {}
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

/// Role of a column called `named` with `width` numbers in each cell.
fn several(named: &Named, width: usize) -> Role {
    let words = named.quantity_of_several();
    let has = |known: &[&str]| words.iter().any(|word| known.contains(word));
    let is_force = has(&["ft", "force", "forces", "wrench", "f", "fts", "loadcell"]);
    let is_torque = has(&["torque", "torques", "moment"]);
    let is_place = has(&["pos", "position", "pose", "xyz", "tcp", "translation"]);
    let quantities: &[Quantity] = match width {
        6 if is_force => &[Quantity::Force, Quantity::Torque],
        3 if is_torque => &[Quantity::Torque],
        3 if is_force => &[Quantity::Force],
        3 | 6 | 7 if is_place => &[Quantity::Place],
        _ => return Role::Numbers(width),
    };
    if let Some(exclusion) = named.exclusion() {
        return Role::Excluded(exclusion);
    }
    let channels = quantities.iter().flat_map(|quantity| quantity.channels());
    let candidates = channels
        .enumerate()
        .map(|(at, channel)| named.as_channel(channel, format!("[{at}]"), Reason::Position));
    match candidates.collect() {
        Ok(candidates) => Role::Channels(candidates),
        Err(exclusion) => Role::Excluded(exclusion),
    }
}

/// Number of numbers in every cell, at least 2; `None` if this number varies or the cells contain no lists of numbers.
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

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(texts: &[&str]) -> Vec<String> {
        texts.iter().map(|text| (*text).to_owned()).collect()
    }

    fn channels(role: Option<Role>) -> Vec<String> {
        let Some(Role::Channels(found)) = role else {
            return Vec::new();
        };
        let text = |found: &Candidate| format!("{}{}", found.channel, found.index);
        found.iter().map(text).collect()
    }

    #[test]
    fn numbers_with_names_of_their_own_are_the_channels_that_those_name() {
        let names = ["gripper", "Fz", "Fx", "joint_1.pos"].map(str::to_owned);
        let found = channels(of_named("observation.state", &names));
        assert_eq!(found, ["Fz[1]", "Fx[2]"]);
        let joints = ["joint_1", "joint_2"].map(str::to_owned);
        assert_eq!(of_named("observation.state", &joints), Some(Role::Other));
        assert_eq!(of_named("observation.state", &[]), None);
        let commanded = of_named("action", &names);
        assert!(
            matches!(commanded, Some(Role::Excluded(_))),
            "{commanded:?}"
        );
        let axes = ["x", "y", "z"].map(str::to_owned);
        let found = channels(of_named("observation.force", &axes));
        assert_eq!(found, ["Fx[0]", "Fy[1]", "Fz[2]"]);
    }

    #[test]
    fn numbers_without_names_are_no_wrench_because_they_are_six() {
        let cells = cells(&["[1, 2, 3, 4, 5, 6]", "[2, 2, 3, 4, 5, 6]"]);
        assert_eq!(role("observation.state", "", &cells), Role::Numbers(6));
        assert_eq!(
            channels(Some(role("observation.force_torque", "", &cells))).len(),
            6
        );
    }

    #[test]
    fn a_counter_is_no_force_whatever_its_name() {
        let counts: Vec<String> = (40..70).map(|number| number.to_string()).collect();
        for name in ["force_frame", "force_z", "load", "Fz"] {
            let found = role(name, "", &counts);
            assert!(matches!(found, Role::Excluded(_)), "{name}: {found:?}");
        }
        // A few presses of whole newtons are a force if the column has the name of one.
        let few = &counts[..8];
        assert!(matches!(role("Fz", "", few), Role::Channels(_)));
        assert!(matches!(role("z", "", &counts), Role::Channels(_)));
    }

    #[test]
    fn lists_times_texts_and_counters_are_distinguished() {
        let of = |name, texts: &[&str]| role(name, "ft", &cells(texts));
        let Role::Channels(channels) = of("value", &["[1, 2, 3, 4, 5, 6]", "1 2 3 4 5 6"]) else {
            panic!("forces and torques");
        };
        assert_eq!(
            (channels[5].channel, channels[5].index.as_str()),
            ("Tz", "[5]")
        );
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
