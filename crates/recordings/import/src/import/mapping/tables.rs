//! Summary of a map's joins, pictures and classes for the header of the dataset.

use super::{short, short_name};
use crate::import::map::{FrameMap, FrameNames, ImportMap, JoinBy, JoinMap, Lag, OWN_ROW};
use taceva_dataset::{MappedClass, MappedJoin, MappedPictures};

pub(super) fn join(map: &JoinMap) -> MappedJoin {
    let name = short_name(&map.name);
    let mut join = match &map.by {
        JoinBy::Row => MappedJoin::new(&name, "row"),
        JoinBy::All => MappedJoin::new(&name, "all"),
        JoinBy::Columns(columns) => {
            let on = columns.iter();
            let on: Vec<String> = on.map(|(own, other)| format!("{own} = {other}")).collect();
            let mut join = MappedJoin::new(&name, "columns");
            join.on = short(&on);
            join
        }
        JoinBy::Until(column) => {
            let mut join = MappedJoin::new(&name, "until");
            join.column = Some(short_name(column).into_owned());
            join
        }
        JoinBy::Time(by) => {
            let mut join = MappedJoin::new(&name, "time");
            join.column = Some(short_name(&by.time.column).into_owned());
            join.unit = Some(by.time.unit.symbol().to_owned());
            join.pick = Some(by.pick.name().to_owned());
            join.tolerance_ms = Some(by.tolerance_ms);
            match &by.lag {
                Lag::Fixed(lag) => join.lag_ms = Some(*lag),
                Lag::Column(column) => join.lag_by = vec![short_name(column).into_owned()],
                Lag::Files(lags) => {
                    let lags = lags.iter().map(|(file, lag)| format!("{file} = {lag}"));
                    join.lag_by = short(&lags.collect::<Vec<_>>());
                }
            }
            join
        }
    };
    let skip = map.skip.iter();
    let skip = skip.map(|(column, number)| format!("{column} = {number}"));
    let frame = map.frame_id.iter();
    let frame = frame.map(|frame| format!("frame_id other than {}", short_name(frame)));
    let skip: Vec<String> = skip.chain(frame).collect();
    join.skip = short(&skip);
    map.unmatched.name().clone_into(&mut join.unmatched);
    join
}

pub(super) fn pictures(map: &FrameMap) -> MappedPictures {
    let of = |by: &str, from: &str| MappedPictures::new(by, &short_name(from));
    let index = |column: &str| (column != OWN_ROW).then(|| short_name(column).into_owned());
    let mut pictures = match &map.names {
        FrameNames::Column(column) => of("column", column),
        FrameNames::Pattern(pattern) => of("pattern", pattern),
        FrameNames::Bytes(column) => of("bytes", column),
        FrameNames::Video(video) => {
            let mut pictures = of("video", &video.file);
            pictures.index = index(&video.index);
            pictures.range = video.range.map(|range| range.ends());
            pictures.bits = video.range.map(|range| range.bits());
            pictures
        }
        FrameNames::Array(array) => {
            let mut pictures = of("array", array.path.as_deref().unwrap_or_default());
            pictures.index = index(&array.index);
            pictures.layout = array.layout.map(|layout| layout.name().to_owned());
            pictures.range = array.range.map(|range| range.ends());
            pictures.bits = array.range.map(|range| range.bits());
            pictures
        }
    };
    pictures.view.clone_from(&map.view);
    pictures
}

pub(super) fn classes(map: &ImportMap) -> Vec<MappedClass> {
    let classes = map.classes.iter().map(|(name, class)| {
        let from = short_name(&class.from);
        MappedClass::new(&short_name(name), &from, short(&class.names))
    });
    classes.collect()
}
