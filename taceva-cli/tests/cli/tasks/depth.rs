//! Scores of the depth maps in an array against those of a dataset, and of places in two tables.

use std::fmt::Write as _;

use super::estimate;
use crate::support::Bench;

const MAP: &str = r#"map_version = 2
table = "presses.csv"
[columns]
Fz = { from = "fz", unit = "N" }
[ids]
point_id = "press"
[time]
clock = "unknown"
[task.shape]
kind = "depth"
array = "depth.npy"
unit = "mm"
pixel_mm = [0.5, 0.5]
[sensor]
model = "lab finger"
serial = "unknown"
gel = "unknown"
opaque = "unknown"
"#;

/// Writes a NumPy file of depth maps of 3 × 3 pixels.
fn write_maps(bench: &Bench, name: &str, maps: &[[f32; 9]]) {
    write_depths(bench, name, 3, maps.as_flattened());
}

/// Writes a NumPy file of square depth maps.
fn write_depths(bench: &Bench, name: &str, side: usize, depths: &[f32]) {
    let shape = format!("({}, {side}, {side})", depths.len() / (side * side));
    let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}\n");
    let length = u16::try_from(header.len()).expect("short");
    let mut bytes = [b"\x93NUMPY\x01\x00", &length.to_le_bytes()[..]].concat();
    bytes.extend(header.into_bytes());
    for number in depths {
        bytes.extend(number.to_le_bytes());
    }
    std::fs::write(bench.path(name), bytes).expect("written");
}

/// Imports the dataset `set` of six presses, each deeper than the one before, and returns the true maps.
fn presses(bench: &Bench) -> Vec<[f32; 9]> {
    let mut table = "fz,press\n".to_owned();
    let mut maps = Vec::new();
    let mut depth = 0.25;
    for press in 0..6 {
        table += &format!("1,p{press}\n");
        maps.push([0.0, 0.0, 0.0, 0.0, depth, 0.0, 0.0, 0.0, f32::NAN]);
        depth += 0.25;
    }
    bench.write("lab/presses.csv", &table);
    bench.write("lab/map.toml", MAP);
    write_maps(bench, "lab/depth.npy", &maps);
    bench.ok("import lab --map lab/map.toml --out set -q");
    maps
}

const SCORE: &str = "score --truth set --pred maps.npy --task shape=depth";

#[test]
fn maps_of_an_array_are_scored_beside_those_of_a_dataset() {
    let bench = Bench::new();
    let truth = presses(&bench);
    write_maps(&bench, "maps.npy", &truth);
    let report = bench.json(SCORE);
    crate::schema::check("tasks", &report);
    for metric in ["depth_mae", "depth_rmse", "depth_bias", "depth_max"] {
        assert_eq!(estimate(&report, metric, None)["value"], 0.0, "{metric}");
    }
    assert_eq!(estimate(&report, "contact_iou", None)["value"], 1.0);
    assert_eq!(estimate(&report, "normal_angle", None)["value"], 0.0);
    assert_eq!(report["tasks"][0]["cluster"], "point_id");
    let higher = truth.iter().map(|map| map.map(|depth| depth + 0.125));
    write_maps(&bench, "maps.npy", &higher.collect::<Vec<_>>());
    let report = bench.json(SCORE);
    let error = estimate(&report, "depth_mae", None);
    assert_eq!(error["value"], 0.125);
    // Eight valid pixels in each of six maps.
    assert_eq!(
        (error["n"].as_u64(), error["clusters"].as_u64()),
        (Some(48), Some(6))
    );
    assert_eq!(
        estimate(&report, "depth_bias", Some("per_map"))["value"],
        -0.125
    );
    // Every valid pixel is in contact in the prediction, and one in the truth.
    assert_eq!(estimate(&report, "contact_iou", None)["value"], 0.125);
    let report = bench.json(&format!("{SCORE}:gate=0.2"));
    assert_eq!(estimate(&report, "contact_iou", None)["value"], 1.0);
}

#[test]
fn predictions_in_another_unit_are_converted() {
    let bench = Bench::new();
    let truth = presses(&bench);
    let micrometres = truth.iter().map(|map| map.map(|depth| depth * 1000.0));
    write_maps(&bench, "maps.npy", &micrometres.collect::<Vec<_>>());
    let report = bench.json(&format!("{SCORE}:unit=um"));
    assert_eq!(estimate(&report, "depth_rmse", None)["value"], 0.0);
}

#[test]
fn the_mean_map_of_a_declared_training_part_is_the_constant_to_beat() {
    let bench = Bench::new();
    let maps = presses(&bench);
    let parts = ["train", "test", "test", "test", "test", "test"];
    let rows = parts.iter().zip(0..);
    let rows = rows.map(|(part, press)| format!("1,p{press},{part}\n"));
    let table = format!("fz,press,part\n{}", rows.collect::<String>());
    bench.write("lab/presses.csv", &table);
    let map = MAP.replace("[ids]\n", "[ids]\npart = \"part\"\n");
    bench.write("lab/map.toml", &map);
    bench.ok("import lab --map lab/map.toml --out parts -q");
    write_maps(&bench, "maps.npy", &maps);
    let report = bench.json(&SCORE.replace("--truth set", "--truth parts"));
    let greatest = estimate(&report, "depth_max", None);
    // The only training map is 0.25 mm deep, and the deepest test map 1.5 mm.
    assert_eq!(
        (greatest["value"].as_f64(), greatest["of_constant"].as_f64()),
        (Some(0.0), Some(1.25))
    );
    assert_eq!(estimate(&report, "depth_mae", None)["n"], 40);
    let notes = report["tasks"][0]["notes"].to_string();
    assert!(
        notes.contains("the mean map of 1 sample of the training part"),
        "{notes}"
    );
}

/// Scores predictions that equal the true maps of a new dataset.
fn scored_with_itself(bench: &Bench, maps: &[[f32; 9]]) -> serde_json::Value {
    write_maps(bench, "lab/depth.npy", maps);
    write_maps(bench, "maps.npy", maps);
    bench.ok("import lab --map lab/map.toml --out set --force -q");
    bench.json(SCORE)
}

#[test]
fn maps_without_a_valid_pixel_and_negative_depths_are_counted() {
    let bench = Bench::new();
    let mut maps = presses(&bench);
    maps[0] = [f32::NAN; 9];
    maps[1][0] = -0.25;
    let report = scored_with_itself(&bench, &maps);
    let notes = report["tasks"][0]["notes"].to_string();
    for words in [
        "1 map without a pixel that is valid in truth and prediction, left out",
        "1 valid pixel with a negative depth, kept",
    ] {
        assert!(notes.contains(words), "{words}: {notes}");
    }
    assert_eq!(estimate(&report, "depth_mae", None)["n"], 40);
    let report = scored_with_itself(&bench, &[[f32::NAN; 9]; 6]);
    let error = estimate(&report, "depth_mae", None);
    assert!(
        error["value"].is_null() && error["undefined"].is_string(),
        "{error}"
    );
}

#[test]
fn maps_that_do_not_belong_to_the_dataset_are_refused() {
    let bench = Bench::new();
    let truth = presses(&bench);
    write_maps(&bench, "maps.npy", &truth[..5]);
    bench.refused(SCORE, 3, "5 depth maps for 6 samples");
    write_maps(&bench, "maps.npy", &truth);
    let other = SCORE.replace("shape=", "form=");
    bench.refused(&other, 2, "expected one of its tasks of kind depth: shape");
    bench.refused(&format!("{SCORE}:unit=N"), 2, "not a unit of length");
    bench.refused(
        &format!("{SCORE} --cluster clip"),
        2,
        "no such id or attribute",
    );
    let table = SCORE.replace("--truth set", "--truth lab/presses.csv");
    bench.refused(
        &table,
        3,
        "the truth of the depth maps `shape` is a dataset",
    );
}

#[test]
fn places_are_scored_by_their_distance() {
    let bench = Bench::new();
    let mut truth = "id,object,contact.x,contact.y,contact.z\n".to_owned();
    let mut prediction = "id,contact.x,contact.y,contact.z\n".to_owned();
    for object in 0..6 {
        truth += &format!("{object},o{object},1,2,3\n");
        prediction += &format!("{object},4,6,3\n");
    }
    bench.write("truth.csv", &truth);
    bench.write("pred.csv", &prediction);
    let report =
        bench.json("score --truth truth.csv --pred pred.csv --task contact=place --cluster object");
    crate::schema::check("tasks", &report);
    assert_eq!(estimate(&report, "pose_translation", None)["value"], 5.0);
    assert_eq!(estimate(&report, "pose_axis", Some("x"))["value"], 3.0);
    assert!(!report.to_string().contains("pose_rotation"), "{report:#}");
}

/// Writes tables of true places in mm and of predictions `scale` times the truth. If `follows` is false, some predictions have the opposite sign.
fn places(bench: &Bench, scale: f64, follows: bool) {
    let mut truth = "id,object,contact.x,contact.y,contact.z\n".to_owned();
    let mut prediction = "id,contact.x,contact.y,contact.z\n".to_owned();
    for row in 0..30_u32 {
        let [x, y] = [row * 7 % 30, row * 11 % 30].map(|place| f64::from(place) - 14.5);
        let sign = if follows || row * 13 % 7 < 3 {
            1.0
        } else {
            -1.0
        };
        truth += &format!("{row},o{},{x},{y},2\n", row % 6);
        let [x, y, z] = [x, y, 2.0].map(|part| part * sign * scale);
        prediction += &format!("{row},{x},{y},{z}\n");
    }
    bench.write("truth.csv", &truth);
    bench.write("pred.csv", &prediction);
}

#[test]
fn places_in_metres_beside_millimetres_are_noted_with_the_unit_to_state() {
    const SCORE: &str =
        "score --truth truth.csv --pred pred.csv --cluster object --task contact=place";
    let notes = |bench: &Bench, more: &str| {
        let report = bench.json(&format!("{SCORE}{more}"));
        let translation = estimate(&report, "pose_translation", None)["value"].as_f64();
        (report["tasks"][0]["notes"].to_string(), translation)
    };
    let bench = Bench::new();
    places(&bench, 0.001, true);
    let (found, _) = notes(&bench, "");
    let expected = "the predictions in `contact.x`, `contact.y` and `contact.z` follow the truth at about a thousandth of the truth";
    assert!(found.contains(expected), "{found}");
    assert!(found.contains("--task contact=place:unit=m,"), "{found}");
    let (mended, error_mm) = notes(&bench, ":unit=m");
    assert_eq!(mended, "[]");
    assert!(error_mm.is_some_and(|error| error < 1e-9), "{error_mm:?}");
    places(&bench, 1000.0, true);
    let (found, _) = notes(&bench, "");
    assert!(found.contains("--task contact=place:unit=um,"), "{found}");
    let (found, _) = notes(&bench, ":unit=mm");
    assert!(
        found.contains("correct :unit=mm of --task contact"),
        "{found}"
    );
    bench.refused(&format!("{SCORE}:unit=N"), 2, "not a unit of length");
}

#[test]
fn places_in_the_unit_of_the_truth_and_predictions_near_zero_have_no_note() {
    let bench = Bench::new();
    for (scale, follows) in [(0.9, true), (0.1, true), (0.001, false)] {
        places(&bench, scale, follows);
        let report = bench
            .json("score --truth truth.csv --pred pred.csv --cluster object --task contact=place");
        let notes = &report["tasks"][0]["notes"];
        assert_eq!(notes.to_string(), "[]", "{scale}");
    }
}

#[test]
fn depth_maps_are_no_labels_of_a_classifier_and_of_a_model_file() {
    let bench = Bench::new();
    presses(&bench);
    bench.refused(
        "fit set --task shape --model ridge --out shape.model --no-cache",
        3,
        "the kind of the task `shape` is depth, expected a task of classes or of poses",
    );
    bench.refused(
        "evaluate set --task shape --model lda --no-cache",
        2,
        "depth maps are numbers; choose another model, such as --model cnn",
    );
}

/// Imports the dataset `name` of ten presses at six depths each, on 8 × 8 taxels. Each taxel measures the depth at its place.
fn press_taxels(bench: &Bench, name: &str, first: u16) {
    let mut table = String::from("fz,press");
    (0..64).for_each(|taxel| write!(table, ",c{taxel}").expect("written"));
    let mut depths = Vec::new();
    for press in first..first + 10 {
        for step in 0..6_u16 {
            let depth = f32::from(press % 3 + 2 * step) * 0.125;
            write!(table, "\n1,p{press}").expect("written");
            for taxel in 0..64_u16 {
                let [x, y] = [taxel % 8, taxel / 8].map(|at| f32::from(at) - 3.5);
                let own = depth * (-(x * x + y * y) / 8.0).exp();
                let noise = f32::from((press * 5 + step * 3 + taxel * 7) % 11) * 0.01;
                write!(table, ",{:.3}", own + noise).expect("written");
                depths.push(own);
            }
        }
    }
    table.push('\n');
    let signals = "[signals]\nfrom = \"c0..63\"\nunit = \"uT\"\nplaces = [8, 8]\nchannels = [\"p\"]\norder = \"place-first\"\n";
    bench.write("lab/presses.csv", &table);
    bench.write(
        "lab/map.toml",
        &MAP.replace("[ids]\n", &format!("{signals}[ids]\n")),
    );
    write_depths(bench, "lab/depth.npy", 8, &depths);
    bench.ok(&format!("import lab --map lab/map.toml --out {name} -q"));
}

/// Root mean square error of the depths over all pixels, divided by that of the mean map.
fn share_of_constant(report: &serde_json::Value) -> f64 {
    let error = estimate(report, "depth_rmse", None);
    let number = |key: &str| error[key].as_f64().expect("a number");
    number("value") / number("of_constant")
}

#[test]
fn a_network_predicts_depth_maps_of_unseen_presses_better_than_the_mean_map() {
    let bench = Bench::new();
    press_taxels(&bench, "taxels", 0);
    let report =
        bench.json("evaluate taxels --task shape --set epochs=100 --set batch=16 --no-cache");
    crate::schema::check("tasks", &report);
    let error = estimate(&report, "depth_rmse", None);
    assert_eq!(
        (error["n"].as_u64(), error["clusters"].as_u64()),
        (Some(60 * 64), Some(10))
    );
    assert!(share_of_constant(&report) < 0.8, "{report:#}");
    let notes = report["tasks"][0]["notes"].to_string();
    for words in [
        "model cnn",
        "8 x 8 mean depths",
        "the mean map of all samples",
    ] {
        assert!(notes.contains(words), "{words}: {notes}");
    }
}

#[test]
fn depth_maps_of_joined_recordings_are_predicted_by_any_model_of_numbers() {
    let bench = Bench::new();
    press_taxels(&bench, "one", 0);
    press_taxels(&bench, "two", 10);
    let report = bench.json("evaluate one two --task shape --model ridge --no-cache");
    assert_eq!(estimate(&report, "depth_mae", None)["clusters"], 20);
    assert!(share_of_constant(&report) < 0.3, "{report:#}");
    let split = "--split by-point";
    let report = bench.json(&format!(
        "evaluate one --task shape --model ridge {split} --no-cache"
    ));
    let notes = report["tasks"][0]["notes"].to_string();
    assert!(
        notes.contains("the mean map of the training part"),
        "{notes}"
    );
}
