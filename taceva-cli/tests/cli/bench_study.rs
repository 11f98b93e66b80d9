//! Studies of the simulated bench, compared by processor time and the widths of their intervals.

use std::num::{NonZeroU32, NonZeroUsize};
use std::path::PathBuf;

use taceva_acquire::{SceneText, Surroundings, Workshop};
use taceva_core::SilentProgress;
use taceva_drivers::Drivers;
use taceva_models::Models;
use taceva_study::RunSetup;
use taceva_study::bench::StudyGrid;

use crate::run::SMALL;
use crate::support::Bench;
use crate::sweep_scenes::refused::{LAB, REAL};

/// Test folder with the small scene and the metric `mae` alone, which needs only calibration presses.
fn with_small() -> Bench {
    let bench = Bench::new();
    let scene = format!("{SMALL}metrics = {{ want = [\"mae\"] }}\n");
    bench.write("small.toml", &scene);
    bench
}

#[test]
fn each_combination_is_a_study_and_a_row_without_a_width_is_not_on_the_front() {
    let bench = with_small();
    let found = bench.json("bench study small.toml --points 16 --folds none,3 --models ridge");
    crate::schema::check("bench-study", &found);
    assert_eq!(
        (&found["study"], &found["seed"]),
        (&"small".into(), &7.into())
    );
    let rows = found["rows"].as_array().expect("rows");
    let folds: Vec<_> = rows.iter().map(|row| row["folds"].as_u64()).collect();
    assert_eq!(folds, [None, Some(3)]);
    // A tenth of 16 points is too few for an interval; with folds, every point is scored.
    let scored = rows.iter().map(|row| row["clusters"].as_u64());
    assert_eq!(scored.collect::<Vec<_>>(), [None, Some(16)]);
    let marks = rows.iter().map(|row| row["pareto"].as_bool());
    assert_eq!(marks.collect::<Vec<_>>(), [Some(false), Some(true)]);
    for row in rows {
        assert_eq!(
            (&row["points"], &row["model"]),
            (&16.into(), &"ridge".into())
        );
        let channels = row["errors"].as_array().expect("errors").iter();
        let channels: Vec<_> = channels
            .filter_map(|error| error["channel"].as_str())
            .collect();
        assert_eq!(channels, ["Pz", "Fz", "Pxy", "Fxy"]);
        assert!(row["press_cpu_s"].as_f64().is_some_and(|time| time > 0.0));
        assert!(row["assess_cpu_s"].as_f64().is_some_and(|time| time > 0.0));
    }
    let error = &rows[1]["errors"][0];
    let end = |at: usize| error["ci95"][at].as_f64().expect("an end");
    let width = error["width"].as_f64().expect("a width");
    assert!((width - (end(1) / end(0)).ln()).abs() < 1e-12, "{error}");
}

#[test]
fn repetitions_with_further_seeds_give_the_coverage_of_the_intervals() {
    let bench = with_small();
    let words = "bench study small.toml --points 16 --folds 3 --models ridge";
    let found = bench.json(&format!("{words} --seeds 3"));
    crate::schema::check("bench-study", &found);
    let once = bench.json(words);
    assert_eq!((&found["seeds"], &once["seeds"]), (&3.into(), &1.into()));
    let [all, first] = [&found, &once].map(|found| &found["rows"][0]["errors"][1]);
    // The row has the errors of the first seed, whose presses are those of a single repetition.
    assert_eq!(all["mae"], first["mae"]);
    assert!(first["coverage"].is_null(), "{first}");
    let coverage = &all["coverage"];
    assert_eq!(coverage["intervals"], 3);
    assert!(coverage["contained"].as_u64().is_some_and(|of| of <= 3));
    assert_ne!(coverage["mean"], all["mae"], "the seeds differ");
    let csv = bench.ok(&format!("{words} --seeds 2 --format csv -q"));
    assert!(
        csv.lines()
            .next()
            .is_some_and(|head| head.contains("coverage Fxy")),
        "{csv}"
    );
}

#[test]
fn every_model_is_scored_on_the_test_part_of_the_split_of_the_scene() {
    let bench = with_small();
    let scene = std::fs::read_to_string(bench.path("small.toml")).expect("written");
    let own = "name = \"ridge\", ";
    let split = "split = \"by-point 40/10/50\", ";
    bench.write("small.toml", &scene.replace(own, &format!("{own}{split}")));
    let words = "bench study small.toml --points 16 --folds none --models ridge,baseline";
    let found = bench.json(words);
    let rows = found["rows"].as_array().expect("rows");
    let scored = rows.iter().map(|row| row["errors"][0]["n"].as_u64());
    let scored: Vec<_> = scored.collect();
    assert_eq!(scored[0], scored[1], "{found}");
    // A tenth of 16 points would be too few for an interval.
    for row in rows {
        let clusters = row["clusters"].as_u64();
        assert!(clusters.is_some_and(|points| points >= 7), "{row}");
    }
}

#[test]
fn a_further_seed_is_planned_only_when_its_turn_comes() {
    // Plans of so many seeds would fill the memory.
    let seeds = NonZeroU32::MAX;
    let grid = StudyGrid {
        study: None,
        seed: Some(3),
        seeds,
        points: vec![16],
        folds: vec![None],
        models: vec!["ridge".to_owned()],
    };
    let scene = SceneText {
        name: "small".to_owned(),
        text: format!("{SMALL}metrics = {{ want = [\"mae\"] }}\n"),
        folder: PathBuf::from("."),
    };
    let drivers = Drivers::builtin().expect("no two share a key");
    let models = Models::builtin();
    let setup = RunSetup {
        workshop: Workshop {
            drivers: &drivers,
            surroundings: &|_, _| -> Option<Surroundings> { panic!("a plan opens no device") },
            progress: &SilentProgress,
            operator: None,
            viewer: None,
        },
        models: &models,
        cache: None,
        jobs: NonZeroUsize::MIN,
    };
    let entries = grid.entries(&scene, setup).expect("a valid scene");
    let [entry] = &entries[..] else {
        panic!("{} combinations", entries.len());
    };
    assert_eq!((entry.scene.scene.seed, entry.seeds), (3, seeds));
}

#[test]
fn a_model_that_cannot_be_fitted_says_why_and_the_others_continue() {
    let bench = with_small();
    // A batch larger than the training part.
    let scene = std::fs::read_to_string(bench.path("small.toml")).expect("written");
    let own = "name = \"ridge\", set = { size = \"8x8\" }";
    let network = "name = \"cnn\", set = { size = \"16x16\", batch = 4096 }";
    bench.write("small.toml", &scene.replace(own, network));
    let words = "bench study small.toml --points 16 --folds 3 --models cnn,baseline";
    let found = bench.json(words);
    crate::schema::check("bench-study", &found);
    let failed = found["rows"][0]["failed"].as_str().expect("said");
    assert!(failed.ends_with("fewer than a batch of 4096"), "{failed}");
    assert_eq!(found["rows"][0]["pareto"], false);
    assert_eq!(found["rows"][1]["clusters"], 16);
    assert!(found["rows"][1]["failed"].is_null());
}

#[test]
fn csv_has_a_row_for_each_combination() {
    let bench = with_small();
    let words = "bench study small.toml --points 16 --folds 3 --models ridge,baseline";
    let csv = bench.ok(&format!("{words} --format csv -q"));
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines.len(), 3, "{csv}");
    assert!(lines[0].starts_with("points,folds,model,presses"), "{csv}");
    assert!(lines[0].ends_with(",mean width,front"), "{csv}");
    assert!(lines[1].starts_with("16,3,ridge,"), "{csv}");
    assert!(lines[2].starts_with("16,3,baseline,"), "{csv}");
}

#[test]
fn real_devices_recordings_and_unknown_names_are_refused_before_a_press() {
    let bench = with_small();
    bench.write("lab.toml", LAB);
    bench.write("real.toml", REAL);
    bench.refused(
        "bench study real.toml",
        2,
        "real.toml: study `real` uses a real rig",
    );
    bench.refused(
        "bench study real.toml",
        2,
        "use `taceva run` for this scene",
    );
    bench.record("monday", 24);
    bench.write(
        "recorded.toml",
        "scene_version = 1\nname = \"recorded\"\nsensor = { dataset = \"monday\" }\nmodel = { name = \"ridge\" }\n",
    );
    bench.refused(
        "bench study recorded.toml",
        2,
        "uses a recording and acquires no data",
    );
    bench.refused(
        "bench study --study GelSigt",
        2,
        "quick: no study is called `GelSigt`: did you mean `GelSight`?",
    );
    bench.refused("bench study --models rigde", 2, "did you mean `ridge`");
    bench.refused(
        "bench study --folds some",
        2,
        "expected none or a whole number",
    );
    bench.refused(
        "bench study small.toml --points 16 --folds 17 --models ridge",
        3,
        "small.toml with 16 points, 17 folds, ridge: ",
    );
    bench.refused(
        "bench study small.toml --points 16 --folds 17",
        3,
        "expected 2 to 16",
    );
}
