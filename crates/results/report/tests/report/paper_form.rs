//! Tests of the layout of the TacEva study: its tables compile, have its printed numbers, and state missing data.

use serde_json::{Value, json};
use taceva_report::{FigureStyle, PaperForm, Study, paper_form, study_figures};

use crate::paper::assert_fits_a_column;
use crate::support;

/// Sensors of the TacEva study in another order.
const SENSORS: [&str; 4] = ["GelSight", "GelSightWM", "MagicTac", "ViTacTip"];

/// A synthetic result of a sensor with light scenes.
fn study(sensor: &str) -> Study {
    let mut result = support::results(sensor, 1.0);
    for channel in ["Pxy", "Pz", "Fxy", "Fz"] {
        for metric in ["mae", "r2"] {
            let score = result["metrics"][metric][channel].clone();
            if metric == "mae" {
                result["metrics"]["smape"][channel] = score;
                result["metrics"]["smape"][channel]["unit"] = "1".into();
            }
        }
        // Depth steps are counted as in the samples.
        let curve = &mut result["metrics"]["repeatability"][channel]["curve"];
        let steps = curve["values"].as_array().map_or(0, Vec::len);
        curve["x"] = (0..steps).map(|step| json!(step as f64)).collect();
        for (at, scene) in (1..).zip(["S1", "S2", "S3", "S4"]) {
            let value = json!({"value": 0.01 * f64::from(at), "unit": "1"});
            result["metrics"]["r_light"][channel][format!("scene:{scene}")] = value;
        }
    }
    support::study(&result)
}

fn form() -> PaperForm {
    paper_form(&SENSORS.map(study))
}

/// Words of every cell of a table.
fn cells(form: &PaperForm, name: &str) -> Vec<Vec<String>> {
    let table = form.tables.iter().find(|(own, _)| own == name);
    let (_, table) = table.unwrap_or_else(|| panic!("no {name}"));
    table.rows.iter().map(taceva_report::Row::plain).collect()
}

#[test]
fn all_five_tables_are_there_and_fit_a_paper() {
    let form = form();
    let names: Vec<&str> = form.tables.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(
        names,
        ["table-1", "table-2", "table-3", "table-4", "table-5"]
    );
    assert!(form.absent.is_empty());
    assert_fits_a_column("the form of the study", &form.latex());
    let markdown = form.markdown();
    assert!(markdown.contains("72 boards") && markdown.contains("Our samples are simulated"));
}

#[test]
fn sensors_of_the_study_stand_in_its_order_with_the_ratio_to_the_printed_number() {
    let form = form();
    let calibration = cells(&form, "table-2");
    assert_eq!(calibration.len(), 16);
    assert_eq!(
        calibration[0][..3],
        ["ViTacTip", "Fxy", "0.1000, 0.01020 (×9.80)"]
    );
    assert_eq!(calibration[15][1], "Pz");
    let light = cells(&form, "table-4");
    assert_eq!(light[0][1], "1.0 %, 11.5 % (×0.09)");
    assert_eq!(light[4][0], "Mean");
}

#[test]
fn every_printed_number_of_tables_one_to_five_stands_in_its_table() {
    let text = include_str!("../golden/paper_numbers.json");
    let printed: Value = serde_json::from_str(text).expect("JSON");
    let form = form();
    let mut held = 0;
    for number in printed["numbers"].as_array().expect("a list") {
        let (table, Some(value)) = (
            number["table"].as_str().expect("a table"),
            number["value"].as_f64(),
        ) else {
            continue;
        };
        // In the study, the mean of a column of light sometimes differs from that of its rows.
        let Some(at) = ["I", "II", "III", "IV", "V"]
            .iter()
            .position(|known| *known == table)
        else {
            continue;
        };
        if number["scene"] == "Mean" {
            continue;
        }
        let shown = match table {
            "IV" => format!("{value:.1} %"),
            "I" | "III" | "V" => digits(value, 3),
            _ => digits(value, 4),
        };
        let all = cells(&form, &format!("table-{}", at + 1));
        let is_there = all.iter().flatten().any(|cell| {
            let mut words = cell.split(", ").skip(1);
            words.any(|below| below == shown || below.starts_with(&format!("{shown} (")))
        });
        assert!(is_there, "{number}: {shown} in {all:?}");
        held += 1;
    }
    assert_eq!(held, 124);
}

fn digits(value: f64, digits: i32) -> String {
    let decimals =
        (0..8).find(|decimals| value * 10_f64.powi(*decimals) >= 10_f64.powi(digits - 1));
    let decimals = usize::try_from(decimals.unwrap_or(digits)).expect("a few");
    format!("{value:.decimals$}")
}

#[test]
fn results_without_planes_have_no_tables_but_reasons() {
    let result = json!({
        "schema": "taceva.evaluation/1.0", "subject": {"sensor": "mine"},
        "metrics": {"mae": {"yaw": {"value": 0.5, "unit": "1", "n": 3}}}
    });
    let form = paper_form(&[support::study(&result)]);
    assert!(form.tables.is_empty(), "{:?}", form.tables);
    assert_eq!(form.absent.len(), 5);
    assert!(form.absent[1].1.contains("`mae`"), "{:?}", form.absent);
}

#[test]
fn tables_of_many_sensors_have_blocks_that_fit_a_page() {
    let names = SENSORS.map(str::to_owned);
    let more = ["GelSight Mini 2 (ridge)", "left_finger", "a", "b"].map(str::to_owned);
    let studies: Vec<Study> = names.iter().chain(&more).map(|name| study(name)).collect();
    let tables = paper_form(&studies).latex();
    assert!(tables.matches("\\begin{tabular*}").count() > tables.matches("\\caption{").count());
    assert_fits_a_column("many sensors", &tables);
}

#[test]
fn a_sensor_that_the_study_did_not_measure_stands_alone() {
    let form = paper_form(&[study("a_b & {c}")]);
    let calibration = cells(&form, "table-2");
    assert_eq!(calibration[0][2], "0.1000");
    assert_fits_a_column("another sensor", &form.latex());
}

#[test]
fn numbers_that_the_study_prints_in_figures_stand_beside_ours() {
    let studies = SENSORS.map(|sensor| {
        let mut study = study(sensor);
        study.samples = support::drawn(sensor, 50, 1.0).samples;
        study
    });
    let form = paper_form(&studies);
    let figures = study_figures(&studies, &FigureStyle::default());
    let text = form.markdown_of(&figures);
    let of = |id: &str| {
        let table = form.figures.iter().find(|(name, _)| name == id);
        let (_, table) = table.unwrap_or_else(|| panic!("no numbers of {id}: {text}"));
        let rows: Vec<Vec<String>> = table.rows.iter().map(taceva_report::Row::plain).collect();
        rows
    };
    let rates = of("figure-3c");
    // ViTacTip is first, as in the study.
    assert_eq!(rates[0][..2], ["lines", "90.0 %, 81.2 % (×1.11)"]);
    assert_eq!(rates[2][..2], ["both", "–, 80.6 %"]);
    let surface = of("figure-4");
    assert_eq!(surface[0][1], "2.000, 6.753 (×0.30)");
    assert_eq!(surface[1][1], "0.800, 0.863 (×0.93)");
    let tables = form.latex();
    assert!(tables.contains("Numbers of figure 3c"), "{tables}");
    assert!(text.contains("![Figure 7a"), "{text}");
    let said = text.matches("prints no numbers with its figures").count();
    assert_eq!(said, 1, "{text}");
}

#[test]
fn mean_grey_levels_stand_beside_those_of_figure_6b() {
    let mut study = study("MagicTac");
    let rows = "id,protocol,scene,intensity\na,light-sweep,S4,100\nb,light-sweep,S4,136\nc,light-sweep,normal,53\nd,calibration,S4,1\n";
    study.samples = Some(taceva_results::Samples::read(rows).expect("samples"));
    let form = paper_form(&[study]);
    let table = form.figures.iter().find(|(name, _)| name == "figure-6b");
    let (_, table) = table.expect("numbers");
    let rows: Vec<Vec<String>> = table.rows.iter().map(taceva_report::Row::plain).collect();
    assert_eq!(rows[0], ["normal", "53, 106 (×0.50)"]);
    assert_eq!(rows[1], ["S1", "–, 106"]);
    assert_eq!(rows[4], ["S4", "118, 118 (×1.00)"]);
}

#[test]
fn a_sensor_that_the_study_did_not_measure_has_no_numbers_beside_figures() {
    let form = paper_form(&[study("mine")]);
    assert!(form.figures.is_empty(), "{:?}", form.figures);
}

#[test]
fn repeated_presses_are_drawn_by_plane_and_their_truths_give_the_depth() {
    let mut study = study("ViTacTip");
    let head = "id,protocol,point_id,depth_step,Px,Px_predicted,Py,Py_predicted,Pz,Pz_predicted";
    let rows = "a,repeatability,p,0,1,1.5,2,2.5,0.25,0.3\nb,repeatability,p,0,1,1.4,2,2.6,0.25,0.2\nc,calibration,p,0,9,9,9,9,9,9\n";
    let samples = taceva_results::Samples::read(&format!("{head}\n{rows}"));
    study.samples = Some(samples.expect("samples"));
    let figures = study_figures(&[study], &FigureStyle::default());
    let figure = figures.drawn.iter().find(|figure| figure.id == "figure-7a");
    let svg = figure.expect("drawn").svg();
    for words in [
        "ViTacTip, point p, step 0: predicted Px (mm) 1.5, predicted Py (mm) 2.5",
        "ViTacTip, point p, step 0: depth (mm) 0.25, predicted Pz (mm) 0.2",
    ] {
        assert!(svg.contains(words), "{words}: {svg}");
    }
    assert!(!svg.contains("predicted Fx"), "no force was predicted");
}

#[test]
fn figures_three_to_eight_are_drawn_with_the_quantities_of_the_study() {
    let studies = SENSORS.map(|name| {
        let mut study = study(name);
        study.samples = support::drawn(name, 200, 1.0).samples;
        for score in &mut study.scores {
            if score.metric == "r_spatial" && score.channel == "Pz" {
                score.standing = taceva_metrics::Standing::NotAboveNoiseFloor;
            }
        }
        study
    });
    let figures = study_figures(&studies, &FigureStyle::default());
    let drawn: Vec<&str> = figures
        .drawn
        .iter()
        .map(|figure| figure.id.as_str())
        .collect();
    let absent: Vec<&str> = figures
        .absent
        .iter()
        .map(|(name, _)| name.as_str())
        .collect();
    for name in [
        "figure-4",
        "figure-5-radius",
        "figure-5-depth",
        "figure-7a",
        "figure-7b",
        "figure-8a",
        "figure-8c",
    ] {
        assert!(drawn.contains(&name), "{name}: {drawn:?}, {absent:?}");
    }
    assert!(absent.contains(&"figure-6a"), "{absent:?}");
    assert_eq!(drawn.len() + absent.len(), 11);
    let robustness = figures.drawn.iter().find(|figure| figure.id == "figure-8c");
    let robustness = robustness.expect("drawn");
    assert!(
        robustness.svg().contains("position† ↓"),
        "the mark of the noise floor"
    );
    let caption = "† Not above chance, so that it supports no claim: spatial position of GelSight";
    assert!(
        robustness.caption.contains(caption),
        "{}",
        robustness.caption
    );
}
