//! How a map joins tables, finds pictures and names classes, as the header of the dataset keeps it.

use super::{short, short_name};
use crate::header::{MappedClass, MappedJoin, MappedPictures};
use crate::import::map::{FrameMap, FrameNames, ImportMap, JoinBy, JoinMap, OWN_ROW};

pub(super) fn join(map: &JoinMap) -> MappedJoin {
    let name = short_name(&map.name);
    let mut join = match &map.by {
        JoinBy::Row => MappedJoin::new(&name, "row"),
        JoinBy::All => MappedJoin::new(&name, "all"),
        JoinBy::Columns(columns) => {
            let on = columns.iter();
            let on: Vec<String> = on.map(|(own, other)| format!("{own} = {other}")).collect();
            MappedJoin {
                on: short(&on),
                ..MappedJoin::new(&name, "columns")
            }
        }
        JoinBy::Until(column) => MappedJoin {
            column: Some(short_name(column).into_owned()),
            ..MappedJoin::new(&name, "until")
        },
        JoinBy::Time(by) => MappedJoin {
            column: Some(short_name(&by.time.column).into_owned()),
            unit: Some(by.time.unit.symbol().to_owned()),
            pick: Some(by.pick.name().to_owned()),
            tolerance_ms: Some(by.tolerance_ms),
            lag_ms: Some(by.lag_ms),
            ..MappedJoin::new(&name, "time")
        },
    };
    let skip = map.skip.iter();
    let skip: Vec<String> = skip
        .map(|(column, number)| format!("{column} = {number}"))
        .collect();
    join.skip = short(&skip);
    map.unmatched.name().clone_into(&mut join.unmatched);
    join
}

pub(super) fn pictures(map: &FrameMap) -> MappedPictures {
    let of = |by: &str, from: &str| MappedPictures::new(by, &short_name(from));
    let index = |column: &str| (column != OWN_ROW).then(|| short_name(column).into_owned());
    match &map.names {
        FrameNames::Column(column) => of("column", column),
        FrameNames::Pattern(pattern) => of("pattern", pattern),
        FrameNames::Bytes(column) => of("bytes", column),
        FrameNames::Video(video) => MappedPictures {
            index: index(&video.index),
            ..of("video", &video.file)
        },
        FrameNames::Array(array) => MappedPictures {
            index: index(&array.index),
            layout: array.layout.map(|layout| layout.name().to_owned()),
            range: array.range.map(|range| range.ends()),
            bits: array.range.map(|range| range.bits()),
            ..of("array", array.path.as_deref().unwrap_or_default())
        },
    }
}

pub(super) fn classes(map: &ImportMap) -> Vec<MappedClass> {
    let classes = map.classes.iter().map(|(name, class)| {
        let from = short_name(&class.from);
        MappedClass::new(&short_name(name), &from, short(&class.names))
    });
    classes.collect()
}
