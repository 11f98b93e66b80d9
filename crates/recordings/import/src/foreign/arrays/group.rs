//! Groups of arrays: row counts and name lookup.

use std::collections::BTreeMap;

use taceva_arrays::ArrayFile;

use taceva_dataset::internal::{limits, listed};

/// Arrays of one group, or of the whole file.
#[derive(Debug)]
pub(super) struct Group {
    pub(super) path: String,
    pub(super) rows: usize,
}

/// Paths of arrays to which `name` may refer: in `group`, as a field of the table, or from the root.
pub(super) fn candidates(group: &str, name: &str) -> Vec<String> {
    let bare = name.trim_start_matches('/');
    let mut paths = Vec::new();
    if name.starts_with('/') {
        paths.push(format!("/{bare}"));
    }
    paths.extend([
        format!("{group}/{bare}"),
        format!("{group}.{bare}"),
        bare.to_owned(),
    ]);
    paths
}

/// Number of rows of a group: the most frequent length of the first axis of its arrays. Of equally frequent lengths, the greatest counts.
pub(super) fn rows_of(file: &ArrayFile, group: &str) -> Result<usize, String> {
    let mut lengths: BTreeMap<u64, usize> = BTreeMap::new();
    let names = file.names();
    let inside = names.iter().filter(|name| {
        group.is_empty()
            || *name == group
            || name
                .strip_prefix(group)
                .is_some_and(|rest| rest.starts_with(['/', '.']))
    });
    for info in inside.filter_map(|name| file.info(name)) {
        if !info.shape.is_empty() {
            *lengths.entry(info.rows()).or_default() += 1;
        }
    }
    let most = lengths
        .iter()
        .max_by_key(|(length, count)| (**count, **length));
    match most {
        Some((length, _)) if *length > limits::ROWS => {
            Err(format!("{length} rows, expected at most {}", limits::ROWS))
        }
        Some((length, _)) => usize::try_from(*length).map_err(|error| error.to_string()),
        // An unread item explains the missing arrays.
        None if unread(file, group).is_some() => Err(unread(file, group).unwrap_or_default()),
        None => Err(format!(
            "no array with rows {}, found {}",
            match group {
                "" => "in it".to_owned(),
                group => format!("in `{group}`"),
            },
            match names.is_empty() {
                true => "no supported array".to_owned(),
                false => listed(&names),
            }
        )),
    }
}

/// Reason why an item in a group, or above the group, is unread.
fn unread(file: &ArrayFile, group: &str) -> Option<String> {
    let mut unread = file.unread_arrays().into_iter();
    let is_of = |array: &str| {
        let inside = array.strip_prefix(group);
        let above = group.strip_prefix(array);
        let mut rests = inside.into_iter().chain(above);
        rests.any(|rest| rest.is_empty() || rest.starts_with(['/', '.']))
    };
    let (array, reason) = unread.find(|(array, _)| is_of(array))?;
    Some(format!("`{array}`: {reason}"))
}
