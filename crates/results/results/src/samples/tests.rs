//! Accepted and rejected tables of samples.

use super::*;

#[test]
fn samples_are_found_by_the_part_of_the_protocol() {
    let table = "sample,protocol,scene\n1,calibration light-sweep,\n2,idle,S1\n";
    let samples = Samples::read(table).expect("samples");
    assert_eq!(samples.of_protocol("light-sweep"), [0]);
    assert_eq!(samples.word("scene", 0), None);
    assert_eq!(samples.word("scene", 1), Some("S1"));
}

#[test]
fn names_that_begin_like_a_formula_are_read_as_they_were() {
    let table = "sample,point_id\n'=1+1,'=p\n'a,b\n";
    let samples = Samples::read(table).expect("samples");
    let words = |row: usize| {
        (
            samples.word(Samples::KEY, row),
            samples.word("point_id", row),
        )
    };
    assert_eq!(words(0), (Some("=1+1"), Some("=p")));
    assert_eq!(words(1), (Some("'a"), Some("b")));
}

#[test]
fn a_table_is_written_as_it_was_read() {
    let table = "sample,part,depth_step,Fz,Fz_predicted\n'=a,test,2.0,0.5,\nb,,,0.25,0.1\n";
    let samples = Samples::read(table).expect("samples");
    let mut text = Vec::new();
    samples.write(&mut text).expect("written");
    assert_eq!(String::from_utf8(text).expect("text"), table);
    assert_eq!(samples.channels().len(), 1);
}

#[test]
fn predictions_beyond_the_bounds_of_a_model_are_no_channel_of_their_own() {
    let table = "sample,Fz,Fz_predicted,Fz_predicted_unbounded\na,0.5,0.4,-0.3\n";
    let samples = Samples::read(table).expect("samples");
    let names: Vec<&str> = samples.channels().iter().map(|of| of.name).collect();
    assert_eq!(names, ["Fz"]);
    assert_eq!(samples.number("Fz_predicted_unbounded", 0), Some(-0.3));
}

#[test]
fn what_is_no_number_is_refused_by_its_place() {
    let error = Samples::read("id,Fz\na,1\nb,nan\n").expect_err("no number");
    assert_eq!(
        error.to_string(),
        "samples, line 3, column `Fz`: expected a finite number, found `nan`"
    );
    assert!(matches!(Samples::read("Fz\n1\n"), Err(SamplesError::NoKey)));
}

#[test]
fn named_channels_keep_their_columns_and_all_covariates() {
    let table = "sample,point_id,depth_step,Fx,Fx_predicted,Fz,Fz_predicted,Fz_predicted_unbounded\na,p,1,0.5,0.4,1,2,3\n";
    let samples = Samples::read(table).expect("samples").of_channels(&["Fz"]);
    let mut text = Vec::new();
    samples.write(&mut text).expect("written");
    let expected =
        "sample,point_id,depth_step,Fz,Fz_predicted,Fz_predicted_unbounded\na,p,1.0,1.0,2.0,3.0\n";
    assert_eq!(String::from_utf8(text).expect("text"), expected);
}
