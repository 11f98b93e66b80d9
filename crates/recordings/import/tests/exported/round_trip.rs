//! Tests that import exported datasets again with the map of the export.

use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::{Limit, SilentProgress};
use taceva_dataset::Dataset;
use taceva_import::{ExportForm, ExportPlan, ExportReport, ImportMap, ImportPlan};

use super::drawn::{exported, import, imported, recorded, skin};

/// Exports `dataset` in `form`, imports the export, and compares everything that a map can express.
#[track_caller]
fn comes_back(dataset: &Dataset, form: ExportForm) -> Dataset {
    let (folder, report) = exported(dataset, form);
    assert_eq!(report.samples, dataset.table().rows() as u64);
    let map = ImportMap::read(&report.map).expect("a map");
    let again = import(
        &folder,
        &map,
        &dataset
            .path()
            .with_extension(format!("{}-again", form.name())),
    );
    let (before, after) = (dataset.header(), again.header());
    assert_eq!(after.source, before.source);
    assert_eq!(after.clock, before.clock);
    assert_eq!(after.sensor, before.sensor);
    assert_eq!(after.footprint, before.footprint);
    assert_eq!(after.traceability, before.traceability);
    assert_eq!(after.channels, before.channels);
    let spec = |dataset: &Dataset| {
        dataset
            .header()
            .signals
            .as_ref()
            .map(|signals| signals.spec.clone())
    };
    assert_eq!(spec(&again), spec(dataset));
    let ids = [
        "sample",
        "point_id",
        "unit_id",
        "scene",
        "depth_step",
        "repeat",
        "phase",
        "limited_by",
        "zero_u_mm",
        "part",
        "kind",
        "spacing_mm",
        "t_s",
        "intensity",
    ];
    let origin = ["source_table", "source_row", "source_frame"];
    let channels = before.channels.iter().map(|channel| channel.name());
    let attributes = before.attributes.iter().map(String::as_str);
    assert_eq!(after.attributes, before.attributes);
    for name in ids
        .into_iter()
        .chain(origin)
        .chain(channels)
        .chain(attributes)
    {
        assert_eq!(
            again.table().as_text(name),
            dataset.table().as_text(name),
            "{name}"
        );
    }
    for row in 0..dataset.table().rows() {
        assert_eq!(
            again.frame(row).expect("read"),
            dataset.frame(row).expect("read"),
            "{row}"
        );
        assert_eq!(
            again.signals(row).expect("read"),
            dataset.signals(row).expect("read"),
            "{row}"
        );
    }
    assert_eq!(
        again.reference().expect("read"),
        dataset.reference().expect("read")
    );
    again
}

#[test]
fn every_form_brings_a_recording_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = recorded(folder.path());
    for form in ExportForm::ALL {
        comes_back(&dataset, form);
    }
    let (_, report) = exported_anew(&dataset, folder.path(), ExportForm::Csv);
    // Frames stored as differences become files.
    assert_eq!(report.pictures, 1030);
    assert!((1000..1030).contains(&report.encoded_anew), "{report:?}");
    assert_eq!(report.left_out, Vec::<String>::new());
}

#[test]
fn every_form_brings_taxels_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = skin(folder.path());
    for form in ExportForm::ALL {
        let again = comes_back(&dataset, form);
        // Without pictures nothing is re-encoded, so the digests are equal.
        assert_eq!(again.digest(), dataset.digest(), "{form:?}");
    }
}

#[test]
fn every_form_brings_an_import_back_with_where_its_rows_came_from() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = imported(folder.path());
    for form in ExportForm::ALL {
        let again = comes_back(&dataset, form);
        // A table with separate picture files keeps their bytes.
        assert_eq!(
            again.digest() == dataset.digest(),
            form == ExportForm::Csv,
            "{form:?}"
        );
    }
    let first = dataset
        .path()
        .with_extension("csv")
        .join("frames/0000/000000.jpg");
    let lab = folder.path().join("lab/bilder/0.jpg");
    assert_eq!(fs::read(first).expect("read"), fs::read(lab).expect("read"));
}

#[test]
fn a_table_says_which_limit_ended_a_press_and_where_rows_first_came_from() {
    let folder = tempfile::tempdir().expect("a folder");
    let lab = folder.path().join("lab");
    fs::create_dir(&lab).expect("made");
    let map = "map_version = 2\ntable = \"labels.csv\"\n[columns]\nFz = { from = \"f\", unit = \"N\" }\n[ids]\nlimited_by = \"limit\"\n\
        [origin]\nrow = \"was\"\n[time]\nclock = \"unknown\"\n[sensor]\nmodel = \"m\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = true\n";
    let map = ImportMap::parse("map.toml".as_ref(), map).expect("a map");
    fs::write(lab.join("labels.csv"), "f,limit,was\n1,depth,7\n2,,\n").expect("written");
    let dataset = import(&lab, &map, &folder.path().join("set"));
    assert_eq!(dataset.table().limited_by(), [Some(Limit::Depth), None]);
    assert_eq!(dataset.table().source_row(), [Some(7), None]);
    assert_eq!(dataset.table().source_table(), [None, None]);
    fs::write(lab.join("labels.csv"), "f,limit,was\n1,weather,7\n").expect("written");
    let message = ImportPlan::new(&lab, &map)
        .expect_err("no limit")
        .to_string();
    assert!(
        message.ends_with("line 2, column `limit`: `weather`: expected one of `depth`, `normal-force`, `shear-force`"),
        "{message}"
    );
}

#[test]
fn the_same_dataset_gives_the_same_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = imported(folder.path());
    for form in ExportForm::ALL {
        let (first, _) = exported(&dataset, form);
        let (second, _) = exported_anew(&dataset, folder.path(), form);
        let names = files(&first);
        assert_eq!(files(&second), names);
        for name in names {
            let read = |of: &Path| fs::read(of.join(&name)).expect("read");
            assert_eq!(read(&first), read(&second), "{name}");
        }
    }
}

/// Repeats the export into another folder, on one thread.
fn exported_anew(dataset: &Dataset, folder: &Path, form: ExportForm) -> (PathBuf, ExportReport) {
    let target = folder.join(format!("anew-{}", form.name()));
    let plan = ExportPlan::new(dataset, form).expect("samples");
    let report = plan
        .run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("exported");
    (target, report)
}

/// Relative paths of all files below a folder.
fn files(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_owned()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(next).expect("there").flatten() {
            let path = entry.path();
            match path.is_dir() {
                true => open.push(path),
                false => found.push(
                    path.strip_prefix(folder)
                        .expect("inside")
                        .to_string_lossy()
                        .into_owned(),
                ),
            }
        }
    }
    found.sort();
    found
}
