//! Interprets column names in a map.

use crate::foreign::ForeignTable;
use crate::import::map::{FrameNames, ImportMap};
use crate::import::pattern_column::PatternColumn;

/// Splits `ft[2,0]` into the column and the index in its cells; `None` for a name without an index.
pub(super) fn indexed(name: &str) -> Option<(&str, Vec<usize>)> {
    let (base, index) = name.strip_suffix(']')?.rsplit_once('[')?;
    let index: Result<Vec<usize>, _> = index.split(',').map(|part| part.trim().parse()).collect();
    Some((base, index.ok()?))
}

/// Column to which the name `name` refers, without the index in its cells.
pub(super) fn base_of(name: &str) -> &str {
    indexed(name).map_or(name, |(base, _)| base)
}

/// Distinct columns that the map of the table `main` names, without the results of matrices.
pub(super) fn mentioned(map: &ImportMap, main: &ForeignTable) -> Vec<String> {
    let ids = &map.ids;
    let given = |name: &String| {
        let mut matrices = map.matrices.iter();
        matrices.any(|matrix| (0..matrix.gives.len()).any(|at| matrix.column(at) == *name))
    };
    let mut names: Vec<String> = map
        .columns
        .iter()
        .map(|column| column.from.clone())
        .collect();
    names.retain(|name| !given(name));
    let single = [
        &ids.sample,
        &ids.unit_id,
        &ids.scene,
        &ids.depth_step,
        &ids.repeat,
        &ids.phase,
        &ids.limited_by,
        &ids.zero_u_mm,
        &ids.part,
        &ids.kind,
        &ids.spacing_mm,
    ];
    names.extend(single.into_iter().flatten().cloned());
    names.extend(ids.point_id.iter().chain(map.attributes.values()).cloned());
    names.extend(map.classes.values().map(|class| class.from.clone()));
    names.extend(
        map.tasks
            .iter()
            .flat_map(|own| own.task.from.iter().cloned()),
    );
    let origin = map.origin.iter().flat_map(|origin| origin.columns());
    names.extend(origin.cloned());
    names.extend(map.time.iter().map(|time| time.column.clone()));
    names.extend(
        map.matrices
            .iter()
            .flat_map(|matrix| matrix.from.iter().cloned()),
    );
    names.extend(map.zero.iter().flat_map(|zero| zero.columns().cloned()));
    let gravity = map.gravity.iter();
    names.extend(gravity.flat_map(|gravity| gravity.orientation.columns.iter().cloned()));
    if !map.drop.quality_flags.is_empty() {
        names.push(map.drop.flag_column.clone());
    }
    let of_pattern = |pattern: &str| -> Vec<String> {
        let columns = PatternColumn::all(pattern, |name| main.has(name));
        columns.map(|column| column.name.to_owned()).collect()
    };
    for frame in &map.frames {
        names.extend(frame.reference_column.clone());
        match &frame.names {
            FrameNames::Column(column) => names.push(column.clone()),
            FrameNames::Pattern(pattern) => names.extend(of_pattern(pattern)),
            FrameNames::Array(array) => {
                names.push(array.index.clone());
                names.extend(array.file.iter().flat_map(|file| of_pattern(file)));
            }
            FrameNames::Video(video) => {
                names.push(video.index.clone());
                names.extend(of_pattern(&video.file));
            }
            FrameNames::Bytes(_) => {}
        }
    }
    let mut once: Vec<String> = Vec::with_capacity(names.len());
    for name in names {
        if !once.contains(&name) {
            once.push(name);
        }
    }
    once
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_position_stands_behind_the_name_of_its_column() {
        assert_eq!(indexed("ft[2]"), Some(("ft", vec![2])));
        assert_eq!(indexed("/pose[2, 0]"), Some(("/pose", vec![2, 0])));
        assert_eq!(indexed("ft[x]"), None);
        assert_eq!(indexed("ft"), None);
        assert_eq!(base_of("a[0][1]"), "a[0]");
    }
}
