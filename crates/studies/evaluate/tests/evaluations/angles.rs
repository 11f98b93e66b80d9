//! Periodic angles, rotations and zeros, from the map to the report.

use std::fmt::Write as _;
use std::num::NonZeroUsize;
use std::path::Path;

use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_evaluate::{EvaluateRequest, Evaluated, FitRequest, ModelChoice, evaluate};
use taceva_import::{ImportMap, ImportPlan};
use taceva_models::{ModelSettings, Models};

use crate::taxels::WORK;

/// Presses with a tip at all angles: the taxels sense the direction, and the force plus a zero offset of 0.5 N.
fn table() -> String {
    let mut text = "a,b,c,d,yaw,yaw_rad,rx,ry,rz,fz\n".to_owned();
    for number in 0..240_u32 {
        let yaw = (f64::from(number) * 23.7).rem_euclid(360.0) - 180.0;
        let force = match number {
            0..4 => 0.01 * f64::from(number % 2),
            _ => 0.1 * f64::from(number * 7 % 19),
        };
        let (sine, cosine) = yaw.to_radians().sin_cos();
        let [rx, ry, rz] = [20.0 * cosine, 20.0 * sine, 2.0 * force * cosine];
        let _ = writeln!(
            text,
            "{cosine},{sine},{force},{},{yaw},{},{rx},{ry},{rz},{}",
            cosine + sine,
            yaw.to_radians(),
            force + 0.5
        );
    }
    text
}

fn dataset(folder: &Path, yaw: &str, above: &str) -> Dataset {
    std::fs::write(folder.join("t.csv"), table()).expect("written");
    let map = format!(
        "map_version = 2\ntable = \"t.csv\"\n{above}[columns]\nFz = {{ from = \"fz\", unit = \"N\" }}\nyaw = {{ {yaw} }}\n\
         Rx = {{ from = \"rx\", unit = \"deg\" }}\nRy = {{ from = \"ry\", unit = \"deg\" }}\nRz = {{ from = \"rz\", unit = \"deg\" }}\n\
         [signals]\nfrom = [\"a\", \"b\", \"c\", \"d\"]\nunit = \"V\"\nplaces = [2, 2]\nchannels = [\"p\"]\norder = \"place-first\"\n\
         [zero]\nfrom = \"first 4\"\n[time]\nclock = \"unknown\"\n\
         [sensor]\nmodel = \"drawn skin\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = \"unknown\"\n"
    );
    let map = ImportMap::parse("map.toml".as_ref(), &map).expect("a map");
    let target = folder.join("dataset");
    let plan = ImportPlan::new(folder, &map).expect("planned");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    Dataset::open(&target).expect("a dataset")
}

fn evaluated(yaw: &str, above: &str) -> Evaluated {
    evaluated_by(&format!("from = \"yaw\", unit = \"deg\"{yaw}"), above)
}

/// Evaluation of an imported recording. `yaw` is the entry of the yaw in the import map, and `above` is the text before its columns.
fn evaluated_by(yaw: &str, above: &str) -> Evaluated {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = dataset(folder.path(), yaw, above);
    let request = EvaluateRequest {
        model: ModelChoice::Fit(FitRequest {
            model: Models::builtin().find("ridge").expect("a model"),
            settings: ModelSettings::parse([]).expect("none"),
            channels: Vec::new(),
            split: Some("random".to_owned()),
            seed: 0,
        }),
        metrics: ["r2", "mae", "skill"].map(str::to_owned).to_vec(),
        part: None,
        sensor: None,
        is_independent: false,
    };
    evaluate(&dataset, &request, WORK).expect("evaluated")
}

fn number(evaluated: &Evaluated, metric: &str, channel: &str) -> f64 {
    let score = evaluated.report.score(metric, channel).expect("scored");
    score.value.number().expect("defined")
}

#[test]
fn a_yaw_all_around_has_small_errors_only_with_its_period_and_other_channels_do_not_change() {
    let [plain, periodic] = ["", ", period = 360"].map(|yaw| evaluated(yaw, ""));
    assert!(number(&plain, "mae", "yaw") > 20.0);
    assert!(number(&periodic, "mae", "yaw") < 3.0);
    assert!(number(&periodic, "r2", "yaw") > 0.99);
    assert!(number(&periodic, "skill", "yaw") > 0.99);
    assert!(number(&periodic, "mae", "Fz") < 0.1);
}

#[test]
fn angles_in_radians_of_a_map_are_degrees_and_their_period_is_in_radians() {
    let degrees = evaluated(", period = 360", "");
    let radians = evaluated_by(
        "from = \"yaw_rad\", unit = \"rad\", period = 6.283185307179586",
        "",
    );
    for metric in ["mae", "r2", "skill"] {
        let [found, expected] = [&radians, &degrees].map(|of| number(of, metric, "yaw"));
        assert!(
            (found - expected).abs() < 1e-9,
            "{metric}: {found} {expected}"
        );
    }
    let score = radians.report.score("mae", "yaw").expect("scored");
    assert_eq!(score.unit.symbol(), "deg");
}

#[test]
fn a_report_states_the_zero_of_the_map_and_the_angle_between_declared_rotations() {
    let notes = |above: &str| evaluated("", above).report.provenance.notes.join("\n");
    let plain = notes("");
    assert!(
        plain.contains("import: Fz minus the mean of the first 4 rows of each table"),
        "{plain}"
    );
    assert!(!plain.contains("rotation Rx"), "{plain}");
    let declared = notes("rotation = [\"Rx\", \"Ry\", \"Rz\"]\n");
    let start = "rotation Rx, Ry, Rz: mean angle between predictions and truth ";
    let angle = declared.lines().find_map(|line| line.strip_prefix(start));
    let angle: f64 = angle
        .and_then(|rest| rest.split(' ').next()?.parse().ok())
        .unwrap_or_else(|| panic!("{declared}"));
    assert!(angle > 0.0 && angle < 2.0, "{declared}");
}
