//! Hints for names that the user wrote in the wrong place.

use crate::support::Bench;

#[test]
fn a_column_whose_unit_nobody_states_is_named_with_the_remedy() {
    let bench = Bench::new();
    let table = |off: f64| {
        let rows = (0..12_u32).map(|row| format!("{row},{}\n", f64::from(row) * 0.3 + off));
        format!("sample,Fz_N\n{}", rows.collect::<String>())
    };
    bench.write("t.csv", &table(0.1));
    bench.write("p.csv", &table(0.2));
    let score = "score --truth t.csv --pred p.csv --format json";
    let ran = bench.run(score);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let note = "Fz_N: not one of Px Py Pz Fx Fy Fz; scored as a channel with the unit 1; rename it Fz, or give --units Fz_N=N";
    assert!(ran.err.contains(note), "{}", ran.err);
    assert!(ran.out.contains(note), "{}", ran.out);
    let stated = bench.run(&format!("{score} --units Fz_N=N"));
    assert_eq!(stated.code, 0, "{}", stated.err);
    assert!(!stated.out.contains("unit 1") && !stated.err.contains("unit 1"));
}

#[test]
fn an_angle_that_may_be_in_radians_is_warned_of_in_every_output_and_a_stated_unit_ends_it() {
    let bench = Bench::new();
    let table = |off: f64| {
        let rows = (0..12_u32).map(|row| format!("{row},{}\n", f64::from(row) * 0.5 - 3.0 + off));
        format!("sample,yaw\n{}", rows.collect::<String>())
    };
    bench.write("t.csv", &table(0.1));
    bench.write("p.csv", &table(0.2));
    let note = "yaw: all values lie within ±6.28, as angles in radians do, but are scored as degrees with a period of 360";
    let score = "score --truth t.csv --pred p.csv";
    for form in ["text", "json", "md", "csv"] {
        let ran = bench.run(&format!("{score} --periods yaw=360 --format {form}"));
        assert_eq!(ran.code, 0, "{}", ran.err);
        let said = format!("{}{}", ran.out, ran.err);
        assert!(said.contains(note), "{form}: {said}");
    }
    for stated in ["--periods yaw=2pi", "--periods yaw=360 --units yaw=deg"] {
        let ran = bench.run(&format!("{score} {stated} --format json"));
        assert_eq!(ran.code, 0, "{}", ran.err);
        let said = format!("{}{}", ran.out, ran.err);
        assert!(!said.contains("as angles in radians do"), "{said}");
    }
    bench.refused(
        &format!("{score} --periods yaw=6.283 --units yaw=deg"),
        2,
        "write yaw=360 for degrees, or --units yaw=rad",
    );
}

#[test]
fn a_table_and_a_channel_in_the_wrong_place_are_led_to_the_right_one() {
    let bench = Bench::new();
    bench.write("p.csv", "sample,Fz\n0,1\n");
    bench.refused(
        "evaluate p.csv",
        2,
        "p.csv is a table, not a dataset; tables of predictions: `taceva score`; recordings: `taceva import FOLDER`",
    );
    bench.record("data", 40);
    let ran = bench.run("evaluate data --model ridge --channels fz -q");
    assert!(
        ran.code != 0 && ran.err.contains("did you mean `Fz`?"),
        "{}",
        ran.err
    );
    let ran = bench.run("evaluate data --model ridge --metrics mse -q");
    assert!(
        ran.code != 0 && ran.err.contains("did you mean `rmse`? Known are mae"),
        "{}",
        ran.err
    );
}
