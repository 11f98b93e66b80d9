//! Streams of pictures alone, whose neighbours resemble each other.

use std::num::NonZeroUsize;
use std::path::Path;

use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_import::{ImportMap, ImportPlan};
use taceva_metrics::Standing;

use crate::division::{evaluated, r2, said, walks};

/// Side of a picture, pixels.
const SIDE: usize = 32;
/// Number of tiles along a side, and side of a tile, pixels.
const TILES: usize = 4;
const TILE: usize = SIDE / TILES;

/// Gray pictures at 50 Hz, and a force. The brightness of each tile and the force are independent random walks.
fn stream(folder: &Path) -> Dataset {
    let rows = walks();
    let header = format!(
        "{{'descr': '|u1', 'fortran_order': False, 'shape': ({}, {SIDE}, {SIDE}), }}\n",
        rows.len()
    );
    let length = u16::try_from(header.len()).expect("short");
    let mut bytes = [b"\x93NUMPY\x01\x00", &length.to_le_bytes()[..]].concat();
    bytes.extend(header.into_bytes());
    let mut table = "t,fz\n".to_owned();
    for row in &rows {
        table += &format!("{},{}\n", row.time_s.expect("a time"), row.force);
        let level = |value: &f32| {
            let light = 128.0 + 4.0 * f64::from(*value);
            let level = (0..=255_u8).find(|level| f64::from(*level) >= light);
            level.unwrap_or(255)
        };
        let levels: Vec<u8> = row.values.iter().map(level).collect();
        let pixels = (0..SIDE * SIDE).map(|pixel| [pixel % SIDE, pixel / SIDE]);
        bytes.extend(pixels.map(|[x, y]| levels[y / TILE * TILES + x / TILE]));
    }
    std::fs::write(folder.join("f.npy"), bytes).expect("written");
    std::fs::write(folder.join("labels.csv"), table).expect("written");
    let map = "map_version = 2\ntable = \"labels.csv\"\n[frame]\narray = { file = \"f.npy\" }\nchannel_order = \"gray\"\nreference = \"unknown\"\n\
        [columns]\nFz = { from = \"fz\", unit = \"N\" }\n[time]\nclock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"\n\
        [sensor]\nmodel = \"drawn gel\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = \"unknown\"\n";
    let map = ImportMap::parse("map.toml".as_ref(), map).expect("a map");
    let plan = ImportPlan::new(folder, &map).expect("planned");
    let target = folder.join("dataset");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    Dataset::open(&target).expect("a dataset")
}

#[test]
fn a_stream_of_pictures_is_divided_by_blocks_of_time_and_at_random_it_is_optimistic() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = stream(folder.path());
    let blocks = evaluated(&dataset, "knn", None);
    let split = blocks.report.provenance.split.as_deref();
    assert!(
        split.is_some_and(|split| split.ends_with("by-block")),
        "{split:?}"
    );
    let neighbours = blocks.report.provenance.neighbours.as_deref();
    assert!(
        neighbours.is_some_and(|said| said.contains("blocks of time stay together")),
        "{neighbours:?}"
    );
    let random = evaluated(&dataset, "knn", Some("random"));
    assert!(
        r2(&random) > 0.9 && r2(&random) > r2(&blocks) + 0.1,
        "{} at random, {} by blocks",
        r2(&random),
        r2(&blocks)
    );
    assert!(
        said(&random).contains("the scores are optimistic"),
        "{}",
        said(&random)
    );
    let score = random.report.score("r2", "Fz").expect("scored");
    assert!(score.standing >= Standing::Neighbours, "{score:?}");
}
