//! Calibration curves of tables of readings.

use serde_json::Value;

use crate::support::Bench;

const DIN: &str = "curve din.csv --x concentration --y area";

/// The worked example of DIN 32645, from the golden values of `taceva-metrology`.
fn golden() -> Value {
    let text = include_str!("../../../crates/results/metrology/tests/golden/limits.json");
    let file: Value = serde_json::from_str(text).expect("JSON");
    let mut cases = file["cases"].as_array().expect("cases").iter();
    let case = cases.find(|case| {
        let name = case["name"].as_str();
        name.is_some_and(|name| name.starts_with("DIN 32645"))
    });
    case.expect("the case").clone()
}

/// Test folder with `din.csv`, the ten readings of the example of DIN 32645.
fn din() -> Bench {
    let golden = golden();
    let numbers = |axis: &str| golden["inputs"][axis].as_array().expect("numbers").clone();
    let rows = numbers("x").into_iter().zip(numbers("y"));
    let rows: String = rows.map(|(x, y)| format!("{x},{y}\n")).collect();
    let bench = Bench::new();
    bench.write("din.csv", &format!("concentration,area\n{rows}"));
    bench
}

/// Test folder with `unit.csv`: six simulated points, each with its own offset, pressed with the same three forces.
fn points() -> Bench {
    let mut table = String::from("sample,point_id,Fz,Fz_predicted,source\n");
    let offsets = [0.05, -0.04, 0.03, -0.05, 0.04, -0.03];
    for (point, offset) in offsets.into_iter().enumerate() {
        for (step, force) in [0.2, 0.4, 0.6].into_iter().enumerate() {
            let noise = if (point + step) % 2 == 0 {
                0.001
            } else {
                -0.001
            };
            table.push_str(&format!(
                "{point}-{step},p{point},{force:?},{:?},simulated\n",
                force + offset + noise
            ));
        }
    }
    let bench = Bench::new();
    bench.write("unit.csv", &table);
    bench
}

/// First figure of `curve` for the quantity `quantity`.
fn figure<'c>(curve: &'c Value, quantity: &str) -> &'c Value {
    let mut figures = curve["figures"].as_array().expect("a list").iter();
    let found = figures.find(|of| of["quantity"] == quantity);
    found.unwrap_or_else(|| panic!("no {quantity} in {curve:#}"))
}

fn near(found: &Value, expected: &Value, relative: f64) {
    let number = |of: &Value| of.as_f64().unwrap_or_else(|| panic!("no number: {of}"));
    let [found, expected] = [number(found), number(expected)];
    let off = (found - expected).abs() / expected.abs();
    assert!(off <= relative, "{found} is not {expected}");
}

#[test]
fn the_worked_example_has_its_line_its_inverse_and_its_limits_of_detection() {
    let bench = din();
    let words = format!("{DIN} --band 0.99 --invert 3500count --detect");
    let curve = bench.json(&words);
    crate::schema::check("curve", &curve);
    let own = &golden()["own"];
    near(
        &figure(&curve, "coefficient_0")["value"],
        &own["intercept"],
        1e-12,
    );
    near(
        &figure(&curve, "coefficient_1")["value"],
        &own["slope"],
        1e-12,
    );
    near(
        &figure(&curve, "residual_deviation")["value"],
        &own["s"],
        1e-12,
    );
    let inverse = figure(&curve, "inverse");
    near(&inverse["value"], &own["inverse_3500"], 1e-12);
    near(
        &figure(&curve, "critical")["value"],
        &own["critical_.05"],
        1e-9,
    );
    let detectable = &own["detectable_ISO_noncentral_.05"];
    near(&figure(&curve, "detectable")["value"], detectable, 1e-9);
    assert_eq!(curve["n"], 10);
    assert_eq!(curve["points"], Value::Null);
    let csv = bench.ok(&format!("{words} --format csv"));
    let [low, high] = [0, 1_usize].map(|end| inverse["ends"][end].as_f64().expect("an end"));
    let value = inverse["value"].as_f64().expect("a value");
    let row = format!("inverse,3500.0,{value:?},,{low:?},{high:?},,,independent rows,unknown");
    assert!(csv.contains(&row), "no `{row}` in\n{csv}");
    let text = bench.ok(&words);
    assert!(
        text.contains("order 1: area over concentration, 10 rows"),
        "{text}"
    );
}

#[test]
fn rows_of_a_point_widen_the_bands_unless_they_are_said_to_be_independent() {
    let bench = points();
    let words = "curve unit.csv --x truth.Fz --y prediction.Fz --at 0.4";
    let curve = bench.json(words);
    crate::schema::check("curve", &curve);
    assert_eq!(curve["points"], 6);
    assert_eq!(curve["y"]["column"], "Fz_predicted");
    assert_eq!(curve["y"]["unit"], "N");
    let confidence = figure(&curve, "confidence");
    assert_eq!(confidence["remark"], "jackknife over 6 points");
    let slope = figure(&curve, "coefficient_1");
    // Offsets of points with the same forces leave the slope as it is.
    assert_eq!(slope["remark"], "independent rows");
    let far = bench.json(&words.replace("--at 0.4", "--at 99"));
    let remark = figure(&far, "prediction")["remark"]
        .as_str()
        .expect("a remark");
    assert!(
        remark.contains("; beyond the reference values, "),
        "{remark}"
    );
    let independent = bench.json(&format!("{words} --independent"));
    assert_eq!(independent["points"], Value::Null);
    let narrow = figure(&independent, "confidence");
    assert_eq!(narrow["remark"], "independent rows");
    let u = |of: &Value| of["u"].as_f64().expect("an uncertainty");
    assert!(u(confidence) > 1.5 * u(narrow), "{confidence} {narrow}");
    for format in ["text", "json", "csv", "md", "tex"] {
        let written = bench.ok(&format!("{words} --format {format}"));
        assert!(written.contains("simulated"), "{format}: {written}");
    }
    let whole = bench.json("curve unit.csv --x Fz --y Fz_predicted --order 2 --simultaneous");
    crate::schema::check("curve", &whole);
    assert_eq!(figure(&whole, "coefficient_2")["unit"], "N/N²");
    assert_eq!(figure(&whole, "simultaneous")["at"], 0.2);
}

#[test]
fn a_slope_of_chance_has_no_inverse_and_the_reason_is_stated() {
    let bench = Bench::new();
    bench.write(
        "flat.csv",
        "x,y\n0,0.3\n1,-0.2\n2,0.1\n3,-0.4\n4,0.25\n5,0.05\n",
    );
    let words = "curve flat.csv --x x --y y --invert 0.1N --detect";
    let curve = bench.json(words);
    crate::schema::check("curve", &curve);
    for quantity in ["inverse", "critical", "detectable"] {
        let found = figure(&curve, quantity);
        assert_eq!(found["value"], Value::Null, "{found}");
        let remark = found["remark"].as_str().expect("a reason");
        assert!(remark.contains("slope is not shown"), "{remark}");
    }
    let text = bench.ok(words);
    assert!(
        text.contains("the slope is not shown to differ from 0"),
        "{text}"
    );
}

#[test]
fn relative_errors_count_readings_and_the_contact_points_that_they_are_of() {
    let bench = Bench::new();
    // The point c is below a fifth of the greatest force.
    bench.write(
        "unit.csv",
        "point_id,Fz,Fz_predicted\nc,1,9\nc,2,9\na,80,81\na,100,102\nb,90,94\nb,100,108\n",
    );
    let curve = bench.json("curve unit.csv --x Fz --y Fz_predicted --iso7500");
    let remark = &figure(&curve, "relative_error_median")["remark"];
    let expected = "like ISO 7500-1, of 4 readings of 2 contact points; no class";
    assert_eq!(*remark, expected);
}

#[test]
fn relative_errors_from_a_fifth_of_full_scale_on_are_summed_up_without_a_class() {
    let bench = Bench::new();
    // The first press is below a fifth of the greatest force.
    bench.write(
        "unit.csv",
        "Fz,Fz_predicted\n1,9\n100,101\n100,102\n100,104\n100,108\n",
    );
    let curve = bench.json("curve unit.csv --x Fz --y Fz_predicted --iso7500");
    crate::schema::check("curve", &curve);
    let median = figure(&curve, "relative_error_median");
    near(&median["value"], &3.0.into(), 1e-12);
    assert_eq!(median["remark"], "like ISO 7500-1, of 4 readings; no class");
    near(
        &figure(&curve, "share_within_class_3")["value"],
        &50.0.into(),
        1e-12,
    );
}

#[test]
fn series_of_a_proving_instrument_have_relative_errors_and_no_class() {
    let bench = Bench::new();
    let series = |name: &str, first: f64| {
        let readings = [first, 2.0, 3.0, 4.0].into_iter().zip([1, 2, 3, 4]);
        let rows = readings.map(|(reading, force)| format!("{name},{force},{reading:?}\n"));
        rows.collect::<String>()
    };
    let head = "series,force,reading\n";
    let [x1, x2, x3] = [series("X1", 1.0), series("X2", 1.02), series("X3", 1.0)];
    let x5 = series("X5", 1.0);
    bench.write("proving.csv", &format!("{head}{x5}{x1}{x2}{x3}"));
    let words = "curve proving.csv --x force --y reading --iso376 series";
    let curve = bench.json(words);
    crate::schema::check("curve", &curve);
    let repeat = figure(&curve, "proving_b_prime");
    near(&repeat["value"], &(2.0 / 1.01).into(), 1e-9);
    let place = "none: b' = 2.0 %, class 2 ends at 0.20 %; known figures within class 1 x 20, not a class of ISO 376";
    assert_eq!(repeat["remark"], format!("like ISO 376: {place}"));
    assert_eq!(repeat["at"], 1.0);
    let reversed = figure(&curve, "proving_v");
    assert_eq!(reversed["value"], Value::Null);
    assert_eq!(reversed["remark"], "series X4' or X6' is missing");
    bench.write("proving.csv", &format!("{head}{x1}{x2}{x5}"));
    bench.refused(
        words,
        3,
        "proving.csv, reading over force: series X3 is missing",
    );
    bench.write("proving.csv", &format!("{head}{x1}{x3}{x5}X9,1,1\n"));
    bench.refused(
        words,
        3,
        "line 14, column `series`: `X9`: expected X1, X2, X3",
    );
}

#[test]
fn wrong_tables_and_options_are_refused_by_their_place() {
    let bench = points();
    let words = "curve unit.csv --x Fz --y Fz_predicted";
    bench.refused(
        &format!("{words} --band 1"),
        2,
        "--band: probability 1 is found",
    );
    bench.refused(
        &format!("{words} --invert 1mm"),
        2,
        "--invert 1mm: the readings are in N",
    );
    bench.write("plain.csv", "x,reading\n1,2\n2,3\n3,4.1\n");
    bench.refused(
        "curve plain.csv --x x --y reading --invert 100mN",
        2,
        "--invert 100mN: the unit of column reading is unknown, expected a reading in N",
    );
    bench.refused(
        "curve unit.csv --x Fz --y Fx_predicted",
        3,
        "no column `Fx_predicted`",
    );
    bench.write("same.csv", "Fz,y\n1,2\n1,3\n1,4\n");
    bench.refused(
        "curve same.csv --x Fz --y y",
        3,
        "same.csv, y over Fz: all x are equal",
    );
    bench.write("nan.csv", "Fz,y\n1,2\n2,NaN\n3,4\n");
    bench.refused(
        "curve nan.csv --x Fz --y y",
        3,
        "nan.csv, line 3, column `y`: `NaN`",
    );
    bench.write("few.csv", "Fz,y\n1,2\n2,3\n,4\n");
    bench.refused(
        "curve few.csv --x Fz --y y",
        3,
        "2 rows, expected 3 or more",
    );
}
