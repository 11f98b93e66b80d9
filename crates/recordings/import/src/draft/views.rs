//! Finds views of a sample: columns, folders and files whose names differ in a finger, an eye or a number.

use super::roles::words;

/// Words that distinguish fingers, eyes and cameras of one sensor or gripper.
const SIDES: [&str; 26] = [
    "left", "right", "l", "r", "top", "bottom", "upper", "lower", "up", "down", "front", "back",
    "inner", "outer", "first", "second", "thumb", "index", "middle", "ring", "little", "pinky",
    "a", "b", "one", "two",
];

/// Name that differs from others only in its side.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Sided {
    /// Index of the name in the list of compared names.
    pub(super) at: usize,
    /// Name of the view.
    pub(super) view: String,
}

/// Word or number of a name.
struct Stretch<'a> {
    text: &'a str,
    /// Offset in the name, bytes.
    start: usize,
}

/// Finds the names that differ only in one side or number, in the order of `names`; empty for fewer than two.
pub(super) fn sided(names: &[&str]) -> Vec<Sided> {
    let mut groups: Vec<(String, Vec<Sided>)> = Vec::new();
    for (at, name) in names.iter().enumerate() {
        for (stem, view) in sides_of(name) {
            let found = Sided { at, view };
            match groups.iter_mut().find(|(known, _)| *known == stem) {
                Some((_, group)) if group.iter().all(|own| own.view != found.view) => {
                    group.push(found);
                }
                Some(_) => {}
                None => groups.push((stem, vec![found])),
            }
        }
    }
    groups.retain(|(_, group)| group.len() > 1);
    // On a tie the first group wins: it differs in an earlier word.
    let most = groups.iter().map(|(_, group)| group.len()).max();
    let largest = groups
        .into_iter()
        .find(|(_, group)| Some(group.len()) == most);
    largest.map(|(_, group)| group).unwrap_or_default()
}

/// Views of a LeRobot dataset, named by the last part of the feature names; empty if fewer than two features differ in this part.
pub(super) fn features<'n>(names: impl Iterator<Item = (usize, &'n str)>) -> Vec<Sided> {
    let mut found: Vec<Sided> = Vec::new();
    for (at, name) in names {
        let last = name.rsplit(['.', '/']).next().unwrap_or(name);
        let letters = last.chars().map(|letter| match letter {
            letter if letter.is_ascii_alphanumeric() => letter,
            _ => '_',
        });
        let view: String = letters.collect();
        let is_name = view.starts_with(|letter: char| letter.is_ascii_alphabetic());
        if is_name && found.iter().all(|known| known.view != view) {
            found.push(Sided { at, view });
        }
    }
    match found.len() {
        1 => Vec::new(),
        _ => found,
    }
}

/// For each possible side or number in `name`: the name without this part, and the name of the view.
fn sides_of(name: &str) -> Vec<(String, String)> {
    let stretches = stretches(name);
    let mut sides = Vec::new();
    for (position, stretch) in stretches.iter().enumerate() {
        let word = stretch.text.to_ascii_lowercase();
        let is_number = word.bytes().all(|byte| byte.is_ascii_digit());
        if !is_number && !SIDES.contains(&word.as_str()) {
            continue;
        }
        let end = stretch.start + stretch.text.len();
        let stem = format!("{}*{}", &name[..stretch.start], &name[end..]);
        let before = stretches[..position].last().map(|before| before.text);
        let view = match (is_number, before) {
            (true, Some(before)) if words(before).len() == 1 => {
                format!("{}{word}", before.to_ascii_lowercase())
            }
            (true, _) => format!("view{word}"),
            (false, _) => word,
        };
        sides.push((stem.to_ascii_lowercase(), view));
    }
    sides
}

/// Words and numbers of a name. A word ends between a lower-case and an upper-case letter.
fn stretches(name: &str) -> Vec<Stretch<'_>> {
    let mut found: Vec<Stretch<'_>> = Vec::new();
    let mut start = None;
    let mut before = ' ';
    let mut end_at = |start: &mut Option<usize>, end: usize| {
        if let Some(start) = start.take() {
            found.push(Stretch {
                text: &name[start..end],
                start,
            });
        }
    };
    for (at, letter) in name.char_indices() {
        let is_new = letter.is_ascii_uppercase() && before.is_ascii_lowercase()
            || letter.is_ascii_digit() != before.is_ascii_digit();
        if is_new || !letter.is_ascii_alphanumeric() {
            end_at(&mut start, at);
        }
        if letter.is_ascii_alphanumeric() && start.is_none() {
            start = Some(at);
        }
        before = letter;
    }
    end_at(&mut start, name.len());
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn views_of(names: &[&str]) -> Vec<String> {
        let sided = sided(names).into_iter();
        sided
            .map(|own| format!("{}={}", own.at, own.view))
            .collect()
    }

    #[test]
    fn names_that_differ_in_a_side_alone_are_views() {
        for (names, expected) in [
            (&["left_path", "right_path"][..], &["0=left", "1=right"][..]),
            (
                &["observation.images.left", "observation.images.right"],
                &["0=left", "1=right"],
            ),
            (&["note", "imgLeft", "imgRight"], &["1=left", "2=right"]),
            (&["cam0", "mask", "cam1"], &["0=cam0", "2=cam1"]),
            (&["cam0_l", "cam0_r"], &["0=l", "1=r"]),
            (&["runs/left.mp4", "runs/right.mp4"], &["0=left", "1=right"]),
            (
                &["thumb_img", "index_img", "middle_img"],
                &["0=thumb", "1=index", "2=middle"],
            ),
        ] {
            assert_eq!(views_of(names), expected, "{names:?}");
        }
    }

    #[test]
    fn features_of_lerobot_are_views_by_the_last_part_of_their_names() {
        let views_of = |names: &[&str]| -> Vec<String> {
            let features = features(names.iter().copied().enumerate()).into_iter();
            features
                .map(|own| format!("{}={}", own.at, own.view))
                .collect()
        };
        let cameras = ["observation.images.laptop", "observation.images.gel-2"];
        assert_eq!(views_of(&cameras), ["0=laptop", "1=gel_2"]);
        for names in [&["a.gel"][..], &["a.gel", "b.gel"], &["a.1", "a.gel"]] {
            assert!(views_of(names).is_empty(), "{names:?}");
        }
    }

    #[test]
    fn other_pictures_of_a_row_are_no_views() {
        for names in [
            &["image", "mask"][..],
            &["rgb", "depth"],
            &["left_image", "right_mask"],
            &["image"],
            &["observation.images.laptop", "observation.images.phone"],
            &["leftover", "right"],
        ] {
            assert!(views_of(names).is_empty(), "{names:?}");
        }
    }
}
